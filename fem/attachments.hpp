#pragma once
// Attachments of a part: elastic clamps, and points with masses and springs to ground.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "fem/patch.hpp"
#include "mesh/selection.hpp"

namespace thinwall::fem {

/// An elastic clamp on faces, with stiffness per area: its traction on the part is −(k_n n nᵀ + k_t (1 − n nᵀ)) u, n
/// the normal of the face.
struct ElasticClamp {
  std::string name;  ///< name given by the user, for messages
  mesh::Region region;
  double normal_N_m3 = 0.0;      ///< k_n
  double tangential_N_m3 = 0.0;  ///< k_t
};

/// The kind of connection between a point and its patch.
enum class Connection {
  averaging,  ///< the point has the mean motion of the patch, which stays as flexible as it is (RBE3)
  rigid,      ///< the patch moves with the point as one rigid body (RBE2)
};

/// A point with six degrees of freedom at the centre of a patch. A rigid connection stiffens the part even if nothing
/// is attached to the point.
struct ConnectedPoint {
  std::string name;
  Patch patch;
  Connection connection = Connection::averaging;
};

/// A rigid body attached to a connected point.
struct PointMass {
  std::string point;  ///< name of the connected point
  double mass_kg = 0.0;
  Eigen::Matrix3d inertia_kg_m2 = Eigen::Matrix3d::Zero();  ///< about its own centre, in the part's axes
  Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();       ///< from the point to the centre of the body
};

/// Springs from a connected point to ground: they exert the force −k_t u and the moment −k_r θ at the place where they
/// act.
struct GroundSpring {
  std::string point;
  Eigen::Matrix3d translation_N_m = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d rotation_N_m = Eigen::Matrix3d::Zero();  ///< N m/rad
  Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();      ///< from the point to the place where the springs act
};

/// The clamps, points, masses and springs of a part.
struct Attachments {
  std::vector<ElasticClamp> clamps;
  std::vector<ConnectedPoint> points;
  std::vector<PointMass> masses;
  std::vector<GroundSpring> springs;

  /// True if nothing is attached.
  [[nodiscard]] bool empty() const { return clamps.empty() && points.empty() && masses.empty() && springs.empty(); }
};

/// Throws InputError that lists every violation, unless stiffnesses and masses are finite and not negative, matrices
/// symmetric without a negative eigenvalue, moments of inertia those of a body (none above the sum of the others), and
/// points named once each and known.
void validate(const Attachments& attachments);

/// The mass matrix of a body for the motion [u θ] of its point, with o the offset (docs/theory/elements.md, Eq. A4): [m
/// 1, −m [o]×; m [o]×, I − m [o]×²]. 6 × 6, kg, kg m, kg m².
[[nodiscard]] Eigen::Matrix<double, 6, 6> matrix_at_point(const PointMass& mass);

/// The stiffness matrix of springs for the motion [u θ] of their point, with o the offset (docs/theory/elements.md, Eq.
/// A5): Xᵀ diag(k_t, k_r) X with X = [1, −[o]×; 0, 1]. 6 × 6, N/m, N, N m.
[[nodiscard]] Eigen::Matrix<double, 6, 6> matrix_at_point(const GroundSpring& spring);

}  // namespace thinwall::fem
