#include "report/simulation_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/units.hpp"
#include "core/words.hpp"
#include "io/results/csv_table.hpp"
#include "milling/simulation/spectrum.hpp"
#include "report/lobes_words.hpp"

namespace thinwall::report {

namespace {

using study::PointSimulation;

std::string length(double metres) {
  return core::readable_text(metres, core::kind::length);
}

std::string kind_of_motion(const milling::MotionKind& motion) {
  switch (motion.motion) {
    case milling::Motion::periodic:
      return "it repeats itself with the cut";
    case milling::Motion::period_n:
      return fmt::format("it repeats itself after {} periods of the cut", motion.period);
    case milling::Motion::quasi_periodic:
      return "it never repeats itself";
    case milling::Motion::growing:
      return "it grows";
  }
  return "";
}

std::string outcome(const PointSimulation& p) {
  if (p.cut.status == milling::SimulationStatus::overflowed)
    return fmt::format("the vibration outgrew the cutter after {:.3g} s", p.cut.simulated_s);
  std::string text = "vibration " + kind_of_motion(p.cut.motion).substr(3);
  if (p.cut.status == milling::SimulationStatus::unsettled)
    text += "; forces within steps did not settle: take more steps, and trust no figure";
  return text;
}

const char* word(milling::LineOrigin origin) {
  switch (origin) {
    case milling::LineOrigin::tooth_passing:
      return "teeth";
    case milling::LineOrigin::spindle:
      return "spindle";
    case milling::LineOrigin::other:
      return "chatter";
  }
  return "";
}

/// The direction in which the tool vibrates most, 0 or 1.
int main_direction(const milling::SimulatedCut& cut) {
  const Eigen::Vector3d range = cut.displacement_m.range();
  return range.y() > range.x() ? 1 : 0;
}

/// The strongest lines along the main direction; "" of a trace too short for them.
std::string lines_text(const PointSimulation& p) {
  constexpr std::size_t most = 4;
  constexpr Eigen::Index least_samples = 8;
  if (p.cut.trace.torque_n_m.size() < least_samples) return "";
  const int direction = main_direction(p.cut);
  const milling::Spectrum spectrum =
      milling::spectrum_of(p.cut.trace.displacement_m.row(direction), p.cut.trace.step_s);
  std::string text = fmt::format("  lines      {}", direction == 0 ? "along the feed" : "across");
  const char* comma = ": ";
  for (const milling::SpectralLine& line :
       milling::spectral_lines(spectrum, p.point.spindle_speed_rpm / 60.0, p.teeth, most)) {
    text += fmt::format("{}{:.1f} Hz {} ({})", comma, line.frequency_hz, length(line.amplitude), word(line.origin));
    comma = ", ";
  }
  return text + "\n";
}

std::string wall_text(const milling::Wall& wall) {
  const std::string place = wall.height_m > 0.0 ? " at " + length(wall.height_m) + " height" : "";
  return fmt::format("  wall {}y{}  {} {}, R_a {}, R_t {}\n", wall.side > 0 ? "+" : "-", place,
                     length(std::abs(wall.mean_m)), wall.mean_m > 0.0 ? "too deep" : "left standing",
                     length(wall.R_a_m), length(wall.R_t_m));
}

std::string text_of(const PointSimulation& p) {
  const Eigen::Vector3d range = p.cut.displacement_m.range();
  std::string text = fmt::format("{} at {:.0f} rpm, {} deep: {}\n", chart_title(p.of), p.point.spindle_speed_rpm,
                                 length(p.point.depth_m), outcome(p));
  if (p.growth.converged) {
    text += fmt::format(
        "  growth     |mu| {:.6f} by the march, {:.6f} by the lobes ({:+.1e} apart; by estimate within {:.0e} and "
        "{:.0e})\n",
        p.growth.modulus, p.lobes.modulus, p.growth_difference(), p.growth.error_estimate, p.lobes.error_estimate);
  } else {
    text += fmt::format("  growth     not found by the march; |mu| {:.6f} by the lobes\n", p.lobes.modulus);
  }
  if (p.cut.status == milling::SimulationStatus::overflowed) return text;
  text += fmt::format("  vibration  peak to peak {} along the feed, {} across\n", length(range.x()), length(range.y()));
  text += fmt::format("  force      peak {:.4g} N, torque {:.4g} N m, power {:.4g} W on the mean\n", p.cut.peak_force_n,
                      p.cut.peak_torque_n_m, p.cut.mean_power_w);
  text += fmt::format("  contact    lost in {:.2g} % of the cut, thickest chip {}\n",
                      100.0 * p.cut.share_without_contact, length(p.cut.thickest_chip_m));
  text += lines_text(p);
  for (const milling::Wall& wall : p.cut.walls) text += wall_text(wall);
  return text;
}

template <typename Of>
io::Column column(const std::vector<PointSimulation>& points, const std::string& name, const Of& of) {
  std::vector<double> values;
  for (const PointSimulation& point : points) values.push_back(of(point));
  return {name, values};
}

io::Table table_of(const std::vector<PointSimulation>& points) {
  std::vector<std::string> of, status, motion;
  for (const PointSimulation& p : points) {
    of.emplace_back(core::word_of(p.of));
    status.push_back(milling::name(p.cut.status));
    motion.push_back(milling::name(p.cut.motion.motion));
  }
  // A vibration that outgrew the cutter has no figures.
  const auto figure = [](const auto& of) {
    return [of](const PointSimulation& p) {
      const bool grew = p.cut.status == milling::SimulationStatus::overflowed;
      return grew ? std::numeric_limits<double>::infinity() : static_cast<double>(of(p.cut));
    };
  };
  const auto range = [&](int i) {
    return figure([i](const milling::SimulatedCut& cut) { return cut.displacement_m.range()[i]; });
  };
  return {
      {"structure", of},
      column(points, "spindle_speed_rpm", [](const PointSimulation& p) { return p.point.spindle_speed_rpm; }),
      column(points, "depth_m", [](const PointSimulation& p) { return p.point.depth_m; }),
      column(points, "feed_per_tooth_m", [](const PointSimulation& p) { return p.feed_per_tooth_m; }),
      {"status", status},
      {"motion", motion},
      column(points, "period", [](const PointSimulation& p) { return p.cut.motion.period; }),
      column(points, "multiplier_march",
             [](const PointSimulation& p) {
               return p.growth.converged ? p.growth.modulus : std::numeric_limits<double>::infinity();
             }),
      column(points, "multiplier_march_error",
             [](const PointSimulation& p) {
               return p.growth.converged ? p.growth.error_estimate : std::numeric_limits<double>::infinity();
             }),
      column(points, "multiplier_lobes", [](const PointSimulation& p) { return p.lobes.modulus; }),
      column(points, "multiplier_lobes_error", [](const PointSimulation& p) { return p.lobes.error_estimate; }),
      column(points, "peak_to_peak_x_m", range(0)),
      column(points, "peak_to_peak_y_m", range(1)),
      column(points, "peak_to_peak_z_m", range(2)),
      column(points, "peak_force_n", figure([](const milling::SimulatedCut& cut) { return cut.peak_force_n; })),
      column(points, "peak_torque_n_m", figure([](const milling::SimulatedCut& cut) { return cut.peak_torque_n_m; })),
      column(points, "mean_power_w", figure([](const milling::SimulatedCut& cut) { return cut.mean_power_w; })),
      column(points, "share_without_contact",
             figure([](const milling::SimulatedCut& cut) { return cut.share_without_contact; })),
      column(points, "thickest_chip_m", figure([](const milling::SimulatedCut& cut) { return cut.thickest_chip_m; }))};
}

std::vector<double> row(const Eigen::Matrix3Xd& values, int i) {
  const Eigen::VectorXd one = values.row(i);
  return {one.begin(), one.end()};
}

io::Table table_of(const milling::Trace& trace) {
  std::vector<double> time(static_cast<std::size_t>(trace.torque_n_m.size()));
  for (std::size_t i = 0; i < time.size(); ++i) time[i] = trace.start_s + static_cast<double>(i) * trace.step_s;
  return {{"time_s", time},
          {"x_m", row(trace.displacement_m, 0)},
          {"y_m", row(trace.displacement_m, 1)},
          {"z_m", row(trace.displacement_m, 2)},
          {"force_x_n", row(trace.force_n, 0)},
          {"force_y_n", row(trace.force_n, 1)},
          {"force_z_n", row(trace.force_n, 2)},
          {"torque_n_m", std::vector<double>(trace.torque_n_m.begin(), trace.torque_n_m.end())}};
}

io::Table table_of(const std::vector<milling::ToothPass>& passes) {
  io::Table table;
  const auto add = [&](const char* name, const auto& of) {
    std::vector<double> values;
    for (const milling::ToothPass& pass : passes) values.push_back(of(pass));
    table.push_back({name, values});
  };
  add("entry_s", [](const milling::ToothPass& p) { return p.entry_s; });
  add("tooth", [](const milling::ToothPass& p) { return static_cast<double>(p.tooth); });
  add("entry_x_m", [](const milling::ToothPass& p) { return p.entry_m.x(); });
  add("entry_y_m", [](const milling::ToothPass& p) { return p.entry_m.y(); });
  add("entry_x_m_s", [](const milling::ToothPass& p) { return p.entry_m_s.x(); });
  add("entry_y_m_s", [](const milling::ToothPass& p) { return p.entry_m_s.y(); });
  add("exit_x_m", [](const milling::ToothPass& p) { return p.exit_m.x(); });
  add("exit_y_m", [](const milling::ToothPass& p) { return p.exit_m.y(); });
  return table;
}

}  // namespace

std::string simulation_text(const std::vector<PointSimulation>& points) {
  std::string text;
  for (const PointSimulation& point : points) text += text_of(point);
  return text;
}

void write_simulation(const std::filesystem::path& folder, const std::vector<PointSimulation>& points) {
  const auto below = folder / "simulation";
  std::filesystem::create_directories(below);
  io::write_csv(below / "points.csv", table_of(points));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const milling::SimulatedCut& cut = points[i].cut;
    const std::string name = fmt::format("{}-{}", core::word_of(points[i].of), i + 1);
    if (cut.status == milling::SimulationStatus::overflowed) continue;
    if (cut.trace.torque_n_m.size() > 0) io::write_csv(below / (name + ".csv"), table_of(cut.trace));
    if (!cut.passes.empty()) io::write_csv(below / (name + "-passes.csv"), table_of(cut.passes));
  }
}

}  // namespace thinwall::report
