#pragma once
// Sections of summary.json on simulations in the time domain.

#include <optional>
#include <string>
#include <vector>

#include "report/summary/field.hpp"
#include "study/lobes/chart_of.hpp"

namespace thinwall::report {

/// A line of the spectrum of the vibration.
struct VibrationLineSummary {
  double frequency_hz = 0.0, amplitude_m = 0.0;
  std::string direction, origin;
};

template <class Visitor, Either<VibrationLineSummary> Section>
void fields(Visitor& visit, Section& line) {
  visit(Field{"frequency_hz", Kind::frequency, "frequency"}, line.frequency_hz);
  visit(Field{"amplitude_m", Kind::length, "peak value of the sine, tool against part"}, line.amplitude_m);
  visit(Field{"direction", Kind::text, "\"feed\" or \"normal\""}, line.direction);
  visit(
      Field{"origin", Kind::text,
            "\"tooth_passing\", \"spindle\" (another multiple of the turns a second, of teeth that differ), \"other\": "
            "chatter, or what is left of the beginning"},
      line.origin);
}

/// A line of the spectrum of the force.
struct ForceLineSummary {
  double frequency_hz = 0.0, amplitude_n = 0.0;
  std::string direction, origin;
};

template <class Visitor, Either<ForceLineSummary> Section>
void fields(Visitor& visit, Section& line) {
  visit(Field{"frequency_hz", Kind::frequency, "frequency"}, line.frequency_hz);
  visit(Field{"amplitude_n", Kind::force, "peak value of the sine, on the tool"}, line.amplitude_n);
  visit(Field{"direction", Kind::text, "\"feed\" or \"normal\""}, line.direction);
  visit(Field{"origin", Kind::text, "as of vibration_lines"}, line.origin);
}

/// The wall that a simulated cut leaves at a height.
struct WallSummary {
  std::string side;
  double height_m = 0.0, location_error_m = 0.0, R_a_m = 0.0, R_q_m = 0.0, R_t_m = 0.0;
};

template <class Visitor, Either<WallSummary> Section>
void fields(Visitor& visit, Section& wall) {
  visit(Field{"side", Kind::text, "\"+normal\" or \"-normal\""}, wall.side);
  visit(Field{"height_m", Kind::length, "height above the tip"}, wall.height_m);
  visit(Field{"location_error_m", Kind::length, "mean line against where it should be; positive: overcut"},
        wall.location_error_m);
  visit(Field{"R_a_m", Kind::length, "mean distance from the mean line"}, wall.R_a_m);
  visit(Field{"R_q_m", Kind::length, "its root mean square"}, wall.R_q_m);
  visit(Field{"R_t_m", Kind::length, "highest peak to lowest valley"}, wall.R_t_m);
}

/// The growth of a small vibration, by simulation and by the lobes.
struct GrowthSummary {
  std::optional<double> march_modulus, march_error_estimate_relative;
  std::optional<double> lobes_modulus, lobes_error_estimate_relative;
  std::optional<double> difference_relative;

