#include "milling/chart/lobe_field.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <mutex>
#include <utility>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "milling/direct/stability.hpp"

namespace thinwall::milling {

namespace {

void summarise(LobeField& field) {
  const std::size_t speeds = field.spindle_speeds_rpm.size();
  field.weakest_depth_m.assign(speeds, std::numeric_limits<double>::infinity());
  field.weakest_at.assign(speeds, 0);
  for (std::size_t position = 0; position < field.rows.size(); ++position) {
    double minimum = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < speeds; ++i) {
      const LobeRow& row = field.rows[position][i];
      field.rows_at_limit += row.at_limit ? 1 : 0;
      field.rows_not_converged += answers(row.status) ? 0 : 1;
      minimum = std::min(minimum, row.limiting_depth_m);
      if (row.limiting_depth_m >= field.weakest_depth_m[i]) continue;
      field.weakest_depth_m[i] = row.limiting_depth_m;
      field.weakest_at[i] = position;
    }
    field.minimum_depth_m.push_back(minimum);
  }
}

/// limiting_depth() at a position and a speed.
using RowAtPosition = std::function<LobeRow(std::size_t position, double rpm, const StabilityOptions& options)>;

std::vector<LobeRow> rows_at_speed(std::size_t positions, const RowAtPosition& row_at, double rpm,
                                   StabilityOptions options) {
  std::vector<LobeRow> rows;
  rows.reserve(positions);
  for (std::size_t position = 0; position < positions; ++position) {
    rows.push_back(row_at(position, rpm, options));
    options.expected_depth_m = rows.back().limiting_depth_m;
  }
  return rows;
}

LobeField field_of(std::size_t positions, const RowAtPosition& row_at, const std::vector<double>& spindle_speeds_rpm,
                   StabilityOptions options, const KeptRows& kept) {
  if (positions == 0 || spindle_speeds_rpm.empty()) {
    throw core::InputError("lobe field: " + std::to_string(positions) + " positions and " +
                           std::to_string(spindle_speeds_rpm.size()) +
                           " spindle speeds, one of each at least is needed; give a path and a range");
  }
  options.follow = 1.0;
  LobeField field;
  field.spindle_speeds_rpm = spindle_speeds_rpm;
  field.rows.assign(positions, std::vector<LobeRow>(spindle_speeds_rpm.size()));
  core::Progress progress("speeds along the path", spindle_speeds_rpm.size());
  std::mutex adding;
  core::parallel_for(spindle_speeds_rpm.size(), [&](std::size_t i) {
    std::vector<LobeRow> along = kept.find ? kept.find(i) : std::vector<LobeRow>{};
    if (along.size() != positions) {
      along = rows_at_speed(positions, row_at, spindle_speeds_rpm[i], options);
      const std::lock_guard lock(adding);
      if (kept.add) kept.add(i, along);
    }
    for (std::size_t position = 0; position < positions; ++position)
      field.rows[position][i] = std::move(along[position]);
    progress.step();
  });
  summarise(field);
  return field;
}

}  // namespace

LobeField lobe_field(const std::vector<RelativeStructure>& structures, const MillingProcess& process,
                     const std::vector<double>& spindle_speeds_rpm, StabilityOptions options, const KeptRows& kept) {
  const auto row_at = [&](std::size_t position, double rpm, const StabilityOptions& with) {
    return limiting_depth(structures[position], process, rpm, with);
  };
  return field_of(structures.size(), row_at, spindle_speeds_rpm, options, kept);
}

LobeField lobe_field(const FittedStructure& tool, const std::vector<RelativeStructure>& structures,
                     const MillingProcess& process, const std::vector<double>& spindle_speeds_rpm,
                     StabilityOptions options, const KeptRows& kept) {
  require_usable(process, options);
  const auto row_at = [&](std::size_t position, double rpm, const StabilityOptions& with) {
    return limiting_depth(beside(tool, structures[position]), process, rpm, with);
  };
  return field_of(structures.size(), row_at, spindle_speeds_rpm, options, kept);
}

}  // namespace thinwall::milling
