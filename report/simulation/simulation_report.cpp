#include "report/simulation/simulation_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "core/words.hpp"
#include "report/lobes/lobes_words.hpp"

namespace thinwall::report {

namespace {

std::string length(double metres) {
  return core::readable_text(metres, core::kind::length);
}

std::string motion_in_words(const SimulatedPointSummary& p) {
  if (p.motion == "settling")
    return "has not settled, though small ones decay: " +
           (p.period_difference
                ? fmt::format("it still changes by {:.2g} % of its size, ", 100.0 * *p.period_difference)
                : std::string()) +
           "settle more turns";
  if (p.motion == "periodic") return "repeats itself with the cut";
  if (p.motion == "period_n") return fmt::format("repeats itself after {} periods of the cut", p.period);
  if (p.motion == "growing") return "grows";
  return p.growth.stable() ? "never repeats itself, though small ones decay: take more steps first (simulation.steps, "
                             "simulation.steps_a_turn), then settle more turns, or it is chatter that a large enough "
                             "disturbance begins"
                           : "never repeats itself";
}

std::string outcome(const SimulatedPointSummary& p) {
  if (p.status == "overflowed") return fmt::format("the vibration outgrew the cutter after {:.3g} s", p.simulated_s);
  if (p.status == "surface_lost")
    return fmt::format(
        "after {:.3g} s the vibration is too fast or too large for exact paths, take simulation.paths = \"region\"",
        p.simulated_s);
  const std::string text = p.approach.empty() ? "vibration " + motion_in_words(p) : "the tool enters at a border";
  if (p.status == "too_coarse")
    return text + fmt::format(
                      "; steps are too few, from {:.3g} s on the area of the chips is {:+.2g} % off that which "
                      "the part loses: take more by simulation.steps_a_turn, and trust no figure",
                      p.simulated_s, 100.0 * p.removal_error_relative.value_or(NAN));
  return p.status == "unsettled" ? text +
                                       "; forces within steps did not settle: take more steps, or more modes by "
                                       "lobes.modes_up_to, and trust no figure"
                                 : text;
}

std::string growth_text(const GrowthSummary& growth) {
  if (!growth.lobes_modulus)
    return "  growth     not asked for: the slowest mode swings too often in a cut at so low a speed\n";
  if (!growth.march_modulus)
    return fmt::format("  growth     not found by the march; |mu| {:.6f} by the lobes\n", *growth.lobes_modulus);
  return fmt::format(
      "  growth     |mu| {:.6f} by the march, {:.6f} by the lobes ({:+.1e} apart; by estimate within {:.0e} and "
      "{:.0e})\n",
      *growth.march_modulus, *growth.lobes_modulus, growth.difference_relative.value_or(NAN),
      growth.march_error_estimate_relative.value_or(NAN), growth.lobes_error_estimate_relative.value_or(NAN));
}

std::string forced_text(const ForcedAgreementSummary& forced) {
  constexpr double worth_telling = 1e-6;
  std::string text = fmt::format("  closed form {:.1e} from the simulated motion", forced.difference_relative);
  if (forced.left_of_beginning > worth_telling)
    text += fmt::format("; {:.1e} of the beginning may be left, more settling turns take it away",
                        forced.left_of_beginning);
  return text + "\n";
}

const char* word(const std::string& origin, bool stable) {
  if (origin == "tooth_passing") return "teeth";
  if (origin == "spindle") return "spindle";
  return stable ? "of the structure" : "chatter";
}

/// The strongest lines along the direction in which the tool vibrates most.
std::string lines_text(const SimulatedPointSummary& p) {
  constexpr int most = 4;
  if (p.vibration_lines.empty()) return "";
  const std::string direction = p.peak_to_peak_m->y() > p.peak_to_peak_m->x() ? "normal" : "feed";
  std::string text = fmt::format("  lines      {}", direction == "feed" ? "along the feed" : "across");
  int shown = 0;
  for (const VibrationLineSummary& line : p.vibration_lines) {
    if (line.direction != direction || shown == most) continue;
    text += fmt::format("{}{:.1f} Hz {} ({})", shown++ == 0 ? ": " : ", ", line.frequency_hz, length(line.amplitude_m),
                        word(line.origin, p.growth.stable()));
  }
  return text + "\n";
}

std::string wall_text(const WallSummary& wall) {
  const std::string place = wall.height_m > 0.0 ? " at " + length(wall.height_m) + " height" : "";
  return fmt::format("  wall {}y{}  {} {}, R_a {}, R_q {}, R_t {}\n", wall.side.front(), place,
                     length(std::abs(wall.location_error_m)),
                     wall.location_error_m > 0.0 ? "too deep" : "left standing", length(wall.R_a_m), length(wall.R_q_m),
                     length(wall.R_t_m));
}

std::string approach_text(const ApproachSummary& approach) {
  const char* direction = approach.direction == "feed" ? "along the feed" : "across";
  if (!approach.settling_5_s || !approach.settling_2_s)
    return fmt::format("  deflection {} {} at the end of the record, not settled yet: record more turns\n", direction,
                       length(approach.final_m));
  return fmt::format(
      "  deflection {} {} at the end, overshoot {:.3g} % at {:.3g} s, within 2 % after {:.3g} s, 5 % after {:.3g} s\n",
      direction, length(approach.final_m), 100.0 * approach.overshoot, approach.peak_s, *approach.settling_2_s,
      *approach.settling_5_s);
}

std::string contact_text(const OpeningContactSummary& contact) {
  if (contact.open_share == 0.0)
    return fmt::format("  support    stays closed, pressed by {:.4g} to {:.4g} N\n", contact.least_n,
                       contact.largest_n);
  return fmt::format("  support    open in {:.2g} % of the time, by up to {}; pressed by up to {:.4g} N\n",
                     100.0 * contact.open_share, length(contact.widest_m), contact.largest_n);
}

std::string lag_text(const std::vector<double>& lag_m) {
  return fmt::format("  arm        {} along the feed and {} across before the cut, beside the place it is told\n",
                     length(lag_m[0]), length(lag_m[1]));
}

/// A doubt about a point on paths that are not circles: whether its chips are what the part lost.
std::string unchecked_text(const SimulatedPointSummary& p, const std::string& paths) {
  if (paths == "circular" || p.removal_error_relative) return "";
  return "  removal    not checked, whether steps are enough: vibration reaches walls that are finished, or the record "
         "is too short\n";
}

std::string text_of(const SimulatedPointSummary& p, const std::string& paths) {
  std::string text = fmt::format("{} at {:.0f} rpm, {} deep: {}\n", chart_title(p.chart), p.spindle_speed_rpm,
                                 length(p.depth_m), outcome(p));
  text += growth_text(p.growth);
  if (!p.peak_to_peak_m) return text;
  if (p.forced_vibration) text += forced_text(*p.forced_vibration);
  text += fmt::format("  vibration  peak to peak {} along the feed, {} across\n", length(p.peak_to_peak_m->x()),
                      length(p.peak_to_peak_m->y()));
  text += fmt::format("  force      peak {:.4g} N, torque {:.4g} N m, power {:.4g} W on the mean\n",
                      p.peak_force_n.value_or(NAN), p.peak_torque_n_m.value_or(NAN), p.mean_power_w.value_or(NAN));
  text += fmt::format("  contact    lost in {:.3g} % of the cut, thickest chip {}\n",
                      100.0 * p.share_without_contact.value_or(NAN), length(p.thickest_chip_m.value_or(NAN)));
  if (p.lag_m.size() == 3) text += lag_text(p.lag_m);
  if (p.opening_contact) text += contact_text(*p.opening_contact);
  for (const ApproachSummary& approach : p.approach) {
    if (approach.final_m != 0.0) text += approach_text(approach);
  }
  text += unchecked_text(p, paths);
  text += lines_text(p);
  for (const WallSummary& wall : p.walls) text += wall_text(wall);
  return text;
}

std::string text_of(const AmplitudeMapSummary& map) {
  std::string text = fmt::format("{} map  {} speeds, {} depths to {}", chart_title(map.chart), map.speeds, map.depths,
                                 length(map.largest_depth_m));
  if (map.largest_peak_to_peak_m) text += ", peak to peak up to " + length(*map.largest_peak_to_peak_m);
  if (map.points_outgrown > 0)
    text += fmt::format("; at {} points the vibration outgrew the cutter", map.points_outgrown);
  if (map.points_unsettled > 0)
    text += fmt::format(
        "; at {} points forces within steps did not settle, trust none of these: take more steps by "
        "simulation.map.steps",
        map.points_unsettled);
  return text + "\n";
}

}  // namespace

std::string simulation_text(const Summary& summary) {
  std::string text;
  if (!summary.simulation) return text;
  for (const SimulatedPointSummary& point : summary.simulation->points)
    text += text_of(point, summary.simulation->paths);
  for (const AmplitudeMapSummary& map : summary.simulation->maps) text += text_of(map);
  return text;
}

}  // namespace thinwall::report
