#include <limits>

#include "core/error.hpp"
#include "coupling/spatial.hpp"

namespace thinwall::coupling {

namespace {

using Complex = std::complex<double>;
using dynamics::SpatialModel;

std::vector<std::pair<const Contact*, const ContactSpring*>> all_springs(const std::vector<Contact>& contacts) {
  std::vector<std::pair<const Contact*, const ContactSpring*>> springs;
  for (const Contact& contact : contacts) {
    for (const ContactSpring& spring : contact.springs) springs.emplace_back(&contact, &spring);
  }
  return springs;
}

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
  require_valid(contacts);
  require_consistent(part);
  dynamics::require_equal(robot.axis, axis);
  const auto springs = all_springs(contacts);
  const Eigen::Index n = part.size(), m = static_cast<Eigen::Index>(springs.size());
  Eigen::MatrixXd B_P(n, m), B_response(robot.responses.size(), m), B_force(robot.forces.size(), m);
  for (Eigen::Index j = 0; j < m; ++j) {
    const auto& [contact, spring] = springs[static_cast<std::size_t>(j)];
    B_P.col(j) = coordinate_row(part, contact->part_point, spring->direction);
    B_response.col(j) = dynamics::displacement_row(robot.responses, contact->robot_point, spring->direction);
    B_force.col(j) = dynamics::displacement_row(robot.forces, contact->robot_point, spring->direction);
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
  const auto add_joint_and_robot = [&](Eigen::Index line, Eigen::MatrixXcd& matrix) {
    auto W = matrix.bottomRightCorner(m, m);
    W -= B_response.transpose() * robot.H[static_cast<std::size_t>(line)] * B_force;
    for (Eigen::Index j = 0; j < m; ++j) {
      const ContactSpring& spring = *springs[static_cast<std::size_t>(j)].second;
      if (spring.rigid()) continue;
      const double loss = spring.stiffness * spring.loss_factor + axis.omega_rad_s(line) * spring.damping;
      W(j, j) -= 1.0 / Complex(spring.stiffness, loss);
    }
  };
  return dynamics::direct_response(system, axis, add_joint_and_robot);
}

}  // namespace thinwall::coupling
