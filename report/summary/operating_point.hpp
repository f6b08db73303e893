#pragma once
// Sections of summary.json on the operating points that were asked about.

#include <string>
#include <vector>

#include "report/summary/lobes.hpp"

namespace thinwall::report {

/// The forced vibration of a stable cut.
struct ForcedVibrationSummary {
  std::optional<double> surface_location_error_m;
  double peak_force_n = 0.0, peak_torque_n_m = 0.0, mean_power_w = 0.0;
  Eigen::Vector3d peak_to_peak_m = Eigen::Vector3d::Zero();
  std::string status;
  std::optional<double> error_estimate_relative;
};

template <class Visitor, Either<ForcedVibrationSummary> Section>
void fields(Visitor& visit, Section& forced) {
  visit(Field{"surface_location_error_m", Kind::length,
              "distance of the wall from where it should be; positive: overcut; null: no wall", Presence::or_null},
        forced.surface_location_error_m);
  visit(Field{"peak_force_n", Kind::force, "largest resultant force on the tool"}, forced.peak_force_n);
  visit(Field{"peak_torque_n_m", Kind::torque, "largest torque of the spindle"}, forced.peak_torque_n_m);
  visit(Field{"mean_power_w", Kind::power, "mean power of the spindle"}, forced.mean_power_w);
  visit(Field{"peak_to_peak_m", Kind::length, "vibration of tool against part along feed, normal and axis"},
        forced.peak_to_peak_m);
  visit(Field{"status", Kind::text, "\"converged\", or why the figures are not to be trusted"}, forced.status);
  visit(Field{"error_estimate_relative", Kind::error_estimate,
              "estimated relative error of the worst of these figures; null: not known", Presence::or_null},
        forced.error_estimate_relative);
}

/// The force in the contact while the cutter cuts.
struct ContactForceSummary {
  double preload_n = 0.0, least_force_n = 0.0, largest_force_n = 0.0;
  bool lost = false;
};

template <class Visitor, Either<ContactForceSummary> Section>
void fields(Visitor& visit, Section& force) {
  visit(Field{"preload_n", Kind::force, "force without the cut"}, force.preload_n);
  visit(Field{"least_force_n", Kind::force, "least force, pressing while positive"}, force.least_force_n);
  visit(Field{"largest_force_n", Kind::force, "largest force"}, force.largest_force_n);
  visit(Field{"lost", Kind::truth, "true if the cut pulls the contact open"}, force.lost);
}

/// The answer of a chart for one operating point.
struct OperatingPointSummary {
  study::ChartOf chart = study::ChartOf::part;
  double spindle_speed_rpm = 0.0, depth_m = 0.0;
  bool stable = false;
  std::optional<double> multiplier_modulus;
  double depth_margin_m = 0.0, depth_margin_relative = 0.0;
  bool depth_margin_at_limit = false;
  std::optional<double> boundary_below_rpm, boundary_above_rpm;
  std::string status;
  std::optional<double> multiplier_error_estimate_relative, chatter_frequency_hz;
  std::optional<std::string> bifurcation;
  std::optional<double> depth_error_estimate_relative;
  std::optional<ForcedVibrationSummary> forced_vibration;
  std::optional<ContactForceSummary> contact;
  std::vector<SensitivitySummary> sensitivities;
};

template <class Visitor, Either<OperatingPointSummary> Section>
void fields(Visitor& visit, Section& point) {
  visit(Field{"chart", Kind::text, "name of the chart"}, point.chart);
  visit(Field{"spindle_speed_rpm", Kind::spindle_speed, "spindle speed"}, point.spindle_speed_rpm);
  visit(Field{"depth_m", Kind::length, "axial depth of cut"}, point.depth_m);
  visit(Field{"stable", Kind::truth, "true if the cut is stable"}, point.stable);
  visit(Field{"multiplier_modulus", Kind::ratio, "modulus of the largest Floquet multiplier; null from samples",
              Presence::or_null},
        point.multiplier_modulus);
  visit(Field{"depth_margin_m", Kind::length, "depth that may be added; negative: how much is too deep"},
        point.depth_margin_m);
  visit(Field{"depth_margin_relative", Kind::ratio, "depth_margin_m over depth_m"}, point.depth_margin_relative);
  visit(Field{"depth_margin_at_limit", Kind::truth, "true if no limit was found: the margin is the least"},
        point.depth_margin_at_limit);
  visit(Field{"boundary_below_rpm", Kind::spindle_speed, "next boundary at lower speeds; null: none in the chart",
              Presence::or_null},
        point.boundary_below_rpm);
  visit(Field{"boundary_above_rpm", Kind::spindle_speed, "next boundary at higher speeds; null: none in the chart",
              Presence::or_null},
        point.boundary_above_rpm);
  visit(Field{"status", Kind::text,
              "\"converged\", \"stable_to_depth_limit\", \"data_limited\", or why the answer is not to be trusted"},
        point.status);
  visit(Field{"multiplier_error_estimate_relative", Kind::error_estimate,
              "estimated relative error of the modulus; null: not known", Presence::or_null},
        point.multiplier_error_estimate_relative);
  visit(Field{"chatter_frequency_hz", Kind::frequency, "chatter frequency; null: not known", Presence::or_null},
        point.chatter_frequency_hz);
  visit(Field{"bifurcation", Kind::text, "\"hopf\", \"flip\" or \"fold\"; null: not known", Presence::or_null},
        point.bifurcation);
  visit(
      Field{"depth_error_estimate_relative", Kind::error_estimate,
            "estimated relative error of the boundary in depth; null: there is none, or not known", Presence::or_null},
      point.depth_error_estimate_relative);
  visit(Field{"forced_vibration", Kind::section, "vibration of a stable cut; null: not known", Presence::or_null},
        point.forced_vibration);
  visit(Field{"contact", Kind::section, "force in a contact with a preload"}, point.contact);
  visit(Field{"sensitivities", Kind::section, "what moves the boundary in depth, largest first"}, point.sensitivities);
}

}  // namespace thinwall::report
