#include "milling/lobe_field.hpp"

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "milling/row_search.hpp"

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
      field.rows_not_converged += sound(row) ? 0 : 1;
      minimum = std::min(minimum, row.limiting_depth_m);
      if (row.limiting_depth_m >= field.weakest_depth_m[i]) continue;
      field.weakest_depth_m[i] = row.limiting_depth_m;
      field.weakest_at[i] = position;
    }
    field.minimum_depth_m.push_back(minimum);
  }
}

}  // namespace

LobeField lobe_field(const std::vector<RelativeStructure>& structures, const MillingProcess& process,
                     const std::vector<double>& spindle_speeds_rpm, StabilityOptions options) {
  if (structures.empty() || spindle_speeds_rpm.empty()) {
    throw core::InputError("lobe field: " + std::to_string(structures.size()) + " positions and " +
                           std::to_string(spindle_speeds_rpm.size()) +
                           " spindle speeds, one of each at least is needed; give a path and a range");
  }
  options.follow = 1.0;
  LobeField field;
  field.spindle_speeds_rpm = spindle_speeds_rpm;
  field.rows.assign(structures.size(), std::vector<LobeRow>(spindle_speeds_rpm.size()));
  core::parallel_for(spindle_speeds_rpm.size(), [&](std::size_t i) {
    StabilityOptions from_neighbour = options;
    for (std::size_t position = 0; position < structures.size(); ++position) {
      LobeRow& row = field.rows[position][i];
      row = limiting_depth(structures[position], process, spindle_speeds_rpm[i], from_neighbour);
      from_neighbour.expected_depth_m = row.limiting_depth_m;
    }
  });
  summarise(field);
  return field;
}

}  // namespace thinwall::milling
