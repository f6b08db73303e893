#include "robot/feed_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <utility>

#include "core/error.hpp"
#include "robot/arm_kinematics.hpp"
#include "robot/inverse_kinematics.hpp"

namespace thinwall::robot {

namespace {

/// The larger of the angles between two postures, whole turns apart.
double apart(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  double most = 0.0;
  for (Eigen::Index i = 0; i < a.size(); ++i)
    most = std::max(most, std::abs(std::remainder(a(i) - b(i), 2.0 * std::numbers::pi)));
  return most;
}

Eigen::VectorXd nearest_four_axis(const SerialArm& arm, const Eigen::Vector3d& place, const Eigen::VectorXd& near) {
  const auto postures = four_axis_postures(arm, place, near.tail<3>().sum());
  Eigen::VectorXd q =
      *std::ranges::min_element(postures, {}, [&](const Eigen::Vector4d& candidate) { return apart(candidate, near); });
  for (Eigen::Index i = 0; i < q.size(); ++i) q(i) = near(i) + std::remainder(q(i) - near(i), 2.0 * std::numbers::pi);
  return q;
}

}  // namespace

AlongLine along_line(const SpeedProfile& profile, double time_s) {
  const double v = profile.speed_m_s, rise = profile.rise_s, steady = profile.steady_s;
  if (!(v > 0.0) || !(rise > 0.0) || !(steady >= 0.0) || !std::isfinite(v + rise + steady)) {
    std::ostringstream text;
    text << "a feed of " << v << " m/s whose acceleration rises for " << rise << " s and stays for " << steady
         << " s: speed and rise must be positive, the other time not negative";
    throw core::InputError(text.str());
  }
  const double top = v / (rise + steady);
  const double jerk = top / rise;
  // Each ramp of the acceleration that begins at t₀ gives ± jerk (t − t₀)³/6 of the distance.
  AlongLine sum;
  for (const auto& [from, sign] :
       {std::pair{0.0, 1.0}, {rise, -1.0}, {rise + steady, -1.0}, {2.0 * rise + steady, 1.0}}) {
    const double t = std::max(0.0, std::min(time_s, profile.length_s()) - from);
    sum.distance_m += sign * jerk * t * t * t / 6.0;
    sum.speed_m_s += sign * jerk * t * t / 2.0;
    sum.acceleration_m_s2 += sign * jerk * t;
  }
  if (time_s >= profile.length_s()) {
    return {sum.distance_m + v * (time_s - profile.length_s()), v, 0.0};
  }
  return sum;
}

Eigen::VectorXd posture_at(const SerialArm& arm, const Eigen::Vector3d& place, const Eigen::VectorXd& near) {
  if (is_four_axis(arm)) return nearest_four_axis(arm, place, near);
  Eigen::Isometry3d target = pose(arm, near).tip;
  target.translation() = place;
  Reached found = reach(arm, target, near);
  if (found.status == ReachStatus::not_reached) {
    std::ostringstream text;
    text << "the tip does not reach (" << place.x() << ", " << place.y() << ", " << place.z()
         << ") m unturned: the search ends " << found.position_error
         << " m beside it; take another posture to begin with, or a shorter path";
    throw core::InputError(text.str());
  }
  return std::move(found.q);
}

}  // namespace thinwall::robot
