#pragma once
// The motion that the motors of an arm are told: its tip along a straight line, speeded up without a jolt.

#include <Eigen/Core>

#include "robot/serial_arm.hpp"

namespace thinwall::robot {

/// A speed that rises from rest: the acceleration rises for `rise_s`, stays for `steady_s` and falls for `rise_s`, so
/// that its largest value is v / (rise + steady) and the distance until then v (rise + steady/2) (Huynh 2017).
struct SpeedProfile {
  double speed_m_s = 0.0;  ///< v, > 0
  double rise_s = 0.4;     ///< > 0
  double steady_s = 0.2;   ///< ≥ 0

  /// Time until the speed is steady.
  [[nodiscard]] double length_s() const { return 2.0 * rise_s + steady_s; }
};

/// Distance, speed and acceleration along the line.
struct AlongLine {
  double distance_m = 0.0;
  double speed_m_s = 0.0;
  double acceleration_m_s2 = 0.0;
};

/// The place on the line at a time since the start, s; at rest before it. Throws InputError for times of the profile or
/// a speed out of their bounds.
[[nodiscard]] AlongLine along_line(const SpeedProfile& profile, double time_s);

/// The joint angles that bring the tip to `place` (m, world), the last link as it stands at `near`: of a four-axis arm
/// (four_axis_postures()) the posture next to `near`, at the pitch that it has there; of others that of reach() from
/// `near`, with the tip's frame unturned. Throws InputError for a place that is out of reach.
[[nodiscard]] Eigen::VectorXd posture_at(const SerialArm& arm, const Eigen::Vector3d& place,
                                         const Eigen::VectorXd& near);

}  // namespace thinwall::robot
