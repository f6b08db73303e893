#include "mesh/solid/tet_jacobian.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/error.hpp"

namespace thinwall::mesh {

namespace {

using Corners = Eigen::Matrix4d;  ///< barycentric coordinates of a part's four corners, as columns
using Values = Eigen::Matrix<double, 20, 1>;

/// Barycentric coordinates of the twenty points of a cubic, as columns.
Eigen::Matrix<double, 4, 20> cubic_points() {
  Eigen::Matrix<double, 4, 20> points;
  const auto alphas = lattice(3);
  for (Eigen::Index a = 0; a < 20; ++a)
    for (std::size_t k = 0; k < 4; ++k)
      points(static_cast<Eigen::Index>(k), a) = alphas[static_cast<std::size_t>(a)][k] / 3.0;
  return points;
}

/// The matrix from values at the twenty points to Bernstein coefficients, which is the inverse of the matrix of the
/// values B_α(λ) = 3!/α! λ^α at these points.
Eigen::Matrix<double, 20, 20> bernstein_from_values() {
  const auto alphas = lattice(3);
  const auto points = cubic_points();
  constexpr std::array<double, 4> factorial{1.0, 1.0, 2.0, 6.0};
  Eigen::Matrix<double, 20, 20> B;
  for (Eigen::Index p = 0; p < 20; ++p) {
    for (Eigen::Index b = 0; b < 20; ++b) {
      double value = 6.0;
      for (std::size_t k = 0; k < 4; ++k) {
        const int power = alphas[static_cast<std::size_t>(b)][k];
        for (int i = 0; i < power; ++i) value *= points(static_cast<Eigen::Index>(k), p);
        value /= factorial[static_cast<std::size_t>(power)];
      }
      B(p, b) = value;
    }
  }
  return B.inverse();
}

/// A quadratic element by its corners and the middle of each pair of them.
struct Quadratic {
  Eigen::Matrix<double, 3, 4> corners;
  std::array<std::array<Eigen::Vector3d, 4>, 4> middles;
};

/// The positions of an element's nodes.
Quadratic quadratic(const LagrangeNodes& nodes, Eigen::Index element) {
  static const auto alphas = lattice(2);
  Quadratic q;
  for (std::size_t a = 0; a < alphas.size(); ++a) {
    const Eigen::Vector3d x = nodes.positions.row(nodes.elements(element, static_cast<Eigen::Index>(a))).transpose();
    if (a < 4) {
      q.corners.col(static_cast<Eigen::Index>(a)) = x;
      continue;
    }
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j)
        if (i != j && alphas[a][i] == 1 && alphas[a][j] == 1) q.middles[i][j] = x;
  }
  return q;
}

/// det J at λ. The columns of J are the differences of ∂x/∂λ_k = (4 λ_k − 1) x_k + 4 Σ_{j≠k} λ_j x_kj, k = 1…3, from
/// that for k = 0.
double determinant(const Quadratic& q, const Eigen::Vector4d& lambda) {
  Eigen::Matrix<double, 3, 4> slope;
  for (Eigen::Index k = 0; k < 4; ++k) {
    slope.col(k) = (4.0 * lambda(k) - 1.0) * q.corners.col(k);
    for (Eigen::Index j = 0; j < 4; ++j)
      if (j != k) slope.col(k) += 4.0 * lambda(j) * q.middles[static_cast<std::size_t>(k)][static_cast<std::size_t>(j)];
  }
  const Eigen::Matrix3d J = slope.rightCols<3>().colwise() - slope.col(0);
  return J.determinant();
}

/// The position x(λ), m.
Eigen::Vector3d position(const Quadratic& q, const Eigen::Vector4d& lambda) {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  for (Eigen::Index k = 0; k < 4; ++k) {
    x += lambda(k) * (2.0 * lambda(k) - 1.0) * q.corners.col(k);
    for (Eigen::Index j = k + 1; j < 4; ++j)
      x += 4.0 * lambda(k) * lambda(j) * q.middles[static_cast<std::size_t>(k)][static_cast<std::size_t>(j)];
  }
  return x;
}

/// The eight parts of a tetrahedron divided at the middles of its edges (Bey 1995); `c`: its corners.
std::array<Corners, 8> parts(const Corners& c) {
  const auto mid = [&c](Eigen::Index i, Eigen::Index j) -> Eigen::Vector4d { return 0.5 * (c.col(i) + c.col(j)); };
  const std::array<Eigen::Vector4d, 10> p{c.col(0),  c.col(1),  c.col(2),  c.col(3),  mid(0, 1),
                                          mid(0, 2), mid(0, 3), mid(1, 2), mid(1, 3), mid(2, 3)};
  constexpr std::array<std::array<std::size_t, 4>, 8> corners{
      {{0, 4, 5, 6}, {4, 1, 7, 8}, {5, 7, 2, 9}, {6, 8, 9, 3}, {4, 5, 6, 8}, {4, 5, 7, 8}, {5, 6, 8, 9}, {5, 7, 8, 9}}};
  std::array<Corners, 8> result;
  for (std::size_t i = 0; i < 8; ++i)
    for (std::size_t k = 0; k < 4; ++k) result[i].col(static_cast<Eigen::Index>(k)) = p[corners[i][k]];
  return result;
}

/// The search for the least det J of an element.
struct Search {
  const Quadratic& element;
  double floor;                                            ///< value that det J has to exceed
  double least = std::numeric_limits<double>::infinity();  ///< least value at the points so far
  Eigen::Vector4d at = Eigen::Vector4d::Constant(0.25);    ///< place of the least

