#include "report/page/lobes_data.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "io/results/csv_table.hpp"
#include "report/page/arrays.hpp"
#include "report/page/limit_text.hpp"
#include "report/page/tool_frf_data.hpp"
#include "report/summary/write_json.hpp"

namespace thinwall::report {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// A table with its file's name for messages.
struct Source {
  fs::path file;
  io::Table table;

  explicit Source(const fs::path& path) : file(path), table(io::read_csv(path)) {}
  [[nodiscard]] const std::vector<double>& numbers(const std::string& name) const {
    return io::numbers(table, name, file);
  }
  [[nodiscard]] json words(const std::string& name) const {
    const auto column = std::ranges::find(table, name, &io::Column::name);
    if (column == table.end()) throw core::DataError(file.string() + ": no column \"" + name + "\"");
    const auto* texts = std::get_if<std::vector<std::string>>(&column->values);
    return texts == nullptr ? json::array() : json(*texts);
  }
  /// Whatever keeps a row from being right is "not_converged" on a page.
  [[nodiscard]] json statuses() const {
    json list = words("status");
    for (json& status : list) {
      if (!is_sound(status.get<std::string>())) status = "not_converged";
      else if (status == "data_limited") status = "converged";  // its error is in a column of its own
    }
    return list;
  }
  /// Rows [begin, end) of a column that may have empty cells.
  [[nodiscard]] json gapped(const std::string& name, std::size_t begin, std::size_t end) const {
    const std::vector<double> all = io::numbers_or_gaps(table, name, file);
    std::vector<float> values;
    for (std::size_t row = begin; row < end; ++row)
      values.push_back(std::isfinite(all[row]) ? for_picture(all[row]) : std::numeric_limits<float>::quiet_NaN());
    return packed(values, {values.size()});
  }
  [[nodiscard]] bool has(const std::string& name) const {
    return std::ranges::count(table, name, &io::Column::name) > 0;
  }
  [[nodiscard]] json exact(const std::string& name) const { return packed(numbers(name), {numbers(name).size()}); }
  [[nodiscard]] json rough(const std::string& name) const {
    std::vector<float> values;
    for (const double value : numbers(name))
      values.push_back(std::isfinite(value) ? for_picture(value) : std::numeric_limits<float>::quiet_NaN());
    return packed(values, {values.size()});
  }
};

/// Limits of other methods, where the case asks for them.
json compared_of(const fs::path& folder, const LobesSummary& of) {
  json list = json::array();
  for (const ComparedSummary& other : of.compared) {
    const fs::path file = folder / fmt::format("{}_{}.csv", core::word_of(of.name), other.name);
    if (!fs::exists(file)) continue;
    const Source chart(file);
    list.push_back({{"name", other.name},
                    {"rpm", chart.exact("spindle_speed_rpm")},
                    {"depth_m", chart.rough("limiting_depth_m")},
                    {"status", chart.statuses()}});
  }
  return list;
}

json chart_of(const fs::path& folder, const std::string& name) {
  const Source chart(folder / (name + ".csv"));
  json result = {{"name", name},
                 {"rpm", chart.exact("spindle_speed_rpm")},
                 {"depth_m", chart.exact("limiting_depth_m")},
                 {"error_relative", chart.rough("error_estimate_relative")},
                 {"chatter_hz", chart.rough("chatter_frequency_hz")},
                 {"kind", chart.words("bifurcation")},
                 {"status", chart.statuses()}};
  for (const char* column :
       {"truncation_m", "noise_deviation_m", "identification_low_m", "identification_high_m", "robust_depth_m"}) {
    if (chart.has(column)) result[column] = chart.rough(column);
  }
  const fs::path file = folder / (name + "_crossings.csv");
  if (!fs::exists(file)) return result;
  const Source crossings(file);
  result["crossings"] = {{"rpm", crossings.exact("spindle_speed_rpm")},
                         {"depth_m", crossings.exact("depth_m")},
                         {"chatter_hz", crossings.rough("chatter_frequency_hz")},
                         {"kind", crossings.words("bifurcation")}};
  return result;
}

/// The forced motion over the speeds, a list of depths; rows of one depth follow each other.
json forced_curves(const fs::path& file) {
  const Source source(file);
  const auto& depth = source.numbers("depth_m");
  const auto& rpm = source.numbers("spindle_speed_rpm");
  json list = json::array();
  for (std::size_t begin = 0, end = 0; begin < depth.size(); begin = end) {
    while (end < depth.size() && depth[end] == depth[begin]) ++end;
    const std::vector<double> speeds(rpm.begin() + static_cast<std::ptrdiff_t>(begin),
                                     rpm.begin() + static_cast<std::ptrdiff_t>(end));
    list.push_back({{"depth_m", depth[begin]}, {"rpm", packed(speeds, {speeds.size()})}});
    for (const char* name : {"surface_location_error_m", "peak_force_n", "least_contact_force_n"}) {
      if (source.has(name)) list.back()[name] = source.gapped(name, begin, end);
    }
  }
  return list;
}

/// Forces over a period of every stable operating point of a chart, as many samples as a picture needs.
json forces_of(const fs::path& file, const Summary& summary, study::ChartOf chart) {
  constexpr std::size_t most = 1500;
  std::vector<const OperatingPointSummary*> points;
  for (const OperatingPointSummary& point : summary.operating_points) {
    if (point.chart == chart) points.push_back(&point);
  }
  const Source source(file);
  const auto& number = source.numbers("point");
  json list = json::array();
  for (std::size_t begin = 0, end = 0; begin < number.size(); begin = end) {
    while (end < number.size() && number[end] == number[begin]) ++end;
    const auto index = static_cast<std::size_t>(number[begin]) - 1;
    if (index >= points.size()) throw core::DataError(file.string() + ": a point that summary.json does not have");
    list.push_back({{"spindle_speed_rpm", points[index]->spindle_speed_rpm}, {"depth_m", points[index]->depth_m}});
    const std::size_t step = (end - begin + most - 1) / most;
    for (const char* name : {"rotation_rad", "force_feed_n", "force_normal_n", "force_axis_n"}) {
      const auto& all = source.numbers(name);
      std::vector<float> values;
      for (std::size_t row = begin; row + 1 < end; row += step) values.push_back(for_picture(all[row]));
      values.push_back(for_picture(all[end - 1]));
      list.back()[name] = packed(values, {values.size()});
    }
  }
  return list;
}

/// Depths over position and speed; every position has the same speeds.
json path_of(const fs::path& file, const std::string& name) {
  const Source path(file);
  const auto& position = path.numbers("position");
  const auto& rpm = path.numbers("spindle_speed_rpm");
  const auto& depth = path.numbers("limiting_depth_m");
  std::vector<double> places, speeds;
  std::vector<float> depths;
  for (std::size_t row = 0; row < position.size(); ++row) {
    if (row == 0 || position[row] != position[row - 1]) {
      for (const char* axis : {"x_m", "y_m", "z_m"}) places.push_back(path.numbers(axis)[row]);
    }
    if (position[row] == position.front()) speeds.push_back(rpm[row]);
    depths.push_back(for_picture(depth[row]));
  }
  const std::size_t positions = places.size() / 3;
  return {{"name", name},
          {"positions", packed(places, {positions, 3})},
          {"rpm", packed(speeds, {speeds.size()})},
          {"depth_m", packed(depths, {positions, speeds.size()})}};
}

/// The axis over which the lobes are drawn; the removal rate's factor follows from a pocket, if there is one.
json cutting_of(const Summary& summary) {
  json cutting = summary.cutting ? json_of(*summary.cutting) : json::object();
  for (const LobesSummary& chart : summary.lobes) {
    for (const PocketSummary& pocket : chart.best_pockets) {
      const double rate = pocket.removal_rate_cm3_per_min.value_or(0.0);
      const double per = pocket.depth_m * pocket.spindle_speed_rpm;
      if (rate > 0.0 && per > 0.0) cutting["removal_cm3_per_min_per_m_rpm"] = rate / per;
    }
  }
  return cutting;
}

}  // namespace

