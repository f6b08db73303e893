#include "posture/arm_modes.hpp"

#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <sstream>
#include <string>
#include <utility>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "dynamics/conversion.hpp"
#include "identification/assignment.hpp"
#include "robot/arm_kinematics.hpp"
#include "robot/flexible_joints.hpp"

namespace thinwall::posture {

namespace {

/// Rows over the coordinates of robot::linearised(): the joint's link, less its motor if that turns.
Eigen::MatrixXd stretch_rows(const robot::SerialArm& arm, Eigen::Index coordinates) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(arm.joints(), coordinates);
  Eigen::Index motor = arm.joints();
  for (Eigen::Index i = 0; i < arm.joints(); ++i) {
    rows(i, i) = 1.0;
    if (!arm.links[static_cast<std::size_t>(i)].joint.motor_locked()) rows(i, motor++) = -1.0;
  }
  return rows;
}

/// The stretches of one step, of unit energy each.
Eigen::MatrixXcd energy_shapes(const robot::SerialArm& arm, const ArmModes& modes) {
  Eigen::MatrixXcd shapes = modes.stretch;
  for (Eigen::Index i = 0; i < shapes.rows(); ++i)
    shapes.row(i) *= std::sqrt(arm.links[static_cast<std::size_t>(i)].joint.stiffness);
  return shapes.colwise().normalized();
}

Eigen::MatrixXd turn_of_rows(const Eigen::MatrixXd& rows, const Eigen::Matrix3d& R) {
  Eigen::MatrixXd both = Eigen::MatrixXd::Zero(6, 6);
  both.topLeftCorner(3, 3) = both.bottomRightCorner(3, 3) = R.transpose();
  // P⁺ of independent rows.
  const Eigen::LLT<Eigen::MatrixXd> gram(Eigen::MatrixXd(rows * rows.transpose()));
  Eigen::MatrixXd turn =
      rows * both * rows.transpose() * gram.solve(Eigen::MatrixXd::Identity(rows.rows(), rows.rows()));
  const double error = (turn * turn.transpose() - Eigen::MatrixXd::Identity(rows.rows(), rows.rows())).norm();
  if (!(error <= 1e-6)) {
    std::ostringstream text;
    text << "the tip tilts out of the directions in which it is tapped (by " << error
         << ", bound 1e-6): measure all three directions, or keep the vectors in the world's axes";
    throw core::InputError(text.str());
  }
  return turn;
}

}  // namespace

ArmModes arm_modes(const robot::SerialArm& arm, const Eigen::VectorXd& q) {
  dynamics::SpatialModel model = robot::linearised(arm, {q}, "tip");
  const Eigen::MatrixXd T = model.T;
  model.T.resize(T.rows() + arm.joints(), model.size());
  model.T << T, stretch_rows(arm, model.size());
  for (Eigen::Index i = 0; i < arm.joints(); ++i)
    model.dofs.push_back({std::to_string(i + 1), Eigen::Vector3d::Zero(), dynamics::DofKind::modal});
  const dynamics::ModalModel modal = dynamics::to_modal(model);
  const std::vector<int> oscillating = dynamics::oscillating_modes(modal);
  const Eigen::MatrixXcd shapes =
      modal.right(Eigen::all, oscillating) * modal.scaling(oscillating).cwiseSqrt().cwiseInverse().asDiagonal();
  return {modal.poles(oscillating), shapes.topRows(6), shapes.bottomRows(arm.joints())};
}

std::vector<identification::FittedMode> as_identified(const ArmModes& modes, const TappedArm& tapped) {
  std::vector<identification::FittedMode> result;
  for (Eigen::Index r = 0; r < modes.poles.size(); ++r) {
    identification::FittedMode mode;
    mode.frequency_hz = std::abs(modes.poles(r)) / (2.0 * std::numbers::pi);
    mode.damping_ratio = -modes.poles(r).real() / std::abs(modes.poles(r));
    mode.right = tapped.responses * modes.tip.col(r);
    mode.left = tapped.references * modes.tip.col(r);
    Eigen::Index largest = 0;
    mode.left.cwiseAbs().maxCoeff(&largest);
    const std::complex<double> scale = mode.left(largest);
    mode.residue = mode.right * mode.left.transpose();
    if (scale != 0.0) {
      mode.left /= scale;
      mode.right *= scale;
    }
    result.push_back(std::move(mode));
  }
  return result;
}

Turn tip_turn(const TappedArm& tapped, const Eigen::VectorXd& q) {
  const Eigen::Matrix3d R = robot::pose(tapped.arm, q).tip.linear();
  return {turn_of_rows(tapped.responses, R), turn_of_rows(tapped.references, R)};
}

std::vector<int> followed(const robot::SerialArm& arm, const Eigen::VectorXd& from, const Eigen::VectorXd& to,
                          int steps) {
  Eigen::MatrixXcd before = energy_shapes(arm, arm_modes(arm, from));
  std::vector<int> result(static_cast<std::size_t>(before.cols()));
  std::iota(result.begin(), result.end(), 0);
  for (int k = 1; k <= steps; ++k) {
    const double share = static_cast<double>(k) / steps;
    const Eigen::MatrixXcd now = energy_shapes(arm, arm_modes(arm, (1.0 - share) * from + share * to));
    const Eigen::MatrixXd unlike = 1.0 - (before.adjoint() * now).cwiseAbs2().array();
    const std::vector<int> pair = identification::cheapest_pairing(unlike);
    for (int& mode : result) mode = mode < 0 ? -1 : pair[static_cast<std::size_t>(mode)];
    before = now;
  }
  return result;
}

}  // namespace thinwall::posture