  /// The Bernstein coefficients of det J on a part of the element, whose values at the twenty points update `least`.
  Values look_at(const Corners& part) {
    static const Eigen::Matrix<double, 4, 20> points = cubic_points();
    static const Eigen::Matrix<double, 20, 20> to_bernstein = bernstein_from_values();
    Values values;
    for (Eigen::Index p = 0; p < 20; ++p) {
      const Eigen::Vector4d lambda = part * points.col(p);
      values(p) = determinant(element, lambda);
      if (!(values(p) >= least)) {
        least = values(p);
        at = lambda;
      }
    }
    return to_bernstein * values;
  }

  /// True if det J exceeds the floor on the whole part. A value at a point disproves it; Bernstein coefficients above
  /// the floor prove it, because det J is a mean of them with positive weights; otherwise the part is divided, up to
  /// `depth` times, and counts as unsound if that does not decide.
  bool is_above_floor(const Corners& part, int depth) {
    const Values coefficients = look_at(part);
    if (!(least > floor)) return false;
    if (coefficients.minCoeff() > floor) return true;
    if (depth == 0) return false;
    const auto all = parts(part);
    return std::all_of(all.begin(), all.end(), [&](const Corners& c) { return is_above_floor(c, depth - 1); });
  }
};

double longest_edge(const Eigen::Matrix<double, 3, 4>& corners) {
  double squared = 0.0;
  for (Eigen::Index i = 0; i < 4; ++i)
    for (Eigen::Index j = i + 1; j < 4; ++j)
      squared = std::max(squared, (corners.col(i) - corners.col(j)).squaredNorm());
  return std::sqrt(squared);
}

LeastJacobian without_volume(double mean, const Eigen::Matrix<double, 3, 4>& corners) {
  const double l = longest_edge(corners);
  return {l > 0.0 ? mean / (l * l * l) : 0.0, corners.rowwise().mean(), false, false};
}

bool has_volume(double mean, const Eigen::Matrix<double, 3, 4>& corners) {
  return mean > 1e-10 * std::pow(longest_edge(corners), 3);
}

}  // namespace

LeastJacobian least_jacobian(const LagrangeNodes& nodes, Eigen::Index element, double bound) {
  if (nodes.order != 1 && nodes.order != 2)
    throw core::InputError("the Jacobian is bounded for elements of order 1 and 2, not " + std::to_string(nodes.order));
  if (nodes.order == 1) {
    Eigen::Matrix<double, 3, 4> corners;
    for (Eigen::Index k = 0; k < 4; ++k) corners.col(k) = nodes.positions.row(nodes.elements(element, k)).transpose();
    const Eigen::Matrix3d J = corners.rightCols<3>().colwise() - corners.col(0);
    const double mean = J.determinant();
    return has_volume(mean, corners) ? LeastJacobian{1.0, corners.rowwise().mean(), true, true}
                                     : without_volume(mean, corners);
  }
  const Quadratic q = quadratic(nodes, element);
  Search search{q, 0.0};
  const Corners whole = Corners::Identity();
  // The mean of a cubic over the element is the mean of its Bernstein coefficients.
  const double mean = search.look_at(whole).mean();
  if (!has_volume(mean, q.corners)) return without_volume(mean, q.corners);
  search.floor = bound * mean;
  const bool sound = search.is_above_floor(whole, 4);
  return {search.least / mean, position(q, search.at), sound, true};
}

}  // namespace thinwall::mesh
