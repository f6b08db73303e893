#pragma once
// What is attached to a part: elastic clamps, and points with masses and springs to ground.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "fem/patch.hpp"
#include "mesh/selection.hpp"

namespace thinwall::fem {

/// An elastic bed on faces, stiffness per area: traction −(k_n n nᵀ + k_t (1 − n nᵀ)) u, n the face's normal.
struct ElasticClamp {
  std::string name;  ///< what the user called it
  mesh::Region region;
  double normal_N_m3 = 0.0;      ///< k_n
  double tangential_N_m3 = 0.0;  ///< k_t
};

/// How a point holds on to its patch.
enum class Connection {
  averaging,  ///< the point follows the patch in the mean; adds no stiffness of its own (RBE3)
  rigid,      ///< the patch moves with the point as one rigid body (RBE2)
};

/// A point of six degrees of freedom at the centre of a patch. A rigid one stiffens the part though nothing hangs on
/// it.
struct ConnectedPoint {
  std::string name;
  Patch patch;
  Connection connection = Connection::averaging;
};

/// A rigid body on a connected point.
struct PointMass {
  std::string point;  ///< name of the connected point
  double mass_kg = 0.0;
  Eigen::Matrix3d inertia_kg_m2 = Eigen::Matrix3d::Zero();  ///< about its own centre, part axes
  Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();       ///< from the point to its centre
};

/// Springs from a connected point to ground: force −k_t u and moment −k_r θ of the place where they act.
struct GroundSpring {
  std::string point;
  Eigen::Matrix3d translation_N_m = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d rotation_N_m = Eigen::Matrix3d::Zero();  ///< N m/rad
  Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();      ///< from the point to that place
};

/// All that is attached to a part.
struct Attachments {
  std::vector<ElasticClamp> clamps;
  std::vector<ConnectedPoint> points;
  std::vector<PointMass> masses;
  std::vector<GroundSpring> springs;

  /// Whether nothing is.
  [[nodiscard]] bool empty() const { return clamps.empty() && points.empty() && masses.empty() && springs.empty(); }
};

/// Throws InputError with every violation at once: stiffness and mass finite and not negative, matrices symmetric and
/// without a negative eigenvalue, the moments of inertia of a body (none above the sum of the others), names of points
/// given once and known.
void validate(const Attachments& attachments);

/// The body's mass matrix on [u θ] of the point, o the offset: [m 1, −m [o]×; m [o]×, I − m [o]×²]. 6 × 6, kg, kg m,
/// kg m².
[[nodiscard]] Eigen::Matrix<double, 6, 6> matrix_at_point(const PointMass& mass);

/// The springs' stiffness on [u θ] of the point: Xᵀ diag(k_t, k_r) X with X = [1, −[o]×; 0, 1]. 6 × 6, N/m, N, N m.
[[nodiscard]] Eigen::Matrix<double, 6, 6> matrix_at_point(const GroundSpring& spring);

}  // namespace thinwall::fem
