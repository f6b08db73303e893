#include "report/coupled_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "dynamics/modal_model.hpp"

namespace thinwall::report {

namespace {

/// The displacement of the robot's end from the DOFs of the coupled model, 3 × dofs: of its own point, or, where a
/// rigid contact left the part's point only, of that along the contact's directions. Zero where there is no single
/// contact.
Eigen::Matrix3Xd end_of_robot(const setup::Setup& source, const dynamics::DofTable& dofs) {
  if (source.contacts.empty()) return Eigen::Matrix3Xd::Zero(3, std::ssize(dofs));
  const setup::SupportContact& contact = source.contacts.front();
  const auto has = [&](const std::string& point) { return std::ranges::count(dofs, point, &dynamics::Dof::point) > 0; };
  if (has(contact.robot_point)) return dynamics::displacement_matrix(dofs, contact.robot_point);
  if (!has(contact.part_point)) return Eigen::Matrix3Xd::Zero(3, std::ssize(dofs));
  Eigen::Matrix3d onto = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& n : contact.directions) onto += n * n.transpose();
  return onto * dynamics::displacement_matrix(dofs, contact.part_point);
}

/// Turns a complex mode so that the largest displacement of part (`rows` first entries) and robot is real.
void turn_to_largest(Eigen::VectorXcd& mode, Eigen::Index rows, const Eigen::Matrix3Xd& end) {
  Eigen::VectorXcd moved(rows + 3);
  moved << mode.head(rows), end * mode;
  Eigen::Index largest = 0;
  moved.cwiseAbs().maxCoeff(&largest);
  mode *= std::conj(moved(largest)) / std::abs(moved(largest));
}

/// The largest displacement of part and robot becomes 1.
void scale(Eigen::Ref<Eigen::VectorXd> part, Eigen::Ref<Eigen::Vector3d> robot) {
  const double size = std::max(part.cwiseAbs().maxCoeff(), robot.cwiseAbs().maxCoeff());
  if (size == 0.0) return;
  part /= size;
  robot /= size;
}

}  // namespace

CoupledShapes coupled_shapes(const setup::Setup& source, const study::PartResult& part,
                             const study::CouplingResult& coupled) {
  const dynamics::ModalModel& modal = *coupled.modal;
  const Eigen::MatrixXd& T = part.reduced->T;
  constexpr double round_off = 1e-9;  // a part that moves by less in a mode of the robot is at rest
  const double highest = 2.0 * std::numbers::pi * part.modes.frequency_hz.maxCoeff();
  std::vector<int> drawn;
  for (const int k : dynamics::oscillating_modes(modal)) {
    if (std::abs(modal.poles(k)) > highest) break;
    drawn.push_back(k);
  }
  CoupledShapes shapes;
  Eigen::MatrixXd q = Eigen::MatrixXd::Zero(T.cols(), std::ssize(drawn));
  shapes.robot = Eigen::Matrix3Xd::Zero(3, std::ssize(drawn));
  const Eigen::Matrix3Xd end = end_of_robot(source, modal.dofs);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    Eigen::VectorXcd mode = modal.right.col(drawn[i]);
    turn_to_largest(mode, T.cols(), end);
    const bool at_rest = mode.head(T.cols()).cwiseAbs().maxCoeff() < round_off * mode.cwiseAbs().maxCoeff();
    if (!at_rest) q.col(column) = mode.head(T.cols()).real();
    shapes.robot.col(column) = end * mode.real();
    const auto summary = dynamics::summarise(modal.poles(drawn[i]));
    shapes.frequency_hz.push_back(summary.frequency_hz);
    shapes.damping_ratio.push_back(summary.damping_ratio);
  }
  shapes.part = T * q;
  for (Eigen::Index k = 0; k < shapes.part.cols(); ++k) scale(shapes.part.col(k), shapes.robot.col(k));
  return shapes;
}

}  // namespace thinwall::report
