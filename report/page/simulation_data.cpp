#include "report/page/simulation_data.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "core/error.hpp"
#include "core/words.hpp"
#include "io/results/csv_table.hpp"
#include "report/page/arrays.hpp"

namespace thinwall::report {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// The numbers of rows that a page carries of the tables of a point: fewer of each where there are many points.
struct RowLimits {
  std::size_t samples = 4320;  // of a trace: six turns of 720
  std::size_t passes = 2000, lines = 4000, places = 3000;
};

RowLimits rows_for(std::size_t points) {
  constexpr std::size_t at_full_length = 6, most_points = 60;
  RowLimits rows;
  const std::size_t share = std::clamp(points, at_full_length, most_points);
  for (std::size_t* count : {&rows.samples, &rows.passes, &rows.lines, &rows.places})
    *count = *count * at_full_length / share;
  return rows;
}

/// Numbers [from, to) of a list as a picture shows them.
json drawn(const std::vector<double>& all, std::size_t from, std::size_t to) {
  std::vector<float> values;
  values.reserve(to - from);
  for (std::size_t i = from; i < to; ++i)
    values.push_back(std::isfinite(all[i]) ? for_picture(all[i]) : std::numeric_limits<float>::quiet_NaN());
  return packed(values, {values.size()});
}

/// The last `most` rows of the columns of a table; the first one exactly, for it may be a time since long ago.
json last_rows(const fs::path& file, const std::vector<std::string>& columns, std::size_t most) {
  const io::Table table = io::read_csv(file);
  json result = json::object();
  for (const std::string& name : columns) {
    const std::vector<double>& all = io::numbers(table, name, file);
    const std::size_t from = all.size() > most ? all.size() - most : 0;
    if (&name != &columns.front()) {
      result[name] = drawn(all, from, all.size());
      continue;
    }
    const std::vector<double> exact(all.begin() + static_cast<std::ptrdiff_t>(from), all.end());
    result[name] = packed(exact, {exact.size()});
  }
  return result;
}

/// The first rows of a spectrum, up to the highest frequency at which any column has a thousandth of its largest value.
json spectrum_of(const fs::path& file, std::size_t most) {
  const std::vector<std::string> columns{"x_m", "y_m", "force_x_n", "force_y_n"};
  const io::Table table = io::read_csv(file);
  std::size_t end = 0;
  for (const std::string& name : columns) {
    const std::vector<double>& all = io::numbers(table, name, file);
    const double least = 1e-3 * *std::ranges::max_element(all);
    for (std::size_t i = end; i < all.size(); ++i)
      if (all[i] > least) end = i + 1;
  }
  end = std::min(end, most);
  json result = {{"frequency_hz", drawn(io::numbers(table, "frequency_hz", file), 0, end)}};
  for (const std::string& name : columns) result[name] = drawn(io::numbers(table, name, file), 0, end);
  return result;
}

json walls_of(const fs::path& file, std::size_t most) {
  const io::Table table = io::read_csv(file);
  const auto& side = io::numbers(table, "side", file);
  const auto& height = io::numbers(table, "height_m", file);
  const auto& x = io::numbers(table, "x_m", file);
  const auto& error = io::numbers(table, "error_m", file);
  json list = json::array();
  for (std::size_t begin = 0, end = 0; begin < side.size(); begin = end) {
    while (end < side.size() && side[end] == side[begin] && height[end] == height[begin]) ++end;
    const std::size_t shown = std::min(end, begin + most);
    list.push_back({{"side", side[begin] > 0.0 ? "+normal" : "-normal"},
                    {"height_m", height[begin]},
                    {"x_m", drawn(x, begin, shown)},
                    {"error_m", drawn(error, begin, shown)}});
  }
  return list;
}

json point_of(const fs::path& folder, const SimulatedPointSummary& point, const RowLimits& rows) {
  json result = {{"files", point.files}};
  const auto add = [&](const char* key, const std::string& ending, const auto& made) {
    if (const fs::path file = folder / (point.files + ending); fs::exists(file)) result[key] = made(file);
  };
  add("trace", ".csv", [&rows](const fs::path& file) {
    return last_rows(file, {"time_s", "x_m", "y_m", "force_x_n", "force_y_n", "torque_n_m"}, rows.samples);
  });
  add("spectrum", "-spectrum.csv", [&rows](const fs::path& file) { return spectrum_of(file, rows.lines); });
  add("passes", "-passes.csv", [&rows](const fs::path& file) {
    return last_rows(file, {"entry_s", "tooth", "entry_x_m", "entry_y_m", "entry_x_m_s", "entry_y_m_s"}, rows.passes);
  });
  add("walls", "-wall.csv", [&rows](const fs::path& file) { return walls_of(file, rows.places); });
  return result;
}

/// The words of a column.
const std::vector<std::string>& words(const io::Table& table, const std::string& name, const fs::path& file) {
  for (const io::Column& column : table) {
    const auto* list = std::get_if<std::vector<std::string>>(&column.values);
    if (column.name == name && list != nullptr) return *list;
  }
  throw core::DataError(file.string() + ": has no column \"" + name + "\" of words; run the case again");
}

/// The vibration, speeds × depths as the table has it; NaN where there is none to be trusted.
json map_of(const fs::path& file, const AmplitudeMapSummary& map) {
  const io::Table table = io::read_csv(file);
  const auto& speed = io::numbers(table, "spindle_speed_rpm", file);
  const auto& depth = io::numbers(table, "depth_m", file);
  const auto& amplitude = io::numbers(table, "peak_to_peak_m", file);
  const auto speeds = static_cast<std::size_t>(map.speeds), depths = static_cast<std::size_t>(map.depths);
  if (amplitude.size() != speeds * depths)
    throw core::DataError(file.string() + ": has not as many points as summary.json tells");
  std::vector<double> rpm;
  rpm.reserve(speeds);
  for (std::size_t s = 0; s < speeds; ++s) rpm.push_back(speed[s * depths]);
  std::vector<float> values;
  values.reserve(amplitude.size());
  const auto& status = words(table, "status", file);
  for (std::size_t i = 0; i < amplitude.size(); ++i)
    values.push_back(status[i] == "completed" ? for_picture(amplitude[i]) : std::numeric_limits<float>::quiet_NaN());
  return {{"name", core::word_of(map.chart)},
          {"rpm", packed(rpm, {speeds})},
          {"depth_m", packed(std::vector<double>(depth.begin(), depth.begin() + map.depths), {depths})},
          {"peak_to_peak_m", packed(values, {speeds, depths})}};
}

}  // namespace

json simulation_data(const fs::path& results, const Summary& summary) {
  if (!summary.simulation) return nullptr;
  const fs::path folder = results / "simulation";
  json data = {{"points", json::array()}, {"maps", json::array()}};
  const RowLimits rows = rows_for(summary.simulation->points.size());
  for (const SimulatedPointSummary& point : summary.simulation->points)
    data["points"].push_back(point_of(folder, point, rows));
  for (const AmplitudeMapSummary& map : summary.simulation->maps) {
    const fs::path file = folder / (core::word_of(map.chart) + "_map.csv");
    if (fs::exists(file)) data["maps"].push_back(map_of(file, map));
  }
  return data;
}

}  // namespace thinwall::report
