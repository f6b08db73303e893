#pragma once
// Sections of summary.json on charts along a path of the cut. Positions are numbered from 1.

#include <string>
#include <vector>

#include "report/summary/robot.hpp"
#include "study/lobes/chart_of.hpp"

namespace thinwall::report {

/// The chart at one position.
struct PositionSummary {
  int position = 0;
  Eigen::Vector3d at_m = Eigen::Vector3d::Zero();
  double minimum_depth_m = 0.0, at_spindle_speed_rpm = 0.0;
  int speeds_stable_to_depth_limit = 0, speeds_not_converged = 0;
  std::optional<double> error_estimate_relative;
  std::optional<PostureSummary> robot;
};

template <class Visitor, Either<PositionSummary> Section>
void fields(Visitor& visit, Section& position) {
  visit(Field{"position", Kind::count, "number of the position"}, position.position);
  visit(Field{"at_m", Kind::length, "place of the cut, part axes"}, position.at_m);
  visit(Field{"minimum_depth_m", Kind::length, "least limiting depth of all speeds"}, position.minimum_depth_m);
  visit(Field{"at_spindle_speed_rpm", Kind::spindle_speed, "speed of that"}, position.at_spindle_speed_rpm);
  visit(Field{"speeds_stable_to_depth_limit", Kind::count, "speeds without a limit up to the deepest cut"},
        position.speeds_stable_to_depth_limit);
  visit(Field{"speeds_not_converged", Kind::count, "speeds that did not reach the tolerance"},
        position.speeds_not_converged);
  visit(Field{"error_estimate_relative", Kind::error_estimate, "largest estimate of a row; null: not known",
              Presence::or_null},
        position.error_estimate_relative);
  visit(Field{"robot", Kind::section, "posture of the robot there"}, position.robot);
}

/// The speed at which the whole path allows the most.
struct EverywhereSummary {
  double spindle_speed_rpm = 0.0, depth_m = 0.0;
  bool at_depth_limit = false;
  int limited_at_position = 0;
};

template <class Visitor, Either<EverywhereSummary> Section>
void fields(Visitor& visit, Section& best) {
  visit(Field{"spindle_speed_rpm", Kind::spindle_speed, "spindle speed"}, best.spindle_speed_rpm);
  visit(Field{"depth_m", Kind::length, "depth that is stable at every position"}, best.depth_m);
  visit(Field{"at_depth_limit", Kind::truth, "true if no limit was found up to the deepest cut"}, best.at_depth_limit);
  visit(Field{"limited_at_position", Kind::count, "number of the position that limits it"}, best.limited_at_position);
}

/// The limit of the whole path at the case's own speed.
struct PathCaseSpeedSummary {
  double spindle_speed_rpm = 0.0, limiting_depth_m = 0.0;
  bool at_depth_limit = false;
  int limited_at_position = 0;
  std::optional<double> error_estimate_relative;
  std::string status;
  int positions_not_converged = 0;
};

template <class Visitor, Either<PathCaseSpeedSummary> Section>
void fields(Visitor& visit, Section& row) {
  visit(Field{"spindle_speed_rpm", Kind::spindle_speed, "spindle speed"}, row.spindle_speed_rpm);
  visit(Field{"limiting_depth_m", Kind::length, "depth that is stable at every position"}, row.limiting_depth_m);
  visit(Field{"at_depth_limit", Kind::truth, "true if no limit was found up to the deepest cut"}, row.at_depth_limit);
  visit(Field{"limited_at_position", Kind::count, "number of the position that limits it"}, row.limited_at_position);
  visit(Field{"error_estimate_relative", Kind::error_estimate, "estimated relative error of the depth; null: not known",
              Presence::or_null},
        row.error_estimate_relative);
  visit(Field{"status", Kind::text, "status of the row that limits it"}, row.status);
  visit(Field{"positions_not_converged", Kind::count, "positions that did not reach the tolerance"},
        row.positions_not_converged);
}

/// Charts of one structure along the path.
struct PathSummary {
  study::ChartOf name = study::ChartOf::part;
  std::string method, support;
  long speeds = 0;
  PositionSummary weakest;
  EverywhereSummary deepest_everywhere;
  std::optional<double> error_estimate_relative;
  int rows_not_converged = 0;
  std::vector<PositionSummary> positions;
  std::optional<PathCaseSpeedSummary> at_case_speed;
};

template <class Visitor, Either<PathSummary> Section>
void fields(Visitor& visit, Section& path) {
  visit(Field{"name", Kind::text, "structure of the charts"}, path.name);
  visit(Field{"method", Kind::text, "method in words"}, path.method);
  visit(Field{"support", Kind::text, "\"follows\" if the robot follows the cut, else \"held\""}, path.support);
  visit(Field{"speeds", Kind::count, "spindle speeds"}, path.speeds);
  visit(Field{"weakest", Kind::section, "position with the least depth"}, path.weakest);
  visit(Field{"deepest_everywhere", Kind::section, "speed at which the whole path allows the most"},
        path.deepest_everywhere);
  visit(Field{"error_estimate_relative", Kind::error_estimate, "largest estimate of a row; null: not known",
              Presence::or_null},
        path.error_estimate_relative);
  visit(Field{"rows_not_converged", Kind::count, "rows that did not reach the tolerance"}, path.rows_not_converged);
  visit(Field{"positions", Kind::section, "every position"}, path.positions);
  visit(Field{"at_case_speed", Kind::section, "the whole path at the case's own speed"}, path.at_case_speed);
}

}  // namespace thinwall::report
