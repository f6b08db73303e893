#pragma once
// Sections of summary.json on the robot: its posture, modes and static stiffness.

#include <string>
#include <vector>

#include "report/summary/field.hpp"

namespace thinwall::report {

/// A mode of the robot, or of part and robot together.
struct ModeSummary {
  double frequency_hz = 0.0;
  std::optional<double> damping_ratio;
};

template <class Visitor, Either<ModeSummary> Section>
void fields(Visitor& visit, Section& mode) {
  visit(Field{"frequency_hz", Kind::frequency, "natural frequency"}, mode.frequency_hz);
  visit(Field{"damping_ratio", Kind::ratio, "damping ratio; null: not known", Presence::or_null}, mode.damping_ratio);
}

/// The posture of the robot, as far as its model has one.
struct PostureSummary {
  std::optional<Eigen::Vector3d> preload_n;
  std::optional<std::vector<double>> joints_rad;
  std::optional<Eigen::Vector3d> tip_m;
  std::optional<double> smallest_singular_value;
  std::optional<std::vector<Eigen::Vector3d>> arm_m;
};

template <class Visitor, Either<PostureSummary> Section>
void fields(Visitor& visit, Section& posture) {
  visit(Field{"preload_n", Kind::force, "preload on the tip, part axes; absent: none"}, posture.preload_n);
  visit(Field{"joints_rad", Kind::angle, "joint angles of an arm; m of a joint that slides"}, posture.joints_rad);
  visit(Field{"tip_m", Kind::length, "tip of an arm, part axes"}, posture.tip_m);
  visit(Field{"smallest_singular_value", Kind::ratio,
              "smallest singular value of the tip's Jacobian, 1 m a radian, over the largest"},
        posture.smallest_singular_value);
  visit(Field{"arm_m", Kind::length, "places from joint to joint to the tip, part axes"}, posture.arm_m);
}

/// The robot as it stands, and its tip.
struct RobotSummary {
  std::string model;
  std::optional<std::string> carries;
  std::vector<ModeSummary> modes;
  PostureSummary posture;
  std::optional<std::vector<std::optional<double>>> static_stiffness_n_per_m;
  std::optional<std::optional<double>> least_static_stiffness_n_per_m;
  std::optional<Eigen::Vector3d> softest_direction;
};

template <class Visitor, Either<RobotSummary> Section>
void fields(Visitor& visit, Section& robot) {
  visit(Field{"model", Kind::text, "model of the robot"}, robot.model);
  visit(Field{"carries", Kind::text, "\"tool\": the robot mills; absent: it supports the part"}, robot.carries);
  visit(Field{"modes", Kind::section, "modes of the robot; none of one known by measured receptances"}, robot.modes);
  fields(visit, robot.posture);
  visit(Field{"static_stiffness_n_per_m", Kind::stiffness,
              "1/H_nn(0) of the tip along x, y and z of the part; null: it does not move"},
        robot.static_stiffness_n_per_m);
  visit(Field{"least_static_stiffness_n_per_m", Kind::stiffness,
              "the least of that over all directions; null: it does not move"},
        robot.least_static_stiffness_n_per_m);
  visit(Field{"softest_direction", Kind::ratio, "unit vector along which the stiffness is least"},
        robot.softest_direction);
}

}  // namespace thinwall::report