  /// True if small vibrations are known to decay.
  [[nodiscard]] bool stable() const { return lobes_modulus && *lobes_modulus < 1.0; }
};

template <class Visitor, Either<GrowthSummary> Section>
void fields(Visitor& visit, Section& growth) {
  visit(Field{"march_modulus", Kind::ratio, "|mu| of a period by the march; null: not found", Presence::or_null},
        growth.march_modulus);
  visit(Field{"march_error_estimate_relative", Kind::error_estimate,
              "estimated relative error of that; null: not known", Presence::or_null},
        growth.march_error_estimate_relative);
  visit(Field{"lobes_modulus", Kind::ratio,
              "|mu| of a period by the direct method of the lobes; null: not to be had at so low a speed",
              Presence::or_null},
        growth.lobes_modulus);
  visit(Field{"lobes_error_estimate_relative", Kind::error_estimate,
              "estimated relative error of that; null: not known", Presence::or_null},
        growth.lobes_error_estimate_relative);
  visit(Field{"difference_relative", Kind::residual, "march over lobes, less one; null: not found", Presence::or_null},
        growth.difference_relative);
}

/// The closed form of a periodic motion beside the simulated one.
struct ForcedAgreementSummary {
  Eigen::Vector3d peak_to_peak_m = Eigen::Vector3d::Zero();
  double difference_relative = 0.0, left_of_beginning = 0.0;
};

template <class Visitor, Either<ForcedAgreementSummary> Section>
void fields(Visitor& visit, Section& forced) {
  visit(Field{"peak_to_peak_m", Kind::length, "in closed form, along feed, normal and axis"}, forced.peak_to_peak_m);
  visit(Field{"difference_relative", Kind::residual,
              "largest difference of the mean force over the peak force, and of the places where straight teeth enter "
              "and leave, else of the peak to peak values, over the largest peak to peak"},
        forced.difference_relative);
  visit(Field{"left_of_beginning", Kind::residual,
              "|mu| to the power of the periods before the record: by so much the simulated motion may not be settled"},
        forced.left_of_beginning);
}

/// The way in which the mean deflection over a tooth approaches its end, of a cut that began at a border.
struct ApproachSummary {
  std::string direction;
  double final_m = 0.0, overshoot = 0.0, peak_s = 0.0;
  std::optional<double> settling_2_s, settling_5_s;
};

template <class Visitor, Either<ApproachSummary> Section>
void fields(Visitor& visit, Section& approach) {
  visit(Field{"direction", Kind::text, "\"feed\" or \"normal\""}, approach.direction);
  visit(Field{"final_m", Kind::length, "mean deflection at the end, tool against part"}, approach.final_m);
  visit(Field{"overshoot", Kind::ratio, "largest mean deflection over that at the end, less one"}, approach.overshoot);
  visit(Field{"peak_s", Kind::time, "moment of that, since the tool touched the border"}, approach.peak_s);
  visit(
      Field{"settling_2_s", Kind::time,
            "time after which it stays within 2 % of its end; null: it has not settled, and no figure here is that of "
            "its end",
            Presence::or_null},
      approach.settling_2_s);
  visit(Field{"settling_5_s", Kind::time, "the same of 5 %", Presence::or_null}, approach.settling_5_s);
}

/// The contact of a support that may open.
struct OpeningContactSummary {
  double open_share = 0.0, least_n = 0.0, largest_n = 0.0, widest_m = 0.0;
};

template <class Visitor, Either<OpeningContactSummary> Section>
void fields(Visitor& visit, Section& contact) {
  visit(Field{"open_share", Kind::ratio, "share of the time in which it is open"}, contact.open_share);
  visit(Field{"least_n", Kind::force, "least force that presses it; 0 once it opened"}, contact.least_n);
  visit(Field{"largest_n", Kind::force, "largest force that presses it"}, contact.largest_n);
  visit(Field{"widest_m", Kind::length, "widest gap between its sides"}, contact.widest_m);
}

/// A simulated operating point.
struct SimulatedPointSummary {
  std::string files;
  study::ChartOf chart = study::ChartOf::part;
  double spindle_speed_rpm = 0.0, depth_m = 0.0, feed_per_tooth_m = 0.0;
  std::string status, motion;
  int period = 0;
  std::optional<double> period_difference;
  double simulated_s = 0.0;
  std::optional<Eigen::Vector3d> peak_to_peak_m, mean_force_n;
  std::optional<double> peak_force_n, peak_torque_n_m, mean_power_w, share_without_contact, thickest_chip_m;
  GrowthSummary growth;
  std::optional<ForcedAgreementSummary> forced_vibration;
  std::vector<VibrationLineSummary> vibration_lines;
  std::vector<ForceLineSummary> force_lines;
  std::vector<WallSummary> walls;
  std::vector<ApproachSummary> approach;
  std::vector<double> lag_m;
  std::optional<double> removal_error_relative;
  std::optional<OpeningContactSummary> opening_contact;
};

template <class Visitor, Either<SimulatedPointSummary> Section>
void fields(Visitor& visit, Section& point) {
  constexpr auto or_null = Presence::or_null;
  visit(Field{"files", Kind::text, "first part of the names of its tables in simulation/"}, point.files);
  visit(Field{"chart", Kind::text, "structure, as of charts"}, point.chart);
  visit(Field{"spindle_speed_rpm", Kind::spindle_speed, "spindle speed"}, point.spindle_speed_rpm);
  visit(Field{"depth_m", Kind::length, "axial depth of cut"}, point.depth_m);
  visit(Field{"feed_per_tooth_m", Kind::length, "feed per tooth"}, point.feed_per_tooth_m);
  visit(
      Field{"status", Kind::text,
            "\"completed\", \"overflowed\" (the vibration outgrew the cutter, at simulated_s), \"surface_lost\" (it "
            "was too fast or too large for exact paths, from simulated_s on), \"too_coarse\" (the area of the "
            "chips was 1 % or more off that which the part lost, at simulated_s for the first time: too few steps) or "
            "\"unsettled\" (forces within steps did not settle: not to be trusted)"},
      point.status);
  visit(Field{"motion", Kind::text,
              "\"periodic\", \"period_n\", \"quasi_periodic\", \"growing\" or \"settling\": it has no period yet"},
        point.motion);
  visit(Field{"period", Kind::count, "periods of the cut after which the motion repeats itself; 0: never"},
        point.period);
  visit(Field{"period_difference", Kind::residual,
              "largest change of a sample after that period, over the peak to peak value; where there is none, the "
              "least of the periods that were tried; null: too few turns to tell",
              or_null},
        point.period_difference);
  visit(Field{"simulated_s", Kind::time, "time that was simulated, up to the end or to where the status was met"},
        point.simulated_s);
  visit(Field{"peak_to_peak_m", Kind::length,
              "along feed, normal and axis; null, as below, where it outgrew the cutter or exact paths", or_null},
        point.peak_to_peak_m);
  visit(Field{"mean_force_n", Kind::force, "on the tool, along feed, normal and axis", or_null}, point.mean_force_n);
  visit(Field{"peak_force_n", Kind::force, "largest resultant force on the tool", or_null}, point.peak_force_n);
  visit(Field{"peak_torque_n_m", Kind::torque, "largest torque of the spindle", or_null}, point.peak_torque_n_m);
  visit(Field{"mean_power_w", Kind::power, "mean power of the spindle", or_null}, point.mean_power_w);
  visit(
      Field{"share_without_contact", Kind::ratio, "of the time that teeth spend within the angles of the cut", or_null},
      point.share_without_contact);
  visit(Field{"thickest_chip_m", Kind::length, "thickest chip", or_null}, point.thickest_chip_m);
  visit(Field{"growth", Kind::section, "of a small vibration"}, point.growth);
  visit(Field{"forced_vibration", Kind::section,
              "closed form beside the simulated motion; null: unstable, unequal teeth, exact paths or a bent law",
              or_null},
        point.forced_vibration);
  visit(Field{"vibration_lines", Kind::section, "strongest lines of the vibration", Presence::if_any},
        point.vibration_lines);
  visit(Field{"force_lines", Kind::section, "strongest lines of the force", Presence::if_any}, point.force_lines);
  visit(Field{"walls", Kind::section, "walls of the last turns", Presence::if_any}, point.walls);
  visit(Field{"approach", Kind::section, "mean deflection of a cut that began at a border", Presence::if_any},
        point.approach);
  visit(Field{"lag_m", Kind::length,
              "of a robot that is a multibody arm: displacement before the cut, beside the place that its motors are "
              "told, along feed, normal and axis",
              Presence::if_any},
        point.lag_m);
  visit(Field{"removal_error_relative", Kind::residual,
              "area of the recorded chips over that which the part lost by geometry, less one, of paths that are not "
              "circles; absent where vibration reaches back to walls that are counted already"},
        point.removal_error_relative);
  visit(Field{"opening_contact", Kind::section, "contact of a support that may open"}, point.opening_contact);
}

/// The largest of a difference over all points, and where it is.
struct LargestDifferenceSummary {
  double max_relative = 0.0;
  study::ChartOf chart = study::ChartOf::part;
  double spindle_speed_rpm = 0.0, depth_m = 0.0;
};

template <class Visitor, Either<LargestDifferenceSummary> Section>
void fields(Visitor& visit, Section& difference) {
  visit(Field{"max_relative", Kind::residual, "largest of all points"}, difference.max_relative);
  visit(Field{"chart", Kind::text, "structure of that"}, difference.chart);
  visit(Field{"spindle_speed_rpm", Kind::spindle_speed, "speed of that"}, difference.spindle_speed_rpm);
  visit(Field{"depth_m", Kind::length, "depth of that"}, difference.depth_m);
}

/// The vibration over speed and depth.
struct AmplitudeMapSummary {
  study::ChartOf chart = study::ChartOf::part;
  long speeds = 0, depths = 0, points_outgrown = 0, points_unsettled = 0;
  double largest_depth_m = 0.0;
  std::optional<double> largest_peak_to_peak_m;
};

template <class Visitor, Either<AmplitudeMapSummary> Section>
void fields(Visitor& visit, Section& map) {
  visit(Field{"chart", Kind::text, "structure, as of charts"}, map.chart);
  visit(Field{"speeds", Kind::count, "spindle speeds"}, map.speeds);
  visit(Field{"depths", Kind::count, "depths"}, map.depths);
  visit(Field{"points_outgrown", Kind::count, "points at which the vibration outgrew the cutter"}, map.points_outgrown);
  visit(Field{"points_unsettled", Kind::count, "points at which forces within steps did not settle: not to be trusted"},
        map.points_unsettled);
  visit(Field{"largest_depth_m", Kind::length, "largest depth"}, map.largest_depth_m);
  visit(Field{"largest_peak_to_peak_m", Kind::length, "largest vibration of the other points; null: there are none",
              Presence::or_null},
        map.largest_peak_to_peak_m);
}

/// The simulations of a run.
struct SimulationSummary {
  std::string paths;
  int settling_turns = 0, recorded_turns = 0;
  std::optional<LargestDifferenceSummary> growth_difference, forced_difference;
  std::vector<SimulatedPointSummary> points;
  std::vector<AmplitudeMapSummary> maps;
};

template <class Visitor, Either<SimulationSummary> Section>
void fields(Visitor& visit, Section& simulation) {
  visit(Field{"paths", Kind::text, "paths of teeth: \"circular\", \"exact\" or \"region\""}, simulation.paths);
  visit(Field{"settling_turns", Kind::count, "turns before the record"}, simulation.settling_turns);
  visit(Field{"recorded_turns", Kind::count, "turns of the record"}, simulation.recorded_turns);
  visit(Field{"growth_difference", Kind::section,
              "|mu| of the march against that of the lobes, which must agree; null: found at no point",
              Presence::or_null},
        simulation.growth_difference);
  visit(
      Field{
          "forced_difference", Kind::section,
          "simulated motion against the closed form, which must agree: the largest over the points of whose beginning "
          "less than 1e-6 is left (left_of_beginning); null: at no point",
          Presence::or_null},
      simulation.forced_difference);
  visit(Field{"points", Kind::section, "operating points, structure by structure"}, simulation.points);
  visit(Field{"maps", Kind::section, "vibration over speed and depth (simulation.map)", Presence::if_any},
        simulation.maps);
}

}  // namespace thinwall::report
