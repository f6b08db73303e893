#pragma once
// Component models whose modes are known because the matrices are made from them.

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "core/dense_factorisations.hpp"
#include "dynamics/response_model.hpp"
#include "dynamics/spatial_model.hpp"

namespace thinwall::coupling::testing {

enum class Damping { light, heavy, dashpot, structural };

/// M = L Lᵀ, K = L Q Ω² Qᵀ Lᵀ for a chosen Ω and random L, Q, so that Φ = L⁻ᵀ Q exactly.
struct Component {
  dynamics::SpatialModel model;
  Eigen::VectorXd omega;
  Eigen::MatrixXd Phi;
  double loss_factor = 0.0;
};

inline Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
}

/// Up to three unit vectors, along no axis and not orthogonal, but well apart (condition of the set below 5): what
/// nearly parallel ones cost is a test of its own.
inline std::vector<Eigen::Vector3d> random_directions(int count, std::mt19937& random) {
  for (;;) {
    const Eigen::MatrixXd set = random_matrix(3, count, random).colwise().normalized();
    const Eigen::VectorXd sizes = Eigen::JacobiSVD<Eigen::MatrixXd>(set).singularValues();
    if (sizes(0) > 5.0 * sizes(count - 1)) continue;
    std::vector<Eigen::Vector3d> directions;
    for (const auto column : set.colwise()) directions.emplace_back(column);
    return directions;
  }
}

/// x, y, z of the points in turn, then modal amplitudes, `size` in all.
inline dynamics::DofTable table(int size, const std::vector<std::string>& points) {
  dynamics::DofTable dofs;
  for (const std::string& point : points) {
    for (const dynamics::Dof& dof : dynamics::translations(point)) dofs.push_back(dof);
  }
  while (static_cast<int>(dofs.size()) < size) {
    const std::string name = points.front() + " mode " + std::to_string(dofs.size());
    dofs.push_back({name, Eigen::Vector3d::Zero(), dynamics::DofKind::modal});
  }
  dofs.resize(static_cast<std::size_t>(size));
  return dofs;
}

/// Viscous damping in modal coordinates: light = 0.1 % in every mode; heavy = 30 % on average, fully coupled; dashpot =
/// light and one strong damper.
inline Eigen::MatrixXd modal_damping(const Eigen::VectorXd& omega, Damping damping, std::mt19937& random) {
  const Eigen::Index n = omega.size();
  const Eigen::VectorXd root = omega.cwiseSqrt();
  Eigen::MatrixXd D = (2e-3 * omega).asDiagonal();
  if (damping == Damping::heavy) {
    const Eigen::MatrixXd A = random_matrix(n, n, random);
    D = 0.6 / static_cast<double>(n) * root.asDiagonal() * A * A.transpose() * root.asDiagonal();
  } else if (damping == Damping::dashpot) {
    const Eigen::VectorXd b = root.cwiseProduct(random_matrix(n, 1, random));
    D += b * b.transpose();
  } else if (damping == Damping::structural) {
    D.setZero();
  }
  return D;
}

/// A stable component of `size` DOFs, frequencies from 50 to 1000 Hz, about `mass` kg a DOF.
inline Component random_component(int size, const std::vector<std::string>& points, Damping damping, double mass,
                                  std::mt19937& random) {
  std::uniform_real_distribution<double> logarithm(std::log(50.0), std::log(1000.0));
  Component component;
  component.omega =
      Eigen::VectorXd::NullaryExpr(size, [&] { return 2.0 * std::numbers::pi * std::exp(logarithm(random)); });
  Eigen::MatrixXd L = 0.2 * random_matrix(size, size, random) / std::sqrt(static_cast<double>(size));
  L += Eigen::MatrixXd::Identity(size, size);
  L *= std::sqrt(mass);
  const Eigen::MatrixXd Q = Eigen::HouseholderQR<Eigen::MatrixXd>(random_matrix(size, size, random)).householderQ();
  const Eigen::MatrixXd LQ = L * Q;
  component.Phi = LQ.transpose().inverse();
  const auto symmetric = [](const Eigen::MatrixXd& A) { return Eigen::MatrixXd(0.5 * (A + A.transpose())); };
  component.model.M = symmetric(L * L.transpose());
  component.model.K = symmetric(LQ * component.omega.cwiseAbs2().asDiagonal() * LQ.transpose());
  component.model.C = symmetric(LQ * modal_damping(component.omega, damping, random) * LQ.transpose());
  component.model.dofs = table(size, points);
  if (damping == Damping::structural) {
    component.loss_factor = 0.01;
    component.model.D = component.loss_factor * component.model.K;
  }
  return component;
}

