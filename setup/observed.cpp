#include "setup/observed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "core/error.hpp"
#include "io/results/csv_table.hpp"

namespace thinwall::setup {

namespace {

bool has_column(const io::Table& table, const std::string& name) {
  return std::ranges::count(table, name, &io::Column::name) > 0;
}

/// The words of a column. Throws DataError if there is none of that name, or if it holds numbers.
const std::vector<std::string>& words_of(const io::Table& table, const std::string& name,
                                         const std::filesystem::path& path) {
  const auto column = std::ranges::find(table, name, &io::Column::name);
  const auto* words = column == table.end() ? nullptr : std::get_if<std::vector<std::string>>(&column->values);
  if (words == nullptr) {
    throw core::DataError(fmt::format("{}: no column of words \"{}\"; say stable, chatter or marginal of every cut",
                                      path.string(), name));
  }
  return *words;
}

double require_positive(double value, const std::string& what, const std::string& place) {
  if (value > 0.0 && std::isfinite(value)) return value;
  throw core::DataError(fmt::format("{}: {} {:g} must be above 0 and finite", place, what, value));
}

milling::CutOutcome outcome_of(const std::string& word, const std::string& place) {
  if (const auto outcome = core::from_word<milling::CutOutcome>(word)) return *outcome;
  throw core::DataError(
      fmt::format("{}: \"{}\" is no outcome of a cut; write stable, chatter or marginal", place, word));
}

}  // namespace

std::vector<milling::ObservedCut> all_cuts(const std::vector<ObservedCuts>& entries) {
  std::vector<milling::ObservedCut> all;
  for (const ObservedCuts& entry : entries) std::ranges::copy(entry.cuts, std::back_inserter(all));
  return all;
}

std::vector<milling::ObservedCut> read_observed_cuts(const std::filesystem::path& path) {
  const io::Table table = io::read_csv(path);
  const bool metres = has_column(table, "depth_m");
  const std::string depth_name = metres ? "depth_m" : "depth_mm";
  const std::vector<double>& speeds = io::numbers(table, "spindle_speed_rpm", path);
  const std::vector<double>& depths = io::numbers(table, depth_name, path);
  const std::vector<std::string>& outcomes = words_of(table, "observed", path);
  std::vector<double> heard;
  if (has_column(table, "chatter_frequency_hz")) heard = io::numbers_or_gaps(table, "chatter_frequency_hz", path);
  std::vector<milling::ObservedCut> cuts;
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    const std::string place = fmt::format("{}, cut {}", path.string(), i + 1);
    milling::ObservedCut cut{require_positive(speeds[i], "spindle_speed_rpm", place),
                             require_positive(depths[i], depth_name, place) * (metres ? 1.0 : 1e-3),
                             outcome_of(outcomes[i], place)};
    if (!heard.empty() && !std::isnan(heard[i]))
      cut.chatter_frequency_hz = require_positive(heard[i], "chatter_frequency_hz", place);
    cuts.push_back(cut);
  }
  return cuts;
}

}  // namespace thinwall::setup
