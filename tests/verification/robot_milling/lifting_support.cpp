#include "tests/verification/robot_milling/lifting_support.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"

namespace thinwall::testing {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

MatrixXd side_by_side(const MatrixXd& a, const MatrixXd& b) {
  MatrixXd both = MatrixXd::Zero(a.rows() + b.rows(), a.cols() + b.cols());
  both.topLeftCorner(a.rows(), a.cols()) = a;
  both.bottomRightCorner(b.rows(), b.cols()) = b;
  return both;
}

void require_usable(const dynamics::SpatialModel& part, const dynamics::SpatialModel& robot,
                    const LiftingContact& contact) {
  require_consistent(part);
  require_consistent(robot);
  if (part.has_structural_damping() || robot.has_structural_damping())
    throw core::InputError("a contact that lifts: structural damping has no motion in time; take viscous damping");
  if (std::abs(contact.pressing.norm() - 1.0) > 1e-9)
    throw core::InputError("a contact that lifts: the direction along which it presses must be a unit vector");
  if (!(contact.stiffness > 0.0) || !std::isfinite(contact.stiffness) || !(contact.damping >= 0.0) ||
      !(contact.preload_n >= 0.0)) {
    throw core::InputError(fmt::format(
        "a contact that lifts: stiffness {} N/m, damping {} N s/m, preload {} N; the first must be positive and "
        "finite, the others not negative",
        contact.stiffness, contact.damping, contact.preload_n));
  }
}

/// Part and robot without a joint, and what they do in it.
struct Assembly {
  MatrixXd M, C, K;
  VectorXd b;            ///< d = b·y
  Eigen::Matrix3Xd cut;  ///< displacement of the part at the cut, tool axes
  LiftingContact contact;
};

/// Newmark's matrix of the closed and of the open contact, for a step of time.
struct StepMatrices {
  double dt_s = 0.0;
  Eigen::PartialPivLU<MatrixXd> closed, open;
};

StepMatrices step_matrices(const Assembly& of, double dt) {
  const MatrixXd open = of.M + 0.5 * dt * of.C + 0.25 * dt * dt * of.K;
  const double in_contact = 0.5 * dt * of.contact.damping + 0.25 * dt * dt * of.contact.stiffness;
  return {dt, Eigen::PartialPivLU<MatrixXd>(MatrixXd(open + in_contact * of.b * of.b.transpose())),
          Eigen::PartialPivLU<MatrixXd>(open)};
}

/// The motion, and its last step.
struct Lifting {
  Assembly of;
  StepMatrices step;
  VectorXd q, rate, acceleration;
  std::shared_ptr<ContactHistory> history;

  /// λ as if the contact pulled, too.
  [[nodiscard]] double closed_n() const {
    return of.contact.stiffness * of.b.dot(q) + of.contact.damping * of.b.dot(rate);
  }
  [[nodiscard]] milling::ToolPlace place() const { return {-of.cut * q, -of.cut * rate}; }
};

/// The end of a step under a force on the part: with a contact that holds, else without.
void solve(Lifting& at, const VectorXd& q_free, const VectorXd& rate_free, const VectorXd& load) {
  const double dt = at.step.dt_s;
  const LiftingContact& contact = at.of.contact;
  const VectorXd driven = load - at.of.C * rate_free - at.of.K * q_free;
  const double free_n = contact.stiffness * at.of.b.dot(q_free) + contact.damping * at.of.b.dot(rate_free);
  const auto end = [&](VectorXd acceleration) {
    at.acceleration = std::move(acceleration);
    at.q = q_free + 0.25 * dt * dt * at.acceleration;
    at.rate = rate_free + 0.5 * dt * at.acceleration;
  };
  end(at.step.closed.solve(VectorXd(driven - free_n * at.of.b)));
  if (at.closed_n() < -contact.preload_n) end(at.step.open.solve(VectorXd(driven + contact.preload_n * at.of.b)));
}

milling::MovedStep advance(Lifting& at, double dt, const milling::ForceOnTool& force) {
  constexpr int most_passes = 30;
  if (dt != at.step.dt_s) at.step = step_matrices(at.of, dt);
  const VectorXd q_free = at.q + dt * at.rate + 0.25 * dt * dt * at.acceleration;
  const VectorXd rate_free = at.rate + 0.5 * dt * at.acceleration;
  Vector3d last = Vector3d::Constant(std::numeric_limits<double>::infinity());
  bool settled = false;
  for (int pass = 0; pass < most_passes && !settled; ++pass) {
    const Vector3d f = force(at.place());
    settled = (f - last).norm() <= 1e-10 * f.norm();
    last = f;
    if (!settled) solve(at, q_free, rate_free, -at.of.cut.transpose() * f);
  }
  const double pressed = std::max(0.0, at.closed_n() + at.of.contact.preload_n);
  ContactHistory& history = *at.history;
  history.simulated_s += dt;
  if (pressed == 0.0) {
    history.open_s += dt;
    history.widest_m =
        std::max(history.widest_m, -at.of.b.dot(at.q) - at.of.contact.preload_n / at.of.contact.stiffness);
  }
  history.largest_n = std::max(history.largest_n, pressed);
  history.least_n = std::min(history.least_n, pressed);
  return {at.place(), settled};
}

}  // namespace

LiftingSupport lifting_support(const dynamics::SpatialModel& part, const dynamics::SpatialModel& robot,
                               const LiftingContact& contact, const std::string& cut_point,
                               const milling::ToolFrame& frame) {
  require_usable(part, robot, contact);
  const Index n = part.size(), all = n + robot.size();
  Assembly of{side_by_side(part.M, robot.M), side_by_side(part.C, robot.C),  side_by_side(part.K, robot.K),
              VectorXd::Zero(all),           Eigen::Matrix3Xd::Zero(3, all), contact};
  of.b.head(n) = dynamics::coordinate_row(part, contact.part_point, contact.pressing);
  of.b.tail(robot.size()) = -dynamics::coordinate_row(robot, contact.robot_point, contact.pressing);
  const Eigen::Matrix3d R = frame.rotation();
  for (Index i = 0; i < 3; ++i) of.cut.row(i).head(n) = dynamics::coordinate_row(part, cut_point, R.col(i));
  const auto history = std::make_shared<ContactHistory>();
  const VectorXd rest = VectorXd::Zero(all);
  const auto motion = std::make_shared<Lifting>(Lifting{std::move(of), {}, rest, rest, rest, history});
  return {{{}, [motion](double dt, const milling::ForceOnTool& force) { return advance(*motion, dt, force); }},
          history};
}

}  // namespace thinwall::testing
