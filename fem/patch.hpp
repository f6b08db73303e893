#pragma once
// A patch of the part's surface as a point with six degrees of freedom, whose displacement and rotation follow from
// those of the nodes.

#include <Eigen/Core>
#include <string>
#include <variant>
#include <vector>

#include "mesh/lagrange_nodes.hpp"
#include "mesh/selection.hpp"
#include "mesh/solid/locate.hpp"
#include "mesh/tet_mesh.hpp"

namespace thinwall::fem {

using mesh::Disc;

/// A patch: a disc, or all faces of a region. Both are looked up on the straight mesh.
using Patch = std::variant<Disc, mesh::Region>;

/// Averages over a patch of area A: N_a are the shape functions of its nodes, x the true position, c = ∫ x dA / A and r
/// = x − c.
struct PatchAverage {
  std::vector<int> nodes;     ///< ascending
  Eigen::VectorXd share;      ///< ∫ N_a dA / A, sum 1
  Eigen::Matrix3Xd moment_m;  ///< ∫ N_a r dA / A, sum 0
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d spread_m2 = Eigen::Matrix3d::Zero();  ///< J = ∫ (r·r I − r rᵀ) dA / A
};

/// The averages over a patch, of a disc over the parts of its faces (mesh::disc_face()) that lie in it, exact for
/// straight faces, and of a region over its faces. A disc of no radius is the place itself. Throws InputError, with
/// `name`, if the disc lies off the part or the region holds no face. Cost O(tets) to find the patch.
[[nodiscard]] PatchAverage patch_average(const mesh::TetMesh& mesh, const mesh::LagrangeNodes& nodes,
                                         const Patch& patch, const std::string& name);

/// The inverse J⁻¹ of the spread. Throws InputError, with `name`, for a patch that is a single point or lies on a line,
/// whose rotation about itself its displacements do not determine: the smallest eigenvalue of J is then below 1e-8 of
/// the largest.
[[nodiscard]] Eigen::Matrix3d inverse_spread(const PatchAverage& average, const std::string& name);

/// The six functionals of the averaging connection, which is the rigid motion of the patch about c nearest to its
/// displacement: it minimises ∫ |u − (u_c + θ × r)|² dA by
///
///     u_c = Σ_a share_a u_a,   θ = J⁻¹ Σ_a moment_a × u_a
///
/// (docs/theory/elements.md, Eq. A3; the RBE3 element of MacNeal 1972 with the reference point at the centre and the
/// area as weights). Returns the part of the a-th node of the patch, 6 × 3, rows [u_c θ]. The transpose distributes a
/// force evenly and a moment without net force. With `J_inverse` zero the rotation is left out.
[[nodiscard]] Eigen::Matrix<double, 6, 3> motion_of_node(const PatchAverage& average, Eigen::Index a,
                                                         const Eigen::Matrix3d& J_inverse);

/// The matrix [r]× with [r]× b = r × b.
[[nodiscard]] Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& r);

}  // namespace thinwall::fem