/// x, y, z, rx, ry, rz of the points in turn.
inline dynamics::DofTable six_components(const std::vector<std::string>& points) {
  dynamics::DofTable dofs;
  for (const std::string& point : points) {
    for (const auto kind : {dynamics::DofKind::translation, dynamics::DofKind::rotation}) {
      for (int axis = 0; axis < 3; ++axis) dofs.push_back({point, Eigen::Vector3d::Unit(axis), kind});
    }
  }
  return dofs;
}

/// A turn of one radian counts as 50 mm: scales the rows of rotations so that units differ as they do in a machine.
constexpr double turning_length = 0.05;

inline Eigen::VectorXd unit_lengths(const dynamics::DofTable& dofs) {
  Eigen::VectorXd lengths = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(dofs.size()));
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    if (dofs[i].kind == dynamics::DofKind::rotation) lengths(static_cast<Eigen::Index>(i)) = turning_length;
  }
  return lengths;
}

/// A component whose points turn, too: six DOFs a point and `more` modal amplitudes.
inline dynamics::SpatialModel random_turning_component(const std::vector<std::string>& points, int more,
                                                       Damping damping, double mass, std::mt19937& random) {
  dynamics::DofTable dofs = six_components(points);
  const int physical = static_cast<int>(dofs.size());
  Component component = random_component(physical + more, points, damping, mass, random);
  for (int i = 0; i < more; ++i) {
    const std::string name = points.front() + " mode " + std::to_string(i);
    dofs.push_back({name, Eigen::Vector3d::Zero(), dynamics::DofKind::modal});
  }
  const Eigen::VectorXd lengths = unit_lengths(dofs);
  const auto scale = lengths.asDiagonal();
  dynamics::SpatialModel model = component.model;
  model.M = scale * model.M * scale;
  model.C = scale * model.C * scale;
  model.K = scale * model.K * scale;
  if (model.has_structural_damping()) model.D = scale * model.D * scale;
  model.dofs = dofs;
  return model;
}

/// A component of fewer coordinates than its points have DOFs: its receptance has rank `size` at most.
inline dynamics::SpatialModel random_rank_deficient_component(const std::vector<std::string>& points, int size,
                                                              Damping damping, double mass, std::mt19937& random) {
  dynamics::SpatialModel model = random_component(size, points, damping, mass, random).model;
  model.dofs = six_components(points);
  const Eigen::VectorXd per_length = unit_lengths(model.dofs).cwiseInverse();
  model.T = per_length.asDiagonal() * random_matrix(static_cast<Eigen::Index>(model.dofs.size()), size, random);
  return model;
}

/// Largest |G − G_other| over the largest |G| of the line, each of the four kinds of entries (m/N, m/(N m), rad/N,
/// rad/(N m)) for itself.
inline double difference_by_kind(const dynamics::ResponseModel& G, const dynamics::ResponseModel& other) {
  double largest = 0.0;
  const auto rows = [](const dynamics::DofTable& dofs, dynamics::DofKind kind) {
    std::vector<Eigen::Index> of_kind;
    for (std::size_t i = 0; i < dofs.size(); ++i) {
      if (dofs[i].kind == kind) of_kind.push_back(static_cast<Eigen::Index>(i));
    }
    return of_kind;
  };
  for (const auto row_kind : {dynamics::DofKind::translation, dynamics::DofKind::rotation}) {
    for (const auto column_kind : {dynamics::DofKind::translation, dynamics::DofKind::rotation}) {
      const auto row = rows(G.responses, row_kind), column = rows(G.forces, column_kind);
      if (row.empty() || column.empty()) continue;
      for (std::size_t line = 0; line < G.H.size(); ++line) {
        const Eigen::MatrixXcd block = G.H[line](row, column);
        const Eigen::MatrixXcd difference = block - other.H[line](row, column);
        const double relative = difference.cwiseAbs().maxCoeff() / block.cwiseAbs().maxCoeff();
        if (!(relative <= largest)) largest = relative;  // a NaN stays
      }
    }
  }
  return largest;
}

}  // namespace thinwall::coupling::testing