json lobes_data(const fs::path& results, const Summary& summary) {
  json run = {{"lobes", json::array()}, {"paths", json::array()}};
  const fs::path folder = results / "lobes";
  if (summary.lobes.empty()) return run;
  for (const LobesSummary& chart : summary.lobes) {
    const std::string name = core::word_of(chart.name);
    if (!fs::exists(folder / (name + ".csv"))) continue;
    run["lobes"].push_back(chart_of(folder, name));
    if (json others = compared_of(folder, chart); !others.empty()) run["lobes"].back()["compared"] = std::move(others);
    if (const fs::path forced = folder / (name + "_forced.csv"); fs::exists(forced))
      run["lobes"].back()["forced"] = forced_curves(forced);
    if (const fs::path forces = folder / (name + "_forces.csv"); fs::exists(forces))
      run["lobes"].back()["forces"] = forces_of(forces, summary, chart.name);
    run["lobes"].back()["tooth_passing_hz"] = chart.main_modes_hz;
    if (const fs::path path = folder / (name + "_path.csv"); fs::exists(path))
      run["paths"].push_back(path_of(path, name));
  }
  run["cutting"] = cutting_of(summary);
  if (json tool = tool_frf_data(folder / "tool_frf.csv"); !tool.is_null()) run["tool_frf"] = std::move(tool);
  return run;
}

}  // namespace thinwall::report
