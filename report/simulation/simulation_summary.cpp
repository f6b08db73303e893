#include "report/simulation/simulation_summary.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/words.hpp"
#include "milling/simulation/spectrum.hpp"
#include "report/finite_number.hpp"
#include "setup/simulation_options.hpp"

namespace thinwall::report {

namespace {

using study::PointSimulation;

constexpr Eigen::Index least_samples = 8;  // of a spectrum
constexpr std::size_t most_lines = 6;

/// The strongest lines along feed and normal, largest first, as entries of a summary.
template <class Line>
std::vector<Line> lines_of(const PointSimulation& p, const Eigen::Matrix3Xd& samples) {
  std::vector<Line> lines;
  if (p.cut.trace.torque_n_m.size() < least_samples) return lines;
  for (const int axis : {0, 1}) {
    const milling::Spectrum spectrum = milling::spectrum_of(samples.row(axis), p.cut.trace.step_s);
    for (const milling::SpectralLine& line :
         milling::spectral_lines(spectrum, p.point.spindle_speed_rpm / 60.0, p.teeth, p.alike, most_lines))
      lines.push_back({line.frequency_hz, line.amplitude, axis == 0 ? "feed" : "normal", milling::name(line.origin)});
  }
  return lines;
}

std::vector<WallSummary> walls_of(const std::vector<milling::Wall>& walls) {
  std::vector<WallSummary> list;
  list.reserve(walls.size());
  for (const milling::Wall& wall : walls)
    list.push_back(
        {wall.side > 0 ? "+normal" : "-normal", wall.height_m, wall.mean_m, wall.R_a_m, wall.R_q_m, wall.R_t_m});
  return list;
}

GrowthSummary growth_of(const PointSimulation& p) {
  GrowthSummary growth;
  if (p.growth.converged) {
    growth.march_modulus = p.growth.modulus;
    growth.march_error_estimate_relative = finite(p.growth.error_estimate);
    growth.difference_relative = finite(p.growth_difference());
  }
  growth.lobes_modulus = finite(p.lobes.modulus);
  growth.lobes_error_estimate_relative = finite(p.lobes.error_estimate);
  return growth;
}

void add_figures(SimulatedPointSummary& summary, const milling::SimulatedCut& cut) {
  summary.peak_to_peak_m = cut.displacement_m.range();
  summary.mean_force_n = cut.mean_force_n;
  summary.peak_force_n = cut.peak_force_n;
  summary.peak_torque_n_m = cut.peak_torque_n_m;
  summary.mean_power_w = cut.mean_power_w;
  summary.share_without_contact = cut.share_without_contact;
  summary.thickest_chip_m = cut.thickest_chip_m;
  summary.walls = walls_of(cut.walls);
  if (cut.contact)
    summary.opening_contact = {cut.contact->open_share, cut.contact->least_n, cut.contact->largest_n,
                               cut.contact->widest_m};
}

SimulatedPointSummary point_of(const PointSimulation& p, std::size_t index) {
  SimulatedPointSummary summary;
  summary.files = simulation_files_name(p.of, index);
  summary.chart = p.of;
  summary.spindle_speed_rpm = p.point.spindle_speed_rpm;
  summary.depth_m = p.point.depth_m;
  summary.feed_per_tooth_m = p.feed_per_tooth_m;
  summary.status = milling::name(p.cut.status);
  summary.motion = milling::name(p.cut.motion.motion);
  summary.period = p.cut.motion.period;
  summary.period_difference = finite(p.cut.motion.difference);
  summary.simulated_s = p.cut.simulated_s;
  summary.growth = growth_of(p);
  if (milling::ended_early(p.cut.status)) return summary;  // figures of such a motion are none
  add_figures(summary, p.cut);
  summary.vibration_lines = lines_of<VibrationLineSummary>(p, p.cut.trace.displacement_m);
  summary.force_lines = lines_of<ForceLineSummary>(p, p.cut.trace.force_n);
  for (std::size_t axis = 0; axis < p.approach.size(); ++axis) {
    const milling::Approach& a = p.approach[axis];
    summary.approach.push_back(
        {axis == 0 ? "feed" : "normal", a.final_m, a.overshoot, a.peak_s, a.settling_2_s, a.settling_5_s});
  }
  summary.lag_m = p.lag_m;
  summary.removal_error_relative = p.cut.removal_error;
  if (p.forced) summary.forced_vibration = {p.forced->peak_to_peak_m, p.forced->difference, p.forced->left};
  return summary;
}

void take_largest(std::optional<LargestDifferenceSummary>& largest, const SimulatedPointSummary& p,
                  std::optional<double> difference) {
  if (!difference || (largest && largest->max_relative >= std::abs(*difference))) return;
  largest = {std::abs(*difference), p.chart, p.spindle_speed_rpm, p.depth_m};
}

AmplitudeMapSummary map_of(const study::AmplitudeMap& map) {
  AmplitudeMapSummary summary;
  summary.chart = map.of;
  summary.speeds = std::ssize(map.spindle_speeds_rpm);
  summary.depths = std::ssize(map.depths_m);
  summary.largest_depth_m = map.depths_m.back();
  for (Eigen::Index i = 0; i < map.peak_to_peak_m.size(); ++i) {
    const double value = map.peak_to_peak_m(i);
    if (!std::isfinite(value)) ++summary.points_outgrown;
    else if (map.unsettled(i) != 0) ++summary.points_unsettled;
    else summary.largest_peak_to_peak_m = std::max(value, summary.largest_peak_to_peak_m.value_or(0.0));
  }
  return summary;
}

}  // namespace

std::string simulation_files_name(study::ChartOf of, std::size_t index) {
  return core::word_of(of) + "-" + std::to_string(index + 1);
}

std::optional<SimulationSummary> simulation_summary(const study::Results& results) {
  if (results.simulations.empty() && results.amplitude_maps.empty()) return std::nullopt;
  const setup::Simulation& wanted = *results.setup.simulation;
  SimulationSummary summary;
  summary.paths = core::word_of(wanted.paths);
  summary.settling_turns = wanted.start == setup::CutStart::border ? 0 : wanted.settling_turns;
  for (std::size_t i = 0; i < results.simulations.size(); ++i) {
    const PointSimulation& p = results.simulations[i];
    summary.recorded_turns = setup::simulation_options(wanted, p.feed_per_tooth_m, p.teeth).recorded_turns;
    summary.points.push_back(point_of(p, i));
    const SimulatedPointSummary& added = summary.points.back();
    if (p.lobes.status == milling::StabilityStatus::converged)
      take_largest(summary.growth_difference, added, added.growth.difference_relative);
    constexpr double settled = 1e-6;
    if (added.forced_vibration && added.forced_vibration->left_of_beginning < settled)
      take_largest(summary.forced_difference, added, added.forced_vibration->difference_relative);
  }
  for (const study::AmplitudeMap& map : results.amplitude_maps) summary.maps.push_back(map_of(map));
  return summary;
}

}  // namespace thinwall::report
