#include "coupling/spatial.hpp"

namespace thinwall::coupling {

namespace {

using dynamics::SpatialModel;

/// The matrix [matrix, border; borderᵀ, 0].
Eigen::MatrixXd bordered(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& border) {
  const Eigen::Index n = matrix.rows(), m = border.cols();
  Eigen::MatrixXd joined = Eigen::MatrixXd::Zero(n + m, n + m);
  joined.topLeftCorner(n, n) = matrix;
  joined.topRightCorner(n, m) = border;
  joined.bottomLeftCorner(m, n) = border.transpose();
  return joined;
}

}  // namespace

dynamics::ResponseModel direct_response(const SpatialModel& part, const dynamics::ResponseModel& robot,
                                        const std::vector<Contact>& contacts, const dynamics::FrequencyAxis& axis) {
  const Joints joints = coupling::joints(contacts, default_length);
  require_consistent(part);
  dynamics::require_equal(robot.axis, axis);
  dynamics::require_complete(robot);
  require_different_points({&part.dofs, &robot.responses});
  const Eigen::Index n = part.size(), m = joints.size();
  Eigen::MatrixXd B_P(n, m), B_response(robot.responses.size(), m), B_force(robot.forces.size(), m);
  for (Eigen::Index j = 0; j < m; ++j) {
    const auto& [part_point, robot_point, direction, kind, scale, rigid] =
        joints.directions[static_cast<std::size_t>(j)];
    B_P.col(j) = scale * coordinate_row(part, part_point, direction, kind);
    B_response.col(j) = scale * dynamics::displacement_row(robot.responses, robot_point, direction, kind);
    B_force.col(j) = scale * dynamics::displacement_row(robot.forces, robot_point, direction, kind);
  }
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(n, m);
  Eigen::MatrixXd observed = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(part.dofs.size()), n + m);
  observed.leftCols(n) = displacements(part);
  const SpatialModel system{bordered(part.M, none),
                            bordered(part.C, none),
                            bordered(part.K, B_P),
                            part.has_structural_damping() ? bordered(part.D, none) : Eigen::MatrixXd(),
                            part.dofs,
                            observed};
  // The lower right block is −W(ω); it is added line by line, because the robot is known by its response only.
  const auto add_joint_and_robot = [&](Eigen::Index line, Eigen::MatrixXcd& matrix) {
    Eigen::MatrixXcd W = B_response.transpose() * robot.H[static_cast<std::size_t>(line)] * B_force;
    Eigen::MatrixXd unused = Eigen::MatrixXd::Zero(m, m);
    add_compliance(joints, axis.omega_rad_s(line), W, unused);
    matrix.bottomRightCorner(m, m) -= W;
  };
  return dynamics::direct_response(system, axis, add_joint_and_robot);
}

}  // namespace thinwall::coupling
