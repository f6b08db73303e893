#pragma once
// Section of summary.json on the forced motion of a depth of cut over the speeds of a chart.

#include <optional>

#include "report/summary/field.hpp"

namespace thinwall::report {

/// Extremes over the speeds at which the depth is stable; null where it is at none.
struct ForcedOverSpeedSummary {
  double depth_m = 0.0, feed_per_tooth_m = 0.0;
  long speeds = 0, speeds_stable = 0;
  std::optional<double> largest_surface_error_m, largest_surface_error_at_rpm;
  std::optional<double> least_surface_error_m, least_surface_error_at_rpm;
  std::optional<double> peak_force_n, peak_force_at_rpm;
  std::optional<double> preload_n, least_contact_force_n, least_contact_force_at_rpm;
  std::optional<long> speeds_contact_lost;
  std::optional<double> error_estimate_relative;
};

template <class Visitor, Either<ForcedOverSpeedSummary> Section>
void fields(Visitor& visit, Section& forced) {
  constexpr auto or_null = Presence::or_null;
  visit(Field{"depth_m", Kind::length, "axial depth of cut"}, forced.depth_m);
  visit(Field{"feed_per_tooth_m", Kind::length, "feed per tooth, the same at every speed"}, forced.feed_per_tooth_m);
  visit(Field{"speeds", Kind::count, "spindle speeds"}, forced.speeds);
  visit(Field{"speeds_stable", Kind::count, "speeds at which the depth is stable; the others have no figures"},
        forced.speeds_stable);
  visit(
      Field{"largest_surface_error_m", Kind::length,
            "surface location error of the largest size; positive: overcut; null: no wall, or stable nowhere", or_null},
      forced.largest_surface_error_m);
  visit(Field{"largest_surface_error_at_rpm", Kind::spindle_speed, "speed of that", or_null},
        forced.largest_surface_error_at_rpm);
  visit(Field{"least_surface_error_m", Kind::length, "surface location error of the least size", or_null},
        forced.least_surface_error_m);
  visit(Field{"least_surface_error_at_rpm", Kind::spindle_speed, "speed of that", or_null},
        forced.least_surface_error_at_rpm);
  visit(Field{"peak_force_n", Kind::force, "largest resultant force on the tool; null: stable nowhere", or_null},
        forced.peak_force_n);
  visit(Field{"peak_force_at_rpm", Kind::spindle_speed, "speed of that", or_null}, forced.peak_force_at_rpm);
  visit(Field{"preload_n", Kind::force, "force in the contact without the cut; absent without a preload"},
        forced.preload_n);
  visit(Field{"least_contact_force_n", Kind::force, "least force in the contact, pressing while positive"},
        forced.least_contact_force_n);
  visit(Field{"least_contact_force_at_rpm", Kind::spindle_speed, "speed of that"}, forced.least_contact_force_at_rpm);
  visit(Field{"speeds_contact_lost", Kind::count, "stable speeds at which the cut pulls the contact open"},
        forced.speeds_contact_lost);
  visit(Field{"error_estimate_relative", Kind::error_estimate,
              "largest estimated relative error of these figures; null: not known", or_null},
        forced.error_estimate_relative);
}

}  // namespace thinwall::report
