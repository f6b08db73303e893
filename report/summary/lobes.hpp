#pragma once
// Sections of summary.json on stability charts, and the cut that they are of.

#include <string>
#include <vector>

#include "report/summary/errors.hpp"
#include "report/summary/field.hpp"
#include "report/summary/forced_over_speed.hpp"
#include "report/summary/learned.hpp"
#include "report/summary/observed.hpp"
#include "study/lobes/chart_of.hpp"

namespace thinwall::report {

/// The cut, as pages and scripts ask for it beside the charts.
struct CuttingSummary {
  int teeth = 0;
  double depth_limit_m = 0.0;
  std::string depth_limit_is;  ///< "tool_length" or "depth_limit"
  std::optional<std::string> at;
  std::optional<double> spindle_speed_rpm;
  std::optional<std::vector<std::optional<double>>> spindle_range_rpm;
};

template <class Visitor, Either<CuttingSummary> Section>
void fields(Visitor& visit, Section& cutting) {
  visit(Field{"teeth", Kind::count, "teeth of the tool"}, cutting.teeth);
  visit(Field{"depth_limit_m", Kind::length, "deepest cut that is looked at"}, cutting.depth_limit_m);
  visit(Field{"depth_limit_is", Kind::text, "\"tool_length\", or \"depth_limit\" if the case says less"},
        cutting.depth_limit_is);
  visit(Field{"at", Kind::text, "point of the part that is cut; absent of a tool alone"}, cutting.at);
  visit(Field{"spindle_speed_rpm", Kind::spindle_speed, "the case's own speed"}, cutting.spindle_speed_rpm);
  visit(Field{"spindle_range_rpm", Kind::spindle_speed, "lowest and highest speed of the machine; null: no bound"},
        cutting.spindle_range_rpm);
}

/// The limit at one speed.
struct RowSummary {
  double spindle_speed_rpm = 0.0, limiting_depth_m = 0.0;
  bool at_depth_limit = false;
  std::optional<double> chatter_frequency_hz;
  std::string bifurcation, status;
  std::optional<double> error_estimate_relative;
};

template <class Visitor, Either<RowSummary> Section>
void fields(Visitor& visit, Section& row) {
  visit(Field{"spindle_speed_rpm", Kind::spindle_speed, "spindle speed"}, row.spindle_speed_rpm);
  visit(Field{"limiting_depth_m", Kind::length, "limiting axial depth of cut"}, row.limiting_depth_m);
  visit(Field{"at_depth_limit", Kind::truth, "true if no limit was found up to the deepest cut"}, row.at_depth_limit);
  visit(Field{"chatter_frequency_hz", Kind::frequency, "chatter frequency; null: not known", Presence::or_null},
        row.chatter_frequency_hz);
  visit(Field{"bifurcation", Kind::text, "\"hopf\", \"flip\" or \"fold\""}, row.bifurcation);
  visit(Field{"status", Kind::text,
              "\"converged\", \"stable_to_depth_limit\", \"data_limited\", or why the row is not to be trusted"},
        row.status);
  visit(Field{"error_estimate_relative", Kind::error_estimate, "estimated relative error of the depth; null: not known",
              Presence::or_null},
        row.error_estimate_relative);
}

/// A depth at which Floquet multipliers cross the unit circle.
struct CrossingSummary {
  double depth_m = 0.0;
  std::optional<double> chatter_frequency_hz;
  std::string bifurcation;
  int unstable_change = 0;
  std::optional<double> error_estimate_relative;
};

template <class Visitor, Either<CrossingSummary> Section>
void fields(Visitor& visit, Section& crossing) {
  visit(Field{"depth_m", Kind::length, "axial depth of cut"}, crossing.depth_m);
  visit(Field{"chatter_frequency_hz", Kind::frequency, "chatter frequency; null: not known", Presence::or_null},
        crossing.chatter_frequency_hz);
  visit(Field{"bifurcation", Kind::text, "\"hopf\", \"flip\" or \"fold\""}, crossing.bifurcation);
  visit(Field{"unstable_change", Kind::count, "multipliers that leave the circle there; negative: that return"},
        crossing.unstable_change);
  visit(Field{"error_estimate_relative", Kind::error_estimate, "estimated relative error of the depth; null: not known",
              Presence::or_null},
        crossing.error_estimate_relative);
}

/// The change of a limiting depth with a parameter.
struct SensitivitySummary {
  std::string parameter;
  std::optional<double> mode_frequency_hz;
  double sensitivity = 0.0;
};

template <class Visitor, Either<SensitivitySummary> Section>
void fields(Visitor& visit, Section& entry) {
  visit(Field{"parameter", Kind::text, "\"frequency\", \"damping_ratio\", \"receptance\" of a mode, or a coefficient"},
        entry.parameter);
  visit(
      Field{"mode_frequency_hz", Kind::frequency, "the mode's own frequency; null of a coefficient", Presence::or_null},
      entry.mode_frequency_hz);
  visit(Field{"sensitivity", Kind::ratio, "relative change of the depth over that of the parameter, d ln w / d ln p"},
        entry.sensitivity);
}

/// A speed at which much depth is stable.
struct PocketSummary {
  double spindle_speed_rpm = 0.0, depth_m = 0.0;
  bool at_depth_limit = false;
  std::string limited_by;
  std::optional<double> removal_rate_cm3_per_min;
  double from_spindle_speed_rpm = 0.0, to_spindle_speed_rpm = 0.0;
  bool at_chart_edge = false;
};

template <class Visitor, Either<PocketSummary> Section>
void fields(Visitor& visit, Section& pocket) {
  visit(Field{"spindle_speed_rpm", Kind::spindle_speed, "spindle speed"}, pocket.spindle_speed_rpm);
  visit(Field{"depth_m", Kind::length, "axial depth of cut"}, pocket.depth_m);
  visit(Field{"at_depth_limit", Kind::truth, "true if no limit was found up to the deepest cut"},
        pocket.at_depth_limit);
  visit(Field{"limited_by", Kind::text, "what bounds the depth: stability, the tool, the machine"}, pocket.limited_by);
  visit(Field{"removal_rate_cm3_per_min", Kind::removal_rate, "removal rate; null without a feed", Presence::or_null},
        pocket.removal_rate_cm3_per_min);
  visit(Field{"from_spindle_speed_rpm", Kind::spindle_speed, "lowest speed at which nine tenths of the depth are left"},
        pocket.from_spindle_speed_rpm);
  visit(Field{"to_spindle_speed_rpm", Kind::spindle_speed, "highest speed at which nine tenths of the depth are left"},
        pocket.to_spindle_speed_rpm);
  visit(Field{"at_chart_edge", Kind::truth, "true if the chart ends there: no pocket, it may be deeper beyond"},
        pocket.at_chart_edge);
}

/// The depth up to which the contact with the robot holds while the cutter cuts.
struct ContactLimitSummary {
  double preload_n = 0.0;
  std::optional<double> lost_above_m;
};

template <class Visitor, Either<ContactLimitSummary> Section>
void fields(Visitor& visit, Section& contact) {
  visit(Field{"preload_n", Kind::force, "force without the cut"}, contact.preload_n);
  visit(
      Field{"lost_above_m", Kind::length,
            "depth of cut above which the cut pulls the contact open, so that the limit does not hold; null: it holds "
            "up to the limit",
            Presence::or_null},
      contact.lost_above_m);
}

/// The limit at the case's own speed, with all that is told of it.
struct CaseSpeedSummary : RowSummary {
  std::vector<CrossingSummary> crossings;
  std::vector<SensitivitySummary> sensitivities;
  std::optional<DepthErrorsSummary> error_budget;
  std::optional<ContactLimitSummary> contact;
};

template <class Visitor, Either<CaseSpeedSummary> Section>
void fields(Visitor& visit, Section& row) {
  if constexpr (std::is_const_v<Section>) {
    fields(visit, static_cast<const RowSummary&>(row));
  } else {
    fields(visit, static_cast<RowSummary&>(row));
  }
  visit(Field{"crossings", Kind::section, "every crossing at this speed, ascending", Presence::if_any}, row.crossings);
  visit(Field{"sensitivities", Kind::section, "what moves the limit, largest first"}, row.sensitivities);
  visit(Field{"error_budget", Kind::section, "errors of the depth by errors of the structure; absent: none is known"},
        row.error_budget);
  visit(Field{"contact", Kind::section, "up to which depth a contact with a preload holds; absent: not known"},
        row.contact);
}

/// A chart of the same cut by another method.
struct ComparedSummary {
  std::string name, method;
  double minimum_depth_m = 0.0, minimum_at_spindle_speed_rpm = 0.0;
  std::optional<double> error_estimate_relative;
  int speeds_not_converged = 0;
  double largest_relative_difference = 0.0, at_spindle_speed_rpm = 0.0;
};

template <class Visitor, Either<ComparedSummary> Section>
void fields(Visitor& visit, Section& other) {
  visit(Field{"name", Kind::text, "name of the method as the case gives it"}, other.name);
  visit(Field{"method", Kind::text, "method in words"}, other.method);
  visit(Field{"minimum_depth_m", Kind::length, "least depth"}, other.minimum_depth_m);
  visit(Field{"minimum_at_spindle_speed_rpm", Kind::spindle_speed, "speed of that"},
        other.minimum_at_spindle_speed_rpm);
  visit(Field{"error_estimate_relative", Kind::error_estimate, "largest estimate of a row; null: not known",
              Presence::or_null},
        other.error_estimate_relative);
  visit(Field{"speeds_not_converged", Kind::count, "speeds that did not reach the tolerance"},
        other.speeds_not_converged);
  visit(Field{"largest_relative_difference", Kind::residual, "largest difference of a depth from the chart, relative"},
        other.largest_relative_difference);
  visit(Field{"at_spindle_speed_rpm", Kind::spindle_speed, "speed of the largest difference"},
        other.at_spindle_speed_rpm);
}

/// The largest multiplier over speed and depth.
struct MapSummary {
  long speeds = 0, depths = 0;
  double largest_depth_m = 0.0, largest_modulus = 0.0;
  std::optional<double> error_estimate;
  int speeds_not_converged = 0;
};

template <class Visitor, Either<MapSummary> Section>
void fields(Visitor& visit, Section& map) {
  visit(Field{"speeds", Kind::count, "spindle speeds"}, map.speeds);
  visit(Field{"depths", Kind::count, "depths"}, map.depths);
  visit(Field{"largest_depth_m", Kind::length, "largest depth"}, map.largest_depth_m);
  visit(Field{"largest_modulus", Kind::ratio, "largest modulus of a multiplier"}, map.largest_modulus);
  visit(Field{"error_estimate", Kind::error_estimate, "largest estimated error of a modulus; null: not known",
              Presence::or_null},
        map.error_estimate);
  visit(Field{"speeds_not_converged", Kind::count, "speeds that did not reach the tolerance"},
        map.speeds_not_converged);
}

/// Limits that hold in spite of uncertain data.
struct RobustSummary {
  double confidence = 0.0, minimum_depth_m = 0.0, at_spindle_speed_rpm = 0.0;
  int speeds_not_robust = 0, speeds_not_converged = 0;
  std::vector<PocketSummary> best_pockets;
};

template <class Visitor, Either<RobustSummary> Section>
void fields(Visitor& visit, Section& robust) {
  visit(Field{"confidence", Kind::ratio, "standard deviations that are kept away from the limit"}, robust.confidence);
  visit(Field{"minimum_depth_m", Kind::length, "least robust depth"}, robust.minimum_depth_m);
  visit(Field{"at_spindle_speed_rpm", Kind::spindle_speed, "speed of that"}, robust.at_spindle_speed_rpm);
  visit(Field{"speeds_not_robust", Kind::count, "speeds that are not robust at any depth"}, robust.speeds_not_robust);
  visit(Field{"speeds_not_converged", Kind::count, "speeds that did not reach the tolerance"},
        robust.speeds_not_converged);
  visit(Field{"best_pockets", Kind::section, "deepest robust cuts, best first"}, robust.best_pockets);
}

/// The line of a chart between its speeds, against the boundary that it stands for.
struct LineSummary {
  double tolerance = 0.0;
  std::optional<double> error_estimate_relative;
  double at_spindle_speed_rpm = 0.0;
  int speeds_added = 0;
  bool met = false;
};

template <class Visitor, Either<LineSummary> Section>
void fields(Visitor& visit, Section& line) {
  visit(Field{"tolerance", Kind::ratio, "bound that was asked for (lobes.line_tolerance)"}, line.tolerance);
  visit(Field{"error_estimate_relative", Kind::error_estimate,
              "largest estimated distance of the line from the boundary, relative; null: not known", Presence::or_null},
        line.error_estimate_relative);
  visit(Field{"at_spindle_speed_rpm", Kind::spindle_speed, "amid the two speeds between which that is"},
        line.at_spindle_speed_rpm);
  visit(Field{"speeds_added", Kind::count, "speeds added for the line's sake"}, line.speeds_added);
  visit(Field{"met", Kind::truth, "true if no speed that might be added would bring the line nearer than the bound"},
        line.met);
}

/// A limit that hangs on lines below the first resonance.
struct DoubtfulLimitSummary {
  double chatter_frequency_hz = 0.0, first_resonance_hz = 0.0;
};

template <class Visitor, Either<DoubtfulLimitSummary> Section>
void fields(Visitor& visit, Section& limit) {
  visit(Field{"chatter_frequency_hz", Kind::frequency, "chatter frequency"}, limit.chatter_frequency_hz);
  visit(Field{"first_resonance_hz", Kind::frequency, "lowest resonance of what was measured"},
        limit.first_resonance_hz);
}

/// A stability chart.
struct LobesSummary {
  study::ChartOf name = study::ChartOf::part;
  std::string method;
  double minimum_depth_m = 0.0, at_spindle_speed_rpm = 0.0;
  RowSummary maximum;
  std::optional<double> error_estimate_relative, static_share, modes_up_to_hz;
  long speeds = 0;
  int speeds_stable_to_depth_limit = 0, speeds_not_converged = 0;
  std::vector<double> main_modes_hz;
  std::optional<PocketSummary> best_pocket;
  std::vector<PocketSummary> best_pockets;
  std::vector<ComparedSummary> compared;
  std::optional<LineSummary> line;
  std::optional<MapSummary> map;
  std::optional<RobustSummary> robust;
  std::optional<ChartErrorsSummary> error_budget;
  std::optional<CaseSpeedSummary> at_case_speed;
  std::optional<DoubtfulLimitSummary> below_first_resonance;
  std::vector<ForcedOverSpeedSummary> forced_over_speed;
  std::optional<ObservedSummary> observed;
  std::optional<LearnedSummary> learned;
};

template <class Visitor, Either<LobesSummary> Section>
void fields(Visitor& visit, Section& chart) {
  visit(Field{"name", Kind::text, "structure of the chart"}, chart.name);
  visit(Field{"method", Kind::text, "method in words"}, chart.method);
  visit(Field{"minimum_depth_m", Kind::length, "least limiting depth of all speeds"}, chart.minimum_depth_m);
  visit(Field{"at_spindle_speed_rpm", Kind::spindle_speed, "speed of that"}, chart.at_spindle_speed_rpm);
  visit(Field{"maximum", Kind::section, "row of the largest limiting depth"}, chart.maximum);
  visit(Field{"error_estimate_relative", Kind::error_estimate, "largest estimate of a row; null: not known",
              Presence::or_null},
        chart.error_estimate_relative);
  visit(Field{"static_share", Kind::ratio, "share of the static compliance that is taken without its dynamics",
              Presence::or_null},
        chart.static_share);
  visit(Field{"modes_up_to_hz", Kind::frequency,
              "bound above which modes of the part act by their static compliance; absent: none do"},
        chart.modes_up_to_hz);
  visit(Field{"speeds", Kind::count, "spindle speeds"}, chart.speeds);
  visit(Field{"speeds_stable_to_depth_limit", Kind::count, "speeds without a limit up to the deepest cut"},
        chart.speeds_stable_to_depth_limit);
  visit(Field{"speeds_not_converged", Kind::count, "speeds that did not reach the tolerance"},
        chart.speeds_not_converged);
  visit(Field{"main_modes_hz", Kind::frequency, "frequencies that the cut feels most, ascending"}, chart.main_modes_hz);
  visit(
      Field{"best_pocket", Kind::section,
            "deepest pocket within the machine's limits, of the robust limits where there are some; at an edge of the "
            "chart only if there is no other"},
      chart.best_pocket);
  visit(Field{"best_pockets", Kind::section, "deepest cuts within the machine's limits, best first"},
        chart.best_pockets);
  visit(Field{"line", Kind::section, "the line between the speeds"}, chart.line);
  visit(Field{"compared", Kind::section, "charts by other methods (lobes.compare)", Presence::if_any}, chart.compared);
  visit(Field{"map", Kind::section, "map of the largest multiplier (lobes.map_depths)"}, chart.map);
  visit(Field{"robust", Kind::section, "limits in spite of uncertain data (lobes.robust)"}, chart.robust);
  visit(Field{"error_budget", Kind::section, "errors of the depths by errors of the structure; null: none is known",
              Presence::or_null},
        chart.error_budget);
  visit(Field{"at_case_speed", Kind::section, "the row at the case's own speed"}, chart.at_case_speed);
  visit(Field{"below_first_resonance", Kind::section,
              "the limit at the case's own speed, else the least, where measured lines below the first resonance make "
              "it, which is to be doubted; absent: they do not"},
        chart.below_first_resonance);
  visit(Field{"forced_over_speed", Kind::section,
              "forced motion over the speeds, at each depth of an operating point; absent without a feed or poles",
              Presence::if_any},
        chart.forced_over_speed);
  visit(Field{"observed", Kind::section, "cuts that were made, held against the chart; absent: the case has none"},
        chart.observed);
  visit(Field{"learned", Kind::section, "what these cuts taught; absent without [calibration]"}, chart.learned);
}

}  // namespace thinwall::report
