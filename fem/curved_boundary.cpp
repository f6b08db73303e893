#include "fem/curved_boundary.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
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
constexpr int halvings = 4;                // of displacements that spoil an element, before they are left out
constexpr int most_passes = 20;            // before all is left straight

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
  std::vector<double> share;      // of the full displacement that is applied, of each node
};

Moves moves_of(const mesh::SmoothPatches& surface, const mesh::TetMesh& mesh, const mesh::LagrangeNodes& nodes) {
  const BoundaryPatches boundary = boundary_patches(surface, mesh);
  const auto alphas = mesh::lattice(nodes.order);
  const auto count = static_cast<std::size_t>(nodes.positions.rows());
  Moves result{Eigen::MatrixXd::Zero(nodes.positions.rows(), 3), std::vector<bool>(count, false),
               std::vector<double>(count, 1.0)};
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

/// The volumes of elements and their least det J over its mean, negative for one turned inside out.
struct Jacobians {
  Eigen::VectorXd volume, least;
};

/// The Jacobians at points at which the elements may be integrated: columns of positions by the slopes at all points at
/// once, a row each, in one product for each direction of the reference element.
Jacobians jacobians(const mesh::LagrangeNodes& nodes, const Positions& positions) {
  const TetQuadrature rule = tet_quadrature(points_of_check);
  const Eigen::Index points = rule.weight.size();
  std::array<Eigen::MatrixXd, 3> slopes;
  slopes.fill(Eigen::MatrixXd(points, nodes.elements.cols()));
  for (Eigen::Index q = 0; q < points; ++q) {
    const Eigen::MatrixX3d at_point = shape_slopes(nodes.order, rule.lambda.col(q));
    for (std::size_t k = 0; k < 3; ++k) slopes[k].row(q) = at_point.col(static_cast<Eigen::Index>(k));
  }
  Jacobians result{Eigen::VectorXd(nodes.elements.rows()), Eigen::VectorXd(nodes.elements.rows())};
  core::parallel_for(static_cast<std::size_t>(nodes.elements.rows()), [&](std::size_t i) {
    const auto e = static_cast<Eigen::Index>(i);
    const Eigen::MatrixX3d x = positions(nodes.elements.row(e), Eigen::all);
    std::array<Eigen::ArrayX3d, 3> along;
    for (std::size_t k = 0; k < 3; ++k) {
      along[k].resize(points, 3);
      for (Eigen::Index c = 0; c < 3; ++c) along[k].col(c) = slopes[k] * x.col(c);
    }
    const auto& [u, v, w] = along;
    const Eigen::ArrayXd jacobian = u.col(0) * (v.col(1) * w.col(2) - v.col(2) * w.col(1)) +
                                    u.col(1) * (v.col(2) * w.col(0) - v.col(0) * w.col(2)) +
                                    u.col(2) * (v.col(0) * w.col(1) - v.col(1) * w.col(0));
    result.volume(e) = rule.weight.dot(jacobian.matrix()) / 6.0;
    result.least(e) = jacobian.minCoeff() / std::abs(jacobian.mean());
  });
  return result;
}

/// Halves the displacements of the boundary at the spoilt elements, or leaves them out; where an element has none of
/// its own, at the elements that share a vertex with it.
void spare(Moves& moves, const mesh::LagrangeNodes& nodes, const std::vector<Eigen::Index>& spoilt, bool leave_out) {
  const auto lessen = [&](Eigen::Index e) {
    bool any = false;
    for (const int node : nodes.elements.row(e)) {
      double& share = moves.share[static_cast<std::size_t>(node)];
      if (share == 0.0 || moves.full.row(node).isZero(0.0)) continue;
      any = true;
      share = leave_out ? 0.0 : 0.5 * share;
    }
    return any;
  };
  std::vector<bool> around(moves.share.size(), false);
  for (const Eigen::Index e : spoilt)
    if (!lessen(e))
      for (Eigen::Index k = 0; k < 4; ++k) around[static_cast<std::size_t>(nodes.elements(e, k))] = true;
  for (Eigen::Index e = 0; e < nodes.elements.rows(); ++e)
    for (Eigen::Index k = 0; k < 4; ++k)
      if (around[static_cast<std::size_t>(nodes.elements(e, k))]) (void)lessen(e);
}

/// The shape with the boundary on the surface, as far as no element is spoilt.
CubicShape moved(Moves moves, mesh::LagrangeNodes nodes) {
  const HarmonicExtension extension(nodes, moves.on_boundary);
  for (int pass = 0; pass < most_passes; ++pass) {
    const Eigen::Map<const Eigen::VectorXd> share(moves.share.data(), moves.full.rows());
    const Positions positions = nodes.positions + extension.extended(share.asDiagonal() * moves.full);
    const Jacobians now = jacobians(nodes, positions);
    std::vector<Eigen::Index> spoilt;
    for (Eigen::Index e = 0; e < now.least.size(); ++e)
      if (!(now.least(e) >= smallest_jacobian)) spoilt.push_back(e);
    if (spoilt.empty()) {
      nodes.positions = positions;
      return {std::move(nodes), now.volume.sum()};
    }
    spare(moves, nodes, spoilt, pass >= halvings);
  }
  const double straight = jacobians(nodes, nodes.positions).volume.sum();
  return {std::move(nodes), straight};
}

}  // namespace

CubicShape curved_onto(const mesh::SmoothPatches& surface, const mesh::TetMesh& mesh) {
  mesh::LagrangeNodes nodes = mesh::lagrange_nodes(mesh, order_of_shape);
  Moves moves = moves_of(surface, mesh, nodes);
  return moved(std::move(moves), std::move(nodes));
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
