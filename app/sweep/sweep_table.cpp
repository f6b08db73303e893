#include "app/sweep/sweep_table.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/units.hpp"

namespace thinwall::app {

namespace {

/// A figure that is known.
void add_figure(SweepFigures& figures, const std::string& column, double value) {
  if (std::isfinite(value)) figures.emplace_back(column, value);
}

/// The first three modes.
void add_modes(SweepFigures& figures, const std::string& name, const std::vector<double>& frequencies_hz) {
  constexpr std::size_t most = 3;
  for (std::size_t i = 0; i < std::min(most, frequencies_hz.size()); ++i)
    add_figure(figures, name + "_mode_" + std::to_string(i + 1) + "_hz", frequencies_hz[i]);
}

std::vector<double> elastic_hz(const report::PartSummary& part) {
  std::vector<double> frequencies;
  for (const report::PartModeSummary& mode : part.modes) {
    if (!mode.rigid_body) frequencies.push_back(mode.frequency_hz);
  }
  return frequencies;
}

/// Frequencies of all modes of part and robot, or of the main ones where these are all that is known.
std::vector<double> supported_hz(const report::CouplingSummary& coupling) {
  std::vector<double> frequencies;
  for (const report::ModeSummary& mode : coupling.modes) frequencies.push_back(mode.frequency_hz);
  if (!frequencies.empty()) return frequencies;
  for (const report::MainModeSummary& mode : coupling.main_modes) frequencies.push_back(mode.frequency_hz);
  return frequencies;
}

void add_chart(SweepFigures& figures, const report::LobesSummary& chart) {
  const std::string name = core::word_of(chart.name);
  if (const auto& row = chart.at_case_speed) {
    add_figure(figures, name + "_depth_at_speed_mm", row->limiting_depth_m * 1e3);
    figures.emplace_back(name + "_depth_at_limit", row->at_depth_limit ? 1.0 : 0.0);
  }
  add_figure(figures, name + "_least_depth_mm", chart.minimum_depth_m * 1e3);
  add_figure(figures, name + "_least_depth_at_rpm", chart.at_spindle_speed_rpm);
}

std::optional<double> figure(const SweepRow& row, const std::string& column) {
  const auto found = std::ranges::find(row.figures, column, &std::pair<std::string, double>::first);
  return found == row.figures.end() ? std::nullopt : std::optional(found->second);
}

/// A field of a CSV file after RFC 4180.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? std::string("\"\"") : std::string(1, c);
  return field + "\"";
}

using TextTable = std::vector<std::vector<std::string>>;

/// Columns to the right, two spaces between them.
std::string aligned(const TextTable& table) {
  std::vector<std::size_t> width(table.front().size());
  for (const auto& row : table) {
    for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], row[i].size());
  }
  std::string text;
  for (const auto& row : table) {
    for (std::size_t i = 0; i < row.size(); ++i) text += "  " + std::string(width[i] - row[i].size(), ' ') + row[i];
    text += '\n';
  }
  return text;
}

bool for_the_terminal(const std::string& column) {
  return !column.ends_with("_mode_2_hz") && !column.ends_with("_mode_3_hz") && !column.ends_with("_at_rpm") &&
         !column.ends_with("_at_limit");
}

}  // namespace

SweepFigures sweep_figures(const report::Summary& summary) {
  SweepFigures figures;
  if (summary.part) add_modes(figures, "part", elastic_hz(*summary.part));
  if (summary.coupling) {
    add_modes(figures, "supported", supported_hz(*summary.coupling));
    if (!summary.coupling->reductions.empty())
      add_figure(figures, "vibration_falls_percent", summary.coupling->reductions.front().reduction * 100.0);
  }
  for (const report::LobesSummary& chart : summary.lobes) add_chart(figures, chart);
  return figures;
}

std::vector<std::string> SweepTable::columns() const {
  std::vector<std::string> names;
  for (const auto& row : rows) {
    auto after = names.begin();  // a column that earlier rows lack goes behind its left neighbour
    for (const auto& [column, value] : row.figures) {
      const auto found = std::ranges::find(names, column);
      after = (found == names.end() ? names.insert(after, column) : found) + 1;
    }
  }
  return names;
}

std::string sweep_csv(const SweepTable& table) {
  const auto columns = table.columns();
  std::string text = "point";
  for (const auto& axis : table.axes) text += "," + csv_field(axis.title());
  for (const auto& column : columns) text += "," + csv_field(column);
  text += ",status,reason\n";
  for (const auto& row : table.rows) {
    text += std::to_string(row.number);
    for (std::size_t i = 0; i < table.axes.size(); ++i) text += "," + csv_field(table.axes[i].entry(row.point[i]));
    for (const auto& column : columns) {
      const auto value = figure(row, column);
      text += "," + (value ? core::number_text(*value) : "");
    }
    text += "," + row.status + "," + csv_field(row.reason) + "\n";
  }
  return text;
}

std::string sweep_text(const SweepTable& table) {
  auto columns = table.columns();
  std::erase_if(columns, [](const std::string& column) { return !for_the_terminal(column); });
  TextTable cells(1, {"point"});
  for (const auto& axis : table.axes) cells.front().push_back(axis.title());
  for (const auto& column : columns) cells.front().push_back(column);
  cells.front().emplace_back("status");
  for (const auto& row : table.rows) {
    std::vector<std::string> line{std::to_string(row.number)};
    for (std::size_t i = 0; i < table.axes.size(); ++i) line.push_back(table.axes[i].entry(row.point[i]));
    for (const auto& column : columns) {
      const auto value = figure(row, column);
      line.push_back(value ? core::number_text(*value, 4) : "-");
    }
    line.push_back(row.status);
    cells.push_back(std::move(line));
  }
  std::string text = aligned(cells);
  for (const auto& row : table.rows) {
    if (!row.reason.empty()) text += "  point " + std::to_string(row.number) + ": " + row.reason + "\n";
  }
  return text;
}

}  // namespace thinwall::app
