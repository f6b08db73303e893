#pragma once
// A patch of the part's surface as a point of six degrees of freedom: how its displacement and turn follow from the
// nodes.

#include <Eigen/Core>
#include <string>
#include <variant>
#include <vector>

#include "mesh/lagrange_nodes.hpp"
#include "mesh/selection.hpp"
#include "mesh/tet_mesh.hpp"

namespace thinwall::fem {

/// The disc about a point on the surface (m), cut where it leaves the surface; radius 0: the point itself.
struct Disc {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double radius_m = 0.0;
  double off_m = 0.0;  ///< how far a mesh of chords may lie off the surface that the centre is on (mesh::disc_face)
};

/// A disc, or all faces of a region. Both are looked up on the straight mesh.
using Patch = std::variant<Disc, mesh::Region>;

/// Averages over a patch of area A, N_a the shape functions of its nodes, x the true place, c = ∫ x dA / A, r = x − c.
struct PatchAverage {
  std::vector<int> nodes;     ///< ascending
  Eigen::VectorXd share;      ///< ∫ N_a dA / A, sum 1
  Eigen::Matrix3Xd moment_m;  ///< ∫ N_a r dA / A, sum 0
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d spread_m2 = Eigen::Matrix3d::Zero();  ///< J = ∫ (r·r I − r rᵀ) dA / A
};

/// Over a disc by its samples (mesh::patch_samples), over a region by face_points(). Throws InputError, with `name`, if
/// the disc lies off the part or the region holds no face. Cost O(tets) to look it up.
[[nodiscard]] PatchAverage patch_average(const mesh::TetMesh& mesh, const mesh::LagrangeNodes& nodes,
                                         const Patch& patch, const std::string& name);

/// J⁻¹. Throws InputError, with `name`, for a single point or a line, which does not see the turn about itself: where
/// the smallest eigenvalue of J is below 1e-8 of the largest.
[[nodiscard]] Eigen::Matrix3d inverse_spread(const PatchAverage& average, const std::string& name);

/// The six functionals of the averaging connection, the least-squares rigid motion of the patch about c: that which
/// minimises ∫ |u − (u_c + θ × r)|² dA,
///
///     u_c = Σ_a share_a u_a,   θ = J⁻¹ Σ_a moment_a × u_a
///
/// (the RBE3 element; MacNeal 1972, the reference point at the centre, weights the area). Rows [u_c θ], of the a-th
/// node of the patch: 6 × 3. Its transpose spreads a force evenly and a moment without net force. With `J_inverse` zero
/// the turn is left out.
[[nodiscard]] Eigen::Matrix<double, 6, 3> motion_of_node(const PatchAverage& average, Eigen::Index a,
                                                         const Eigen::Matrix3d& J_inverse);

/// [r]×, with [r]× b = r × b.
[[nodiscard]] Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& r);

}  // namespace thinwall::fem
