#include "fem/curved_boundary.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "core/parallel.hpp"
#include "fem/harmonic_extension.hpp"
#include "fem/interpolation.hpp"
#include "fem/quadrature.hpp"
#include "fem/reference_element.hpp"

namespace thinwall::fem {

namespace {

using Positions = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

constexpr int order_of_shape = 3;
constexpr int points_of_check = 8;         // in a direction: those at which elements of order 6 are integrated
constexpr double smallest_jacobian = 0.1;  // over the mean of an element
constexpr double lesser = 0.7;             // the factor on displacements that spoil an element
constexpr int lessenings = 8;              // before they are left out

/// The patches that the faces and edges of a mesh's boundary represent, by their vertices, ascending: that of a face,
/// twice, and those of the two faces beside an edge; −1 is none that is known.
using BoundaryPatches = std::map<std::vector<int>, std::array<int, 2>>;

std::vector<int> ascending(std::vector<int> vertices) {
  std::ranges::sort(vertices);
  return vertices;
}

BoundaryPatches boundary_patches(const mesh::SmoothPatches& surface, const mesh::TetMesh& mesh) {
  BoundaryPatches result;
  for (const mesh::BoundaryTriangle& triangle : mesh::boundary(mesh)) {
    const auto& v = triangle.vertices;
    const int patch = mesh::patch_beneath(surface, mesh, triangle);
    result[ascending({v[0], v[1], v[2]})] = {patch, patch};
    for (std::size_t k = 0; k < 3; ++k) {
      result[{v[k]}] = {-1, -1};
      const auto [edge, is_new] = result.try_emplace(ascending({v[k], v[(k + 1) % 3]}), std::array{patch, patch});
      if (!is_new) edge->second[1] = patch;
    }
  }
  return result;
}

/// The vertices of an element that the node at a place of its lattice depends on, ascending.
std::vector<int> vertices_of(const mesh::LagrangeNodes& nodes, Eigen::Index element, const std::array<int, 4>& alpha) {
  std::vector<int> result;
  for (std::size_t k = 0; k < 4; ++k)
    if (alpha[k] > 0) result.push_back(nodes.elements(element, static_cast<Eigen::Index>(k)));
  return ascending(std::move(result));
}

/// The place to which a node at x goes that represents two patches, or twice one; x if one of them is not known or if
/// both are planar.
Eigen::Vector3d place_on(const mesh::SmoothPatches& surface, const std::array<int, 2>& patches,
                         const Eigen::Vector3d& x) {
  if (patches[0] < 0 || patches[1] < 0) return x;
  const auto planar = [&](int patch) { return surface.patches[static_cast<std::size_t>(patch)].planar; };
  if (planar(patches[0]) && planar(patches[1])) return x;
  return mesh::nearest_between(surface, patches[0], patches[1], x);
}

/// The displacements that bring the nodes of the boundary to the surface.
struct Moves {
  Eigen::MatrixXd full;           // nodes × 3, m
  std::vector<bool> on_boundary;  // of each node
};

Moves moves_of(const mesh::SmoothPatches& surface, const mesh::TetMesh& mesh, const mesh::LagrangeNodes& nodes) {
  const BoundaryPatches boundary = boundary_patches(surface, mesh);
  const auto alphas = mesh::lattice(nodes.order);
  const auto count = static_cast<std::size_t>(nodes.positions.rows());
  Moves result{Eigen::MatrixXd::Zero(nodes.positions.rows(), 3), std::vector<bool>(count, false)};
  for (Eigen::Index e = 0; e < nodes.elements.rows(); ++e) {
    for (std::size_t a = 0; a < alphas.size(); ++a) {
      const int node = nodes.elements(e, static_cast<Eigen::Index>(a));
      if (result.on_boundary[static_cast<std::size_t>(node)]) continue;
      const auto found = boundary.find(vertices_of(nodes, e, alphas[a]));
      if (found == boundary.end()) continue;
      result.on_boundary[static_cast<std::size_t>(node)] = true;
      const Eigen::Vector3d x = nodes.positions.row(node).transpose();
      result.full.row(node) = (place_on(surface, found->second, x) - x).transpose();
    }
  }
  return result;
}

/// The volume of an element and its least det J over its mean, negative if it is turned inside out.
struct Jacobian {
  double volume = 0.0, least = 0.0;
};

/// The slopes of the position within an element at points at which it may be integrated, by the directions of the
/// reference element: points × nodes of order 3.
struct SlopesAtPoints {
  std::array<Eigen::MatrixXd, 3> slopes;
  Eigen::VectorXd weight;
};

/// The slopes in elements of an order up to 3 whose nodes lie on the cubic shape.
SlopesAtPoints slopes_at_points(int order) {
  const TetQuadrature rule = tet_quadrature(points_of_check);
  const Eigen::MatrixXd at_nodes = values_at_nodes(order_of_shape, order);
  SlopesAtPoints result{{}, rule.weight};
  result.slopes.fill(Eigen::MatrixXd(rule.weight.size(), at_nodes.cols()));
  for (Eigen::Index q = 0; q < rule.weight.size(); ++q) {
    const Eigen::MatrixXd along = shape_slopes(order, rule.lambda.col(q)).transpose() * at_nodes;
    for (std::size_t k = 0; k < 3; ++k) result.slopes[k].row(q) = along.row(static_cast<Eigen::Index>(k));
  }
  return result;
}

/// The Jacobian of an element with its nodes at x: columns of x by the slopes at all points at once.
Jacobian jacobian_of(const SlopesAtPoints& at, const Eigen::MatrixX3d& x) {
  std::array<Eigen::ArrayX3d, 3> along;
  for (std::size_t k = 0; k < 3; ++k) {
    along[k].resize(at.weight.size(), 3);
    for (Eigen::Index c = 0; c < 3; ++c) along[k].col(c) = at.slopes[k] * x.col(c);
  }
  const auto& [u, v, w] = along;
  const Eigen::ArrayXd jacobian = u.col(0) * (v.col(1) * w.col(2) - v.col(2) * w.col(1)) +
                                  u.col(1) * (v.col(2) * w.col(0) - v.col(0) * w.col(2)) +
                                  u.col(2) * (v.col(0) * w.col(1) - v.col(1) * w.col(0));
  return {at.weight.dot(jacobian.matrix()) / 6.0, jacobian.minCoeff() / std::abs(jacobian.mean())};
}

/// The numbers of some elements, ascending.
using Elements = std::vector<Eigen::Index>;

/// Multiplies the displacements of all nodes of the spoilt elements by a factor; returns the elements that have a node
/// whose displacement has changed by this.
Elements spare(Eigen::VectorXd& share, const mesh::LagrangeNodes& nodes, const Elements& spoilt, double factor) {
  std::vector<bool> is_less(static_cast<std::size_t>(share.size()), false);
  for (const Eigen::Index e : spoilt)
    for (const int node : nodes.elements.row(e)) is_less[static_cast<std::size_t>(node)] = share(node) > 0.0;
  for (Eigen::Index node = 0; node < share.size(); ++node)
    if (is_less[static_cast<std::size_t>(node)]) share(node) *= factor;
  Elements touched;
  for (Eigen::Index e = 0; e < nodes.elements.rows(); ++e) {
    const auto own = nodes.elements.row(e);
    if (std::any_of(own.begin(), own.end(), [&](int node) { return is_less[static_cast<std::size_t>(node)]; }))
      touched.push_back(e);
  }
  return touched;
}

/// The elements from a list that are spoilt, at one of the orders, with their nodes at these positions; the Jacobians
/// of all in the list are updated, with the volume of the first order.
Elements spoilt_among(const Elements& list, const std::vector<SlopesAtPoints>& orders, const mesh::LagrangeNodes& nodes,
                      const Positions& positions, std::vector<Jacobian>& jacobians) {
  core::parallel_for(list.size(), [&](std::size_t i) {
    const Eigen::MatrixX3d x = positions(nodes.elements.row(list[i]), Eigen::all);
    Jacobian& own = jacobians[static_cast<std::size_t>(list[i])] = jacobian_of(orders.front(), x);
    for (const SlopesAtPoints& lower : std::span(orders).subspan(1))
      own.least = std::min(own.least, jacobian_of(lower, x).least);
  });
  Elements result;
  for (const Eigen::Index e : list)
    if (!(jacobians[static_cast<std::size_t>(e)].least >= smallest_jacobian)) result.push_back(e);
  return result;
}

double volume_of(const std::vector<Jacobian>& jacobians) {
  double sum = 0.0;
  for (const Jacobian& jacobian : jacobians) sum += jacobian.volume;
  return sum;
}

/// The shape with the boundary on the surface, as far as no element is spoilt: the nodes of spoilt elements are moved
/// by less, and at last not at all, which leaves those elements straight and others as they were.
CubicShape moved(const Moves& moves, mesh::LagrangeNodes nodes, int lowest_order) {
  const Eigen::MatrixXd whole = HarmonicExtension(nodes, moves.on_boundary).extended(moves.full);
  std::vector<SlopesAtPoints> orders{slopes_at_points(order_of_shape)};
  for (int order = lowest_order; order < order_of_shape; ++order) orders.push_back(slopes_at_points(order));
  Eigen::VectorXd share = (whole.array() != 0.0).rowwise().any().cast<double>();  // of each displacement
  std::vector<Jacobian> jacobians(static_cast<std::size_t>(nodes.elements.rows()));
  Elements asked(jacobians.size());
  std::iota(asked.begin(), asked.end(), Eigen::Index{0});
  for (int pass = 0;; ++pass) {
    const Positions positions = nodes.positions + share.asDiagonal() * whole;
    const Elements spoilt = spoilt_among(asked, orders, nodes, positions, jacobians);
    if (spoilt.empty()) {
      nodes.positions = positions;
      return {std::move(nodes), volume_of(jacobians)};
    }
    asked = spare(share, nodes, spoilt, pass < lessenings ? lesser : 0.0);
  }
}

}  // namespace

CubicShape curved_onto(const mesh::SmoothPatches& surface, const mesh::TetMesh& mesh, int lowest_order) {
  mesh::LagrangeNodes nodes = mesh::lagrange_nodes(mesh, order_of_shape);
  const Moves moves = moves_of(surface, mesh, nodes);
  return moved(moves, std::move(nodes), lowest_order);
}

Shaping shaping_by(std::shared_ptr<const CubicShape> shape) {
  return [shape = std::move(shape)](mesh::LagrangeNodes& nodes) {
    const Eigen::MatrixXd N = values_at_nodes(shape->nodes.order, nodes.order);
    for (Eigen::Index e = 0; e < nodes.elements.rows(); ++e) {
      const Positions x = shape->nodes.positions(shape->nodes.elements.row(e), Eigen::all);
      nodes.positions(nodes.elements.row(e), Eigen::all) = N * x;
    }
  };
}

}  // namespace thinwall::fem
