#include "study/simulation/arm_pass.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "robot/newmark.hpp"

namespace thinwall::study {

namespace {

using Eigen::Vector3d;

/// The arm on its way: its motion, its time, and the place that its motors are told.
struct Feeding {
  const ArmPass& pass;
  robot::SpeedProfile profile;
  Eigen::Matrix3d to_part;  ///< of the tool's axes
  robot::JointMotion motion;
  Eigen::VectorXd told;
  double time_s = 0.0;

  [[nodiscard]] Vector3d place_at(double time) const {
    return pass.from + robot::along_line(profile, time).distance_m * to_part.col(0);
  }
};

/// Displacement beside the place that the motors are told, and velocity beside the steady feed.
milling::ToolPlace place_of(const Feeding& arm, double time_s, const robot::ArmPose& at, const Eigen::VectorXd& rate) {
  const Eigen::Matrix3Xd J = robot::translation_jacobian(at, at.tip.translation(), at.joints() - 1);
  const Vector3d fed = robot::along_line(arm.profile, time_s).speed_m_s * arm.to_part.col(0);
  return {arm.to_part.transpose() * (at.tip.translation() - arm.place_at(time_s)),
          arm.to_part.transpose() * (J * rate - fed)};
}

/// A step of time. Where a number of it is none, so is its place.
milling::MovedStep advance(Feeding& arm, double dt_s, const milling::ForceOnTool& force) {
  const double end_s = arm.time_s + dt_s;
  arm.told = robot::posture_at(arm.pass.arm.arm, arm.place_at(end_s), arm.told);
  robot::ArmStep step = robot::newmark_step(
      arm.pass.arm, arm.motion, dt_s, arm.told, [&](const robot::ArmPose& at, const robot::JointMotion& motion) {
        return Vector3d(arm.to_part * force(place_of(arm, end_s, at, motion.rate)));
      });
  arm.motion = std::move(step.motion);
  arm.time_s = end_s;
  if (step.status == robot::StepStatus::not_finite) return {{Vector3d::Constant(NAN), Vector3d::Constant(NAN)}, false};
  return {place_of(arm, end_s, step.at, arm.motion.rate), step.status == robot::StepStatus::converged};
}

/// Without force up to a time.
void approach(Feeding& arm, double until_s) {
  const int steps = static_cast<int>(std::ceil(until_s / arm.pass.approach_step_s));
  for (int i = 0; i < steps; ++i) {
    const auto none = [](const milling::ToolPlace&) -> Vector3d { return Vector3d::Zero(); };
    if (!advance(arm, until_s / steps, none).settled) {
      throw core::NumericalError(fmt::format(
          "the arm does not settle {:.4f} s after its feed began; take smaller steps of the approach", arm.time_s));
    }
  }
}

}  // namespace

ArmPassResult simulate_arm_pass(const ArmPass& pass, const milling::MillingProcess& process,
                                const milling::ForceLaw& law, const milling::SimulatedPoint& point,
                                milling::Stock stock, const milling::SimulationOptions& options,
                                const milling::PathOptions& paths, const milling::TurnObserver& after_turn) {
  const double speed = point.feed_per_tooth_m * process.cutter.teeth * point.spindle_speed_rpm / 60.0;
  const double free_s = pass.free_turns * 60.0 / point.spindle_speed_rpm;
  const robot::SpeedProfile profile{speed, pass.rise_s, pass.steady_s};
  if (!(pass.contact_s - free_s >= profile.length_s()) || !(pass.approach_step_s > 0.0)) {
    throw core::InputError(fmt::format(
        "the tool meets the material {} s after its feed begins, {} s of them marched finely in steps of {} s before: "
        "the feed is steady after {} s; let it begin earlier, and give a positive step",
        pass.contact_s, free_s, pass.approach_step_s, profile.length_s()));
  }
  robot::require_valid(pass.arm);
  const Eigen::VectorXd first = robot::posture_at(pass.arm.arm, pass.from, pass.posture);
  Feeding arm{pass, profile, process.frame.rotation(), robot::at_rest(pass.arm, first, Vector3d::Zero()), first};
  ArmPassResult result;
  result.began_s = pass.contact_s - free_s;
  approach(arm, result.began_s);
  stock.push_back(milling::border_ahead(process.cutter, free_s * speed));
  const milling::MovedTool tool{
      place_of(arm, arm.time_s, robot::pose(pass.arm.arm, arm.motion.q), arm.motion.rate),
      [&arm](double dt_s, const milling::ForceOnTool& force) { return advance(arm, dt_s, force); }};
  result.before_m = tool.start.displacement_m;
  result.cut = milling::simulate_exact_path(tool, process, law, point, stock, options, paths, after_turn);
  return result;
}

}  // namespace thinwall::study
