#include "fem/curved_element.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <string>

#include "core/error.hpp"
#include "fem/quadrature.hpp"
#include "fem/reference_element.hpp"

namespace thinwall::fem {

namespace {

/// Number n of quadrature points in a direction: n ≥ p + 1 and 2n − 1 ≥ 3p − 3 (see curved_reference()).
int points_for(int order) {
  return std::max(order + 1, (3 * order - 1) / 2);
}

CurvedReference evaluated_reference(int order) {
  const TetQuadrature rule = tet_quadrature(points_for(order));
  CurvedReference reference;
  reference.order = order;
  reference.weight = rule.weight;
  const Eigen::Index nodes = shape_functions(order, rule.lambda.col(0)).size();
  reference.values.resize(nodes, rule.weight.size());
  for (auto& slope : reference.slopes) slope.resize(nodes, rule.weight.size());
  for (Eigen::Index q = 0; q < rule.weight.size(); ++q) {
    reference.values.col(q) = shape_functions(order, rule.lambda.col(q));
    const Eigen::MatrixX3d slopes = shape_slopes(order, rule.lambda.col(q));
    for (std::size_t k = 0; k < 3; ++k) reference.slopes[k].col(q) = slopes.col(static_cast<Eigen::Index>(k));
  }
  return reference;
}

}  // namespace

const CurvedReference& curved_reference(int order) {
  if (order < 1 || order > 6) throw core::InputError("element order " + std::to_string(order) + " is outside 1 to 6");
  static std::array<std::unique_ptr<CurvedReference>, 7> made;
  static std::mutex mutex;
  const std::scoped_lock lock(mutex);
  auto& reference = made[static_cast<std::size_t>(order)];
  if (!reference) reference = std::make_unique<CurvedReference>(evaluated_reference(order));
  return *reference;
}

CurvedElement curved_element(const CurvedReference& reference, const Eigen::Matrix<double, Eigen::Dynamic, 3>& nodes,
                             const Lame& lame, double density_kg_m3) {
  const Eigen::Index n = nodes.rows();
  const Eigen::Index points = reference.weight.size();
  // √(w det J / 6) ∂_i N_a at the points: with the weight divided between both factors, S^{ij} is a single product of
  // two such matrices. A point with det J ≤ 0 gets no weight, and least_jacobian reports it.
  std::array<Eigen::MatrixXd, 3> gradient;
  for (auto& g : gradient) g.resize(n, points);
  Eigen::VectorXd volume(points);
  CurvedElement element;
  for (Eigen::Index q = 0; q < points; ++q) {
    Eigen::Matrix<double, Eigen::Dynamic, 3> slopes(n, 3);
    slopes << reference.slopes[0].col(q), reference.slopes[1].col(q), reference.slopes[2].col(q);
    const Eigen::Matrix3d J = nodes.transpose() * slopes;
    volume(q) = J.determinant() / 6.0;
    const double root = std::sqrt(std::max(0.0, reference.weight(q) * volume(q)));
    const Eigen::Matrix3d inverse = root * J.inverse();
    for (std::size_t i = 0; i < 3; ++i) gradient[i].col(q) = slopes * inverse.col(static_cast<Eigen::Index>(i));
  }
  // The divisor is the magnitude of the mean: in an element turned inside out as a whole both are negative, and their
  // ratio would hide it.
  element.least_jacobian = volume.minCoeff() / std::abs(volume.mean());
  element.M = density_kg_m3 *
              (reference.values * reference.weight.cwiseProduct(volume).asDiagonal() * reference.values.transpose());
  element.K.resize(3 * n, 3 * n);
  Eigen::MatrixXd trace = Eigen::MatrixXd::Zero(n, n);
  // A view of the entries K[ai, bj] of all a and b.
  const auto block = [&](std::size_t i, std::size_t j) {
    using Stride = Eigen::Stride<Eigen::Dynamic, Eigen::Dynamic>;
    return Eigen::Map<Eigen::MatrixXd, 0, Stride>(element.K.data() + i + 3 * static_cast<std::size_t>(n) * j, n, n,
                                                  Stride(9 * n, 3));
  };
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j) {
      const Eigen::MatrixXd S = gradient[i] * gradient[j].transpose();
      if (i == j) trace += S;
      block(i, j) = lame.lambda * S + lame.mu * S.transpose();
      if (i != j) block(j, i) = lame.lambda * S.transpose() + lame.mu * S;
    }
  }
  for (std::size_t i = 0; i < 3; ++i) block(i, i) += lame.mu * trace;
  return element;
}

}  // namespace thinwall::fem
