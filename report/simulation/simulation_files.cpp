#include "report/simulation/simulation_files.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/words.hpp"
#include "io/matrices/mat_variables.hpp"
#include "io/results/csv_table.hpp"
#include "io/results/vtp.hpp"
#include "mesh/planar/stacked_prisms.hpp"
#include "milling/simulation/spectrum.hpp"
#include "report/simulation/simulation_summary.hpp"

namespace thinwall::report {

namespace {

using study::PointSimulation;

template <typename Of>
io::Column column(const std::vector<PointSimulation>& points, const std::string& name, const Of& of) {
  std::vector<double> values;
  values.reserve(points.size());
  for (const PointSimulation& point : points) values.push_back(of(point));
  return {name, values};
}

/// A column whose cells are empty where the figure is not known.
template <typename Of, typename IsKnown>
io::Column known(const std::vector<PointSimulation>& points, const std::string& name, const Of& of,
                 const IsKnown& is_known) {
  io::Column figures = column(points, name, [&](const PointSimulation& p) {
    return is_known(p) ? of(p) : std::numeric_limits<double>::quiet_NaN();
  });
  figures.gaps = true;
  return figures;
}

io::Table table_of(const std::vector<PointSimulation>& points) {
  std::vector<std::string> of, status, motion;
  for (const PointSimulation& p : points) {
    of.emplace_back(core::word_of(p.of));
    status.push_back(milling::name(p.cut.status));
    motion.push_back(milling::name(p.cut.motion.motion));
  }
  const auto marched = [](const PointSimulation& p) { return p.growth.converged; };
  const auto always = [](const PointSimulation&) { return true; };
  // A vibration that outgrew the cutter has no figures.
  const auto figure = [](const auto& quantity) {
    return [quantity](const PointSimulation& p) {
      const bool grew = milling::ended_early(p.cut.status);
      return grew ? std::numeric_limits<double>::infinity() : static_cast<double>(quantity(p.cut));
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
      known(
          points, "multiplier_march", [](const PointSimulation& p) { return p.growth.modulus; }, marched),
      known(
          points, "multiplier_march_error", [](const PointSimulation& p) { return p.growth.error_estimate; }, marched),
      known(
          points, "multiplier_lobes", [](const PointSimulation& p) { return p.lobes.modulus; }, always),
      known(
          points, "multiplier_lobes_error", [](const PointSimulation& p) { return p.lobes.error_estimate; }, always),
      known(
          points, "growth_difference", [](const PointSimulation& p) { return p.growth_difference(); }, marched),
      known(
          points, "forced_difference", [](const PointSimulation& p) { return p.forced->difference; },
          [](const PointSimulation& p) { return p.forced.has_value(); }),
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
    values.reserve(passes.size());
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

/// Amplitudes of vibration and force along feed and normal; none of a trace that is too short for them.
io::Table spectra_of(const milling::Trace& trace) {
  constexpr Eigen::Index least_samples = 8;
  io::Table table;
  if (trace.torque_n_m.size() < least_samples) return table;
  const auto add = [&](const char* name, const Eigen::VectorXd& samples) {
    const milling::Spectrum spectrum = milling::spectrum_of(samples, trace.step_s);
    if (table.empty())
      table.push_back(
          {"frequency_hz", std::vector<double>(spectrum.frequency_hz.begin(), spectrum.frequency_hz.end())});
    table.push_back({name, std::vector<double>(spectrum.amplitude.begin(), spectrum.amplitude.end())});
  };
  add("x_m", trace.displacement_m.row(0));
  add("y_m", trace.displacement_m.row(1));
  add("force_x_n", trace.force_n.row(0));
  add("force_y_n", trace.force_n.row(1));
  return table;
}

io::Table table_of(const std::vector<milling::Wall>& walls) {
  std::vector<double> side, height, x, error;
  for (const milling::Wall& wall : walls) {
    for (Eigen::Index i = 0; i < wall.x_m.size(); ++i) {
      side.push_back(wall.side);
      height.push_back(wall.height_m);
      x.push_back(wall.x_m(i));
      error.push_back(wall.error_m(i));
    }
  }
  return {{"side", side}, {"height_m", height}, {"x_m", x}, {"error_m", error}};
}

/// The columns of tables as vectors of a MAT file, named with the prefix of each.
void write_mat(const std::filesystem::path& file, const std::vector<std::pair<std::string, io::Table>>& tables) {
  std::vector<io::MatVariable> variables;
  for (const auto& [prefix, table] : tables) {
    for (const io::Column& column : table) {
      const auto& values = std::get<std::vector<double>>(column.values);
      variables.push_back(
          io::mat_matrix(prefix + column.name,
                         Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()))));
    }
  }
  if (!variables.empty()) io::write_mat_variables(file, "simulated operating point", variables);
}

void write_point(const std::filesystem::path& folder, const std::string& name, const milling::SimulatedCut& cut) {
  std::vector<std::pair<std::string, io::Table>> all;
  const auto write = [&](const std::string& suffix, const std::string& prefix, const io::Table& table,
                         const std::vector<std::string>& comments) {
    io::write_csv(folder / (name + suffix + ".csv"), table, comments);
    all.emplace_back(prefix, table);
  };
  if (cut.trace.torque_n_m.size() > 0) write("", "", table_of(cut.trace), {});
  if (const io::Table spectra = spectra_of(cut.trace); !spectra.empty())
    write("-spectrum", "spectrum_", spectra, {"peak values of sines, through the window of von Hann"});
  if (!cut.passes.empty()) write("-passes", "pass_", table_of(cut.passes), {});
  if (!cut.walls.empty())
    write("-wall", "wall_", table_of(cut.walls),
          {"error_m: of the deepest tip at each place along the feed; positive: too much is taken"});
  write_mat(folder / (name + ".mat"), all);
}

/// Writes the part that is left as closed layers, tool axes: x along the feed, z from the tip up.
void write_part(const std::filesystem::path& file, const std::vector<milling::PartSlice>& slices) {
  std::vector<mesh::Layer> layers;
  double from_m = 0.0;
  for (const milling::PartSlice& slice : slices) {
    layers.push_back({from_m, from_m + slice.width_m, slice.outlines});
    from_m += slice.width_m;
  }
  io::write_vtp(file, mesh::stacked_prisms(layers), {});
}

void write_map(const std::filesystem::path& file, const study::AmplitudeMap& map) {
  std::vector<double> speed, depth, amplitude, lost;
  std::vector<std::string> status;
  for (std::size_t s = 0; s < map.spindle_speeds_rpm.size(); ++s) {
    for (std::size_t d = 0; d < map.depths_m.size(); ++d) {
      const auto row = static_cast<Eigen::Index>(d), column = static_cast<Eigen::Index>(s);
      speed.push_back(map.spindle_speeds_rpm[s]);
      depth.push_back(map.depths_m[d]);
      amplitude.push_back(map.peak_to_peak_m(row, column));
      lost.push_back(map.share_without_contact(row, column));
      const bool outgrew = !std::isfinite(amplitude.back());
      status.push_back(milling::name(outgrew                           ? milling::SimulationStatus::overflowed
                                     : map.unsettled(row, column) != 0 ? milling::SimulationStatus::unsettled
                                                                       : milling::SimulationStatus::completed));
    }
  }
  io::write_csv(file,
                {{"spindle_speed_rpm", speed},
                 {"depth_m", depth},
                 {"peak_to_peak_m", amplitude},
                 {"share_without_contact", lost},
                 {"status", status}},
                {"peak_to_peak_m: the largest of the three axes; inf where the vibration outgrew the cutter",
                 "status: of unsettled points forces within steps did not settle, and no figure is to be trusted"});
}

}  // namespace

void write_simulation(const std::filesystem::path& folder, const study::Results& results) {
  if (results.simulations.empty() && results.amplitude_maps.empty()) return;
  const auto below = folder / "simulation";
  std::filesystem::create_directories(below);
  if (!results.simulations.empty())
    io::write_csv(below / "points.csv", table_of(results.simulations),
                  {"inf: the vibration outgrew the cutter; empty: not known"});
  for (std::size_t i = 0; i < results.simulations.size(); ++i) {
    const PointSimulation& p = results.simulations[i];
    if (!milling::ended_early(p.cut.status)) write_point(below, simulation_files_name(p.of, i), p.cut);
    if (!p.part.empty()) write_part(below / (simulation_files_name(p.of, i) + "-part.vtp"), p.part);
  }
  for (const study::AmplitudeMap& map : results.amplitude_maps)
    write_map(below / (core::word_of(map.of) + "_map.csv"), map);
}

}  // namespace thinwall::report
