#include "milling/chart/lobes.hpp"

#include <algorithm>
#include <mutex>
#include <optional>
#include <sstream>
#include <utility>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"

namespace thinwall::milling {

Lobes lobes_of(std::vector<LobeRow> rows, std::string method) {
  if (rows.empty()) throw core::InputError("stability lobes: no spindle speeds, at least 1 is needed; give a range");
  Lobes lobes;
  lobes.method = std::move(method);
  lobes.rows = std::move(rows);
  const auto least = std::min_element(lobes.rows.begin(), lobes.rows.end(), [](const LobeRow& a, const LobeRow& b) {
    return a.limiting_depth_m < b.limiting_depth_m;
  });
  lobes.minimum_depth_m = least->limiting_depth_m;
  lobes.at_spindle_speed_rpm = least->spindle_speed_rpm;
  for (const LobeRow& row : lobes.rows) {
    if (row.at_limit) ++lobes.rows_at_limit;
    if (!row.at_limit || !answers(row.status))
      lobes.worst_error_estimate = std::max(lobes.worst_error_estimate, row.error_estimate);
    if (!answers(row.status)) ++lobes.rows_not_converged;
  }
  return lobes;
}

std::vector<double> spindle_speeds(double from_rpm, double to_rpm, int count) {
  if (!(from_rpm > 0.0) || !(to_rpm > from_rpm) || count < 2) {
    std::ostringstream text;
    text << "spindle speeds: " << count << " from " << from_rpm << " to " << to_rpm
         << " rpm, must be at least 2, rising from above 0; correct the speed range";
    throw core::InputError(text.str());
  }
  std::vector<double> speeds(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    speeds[static_cast<std::size_t>(i)] = from_rpm + (to_rpm - from_rpm) * i / (count - 1);
  }
  return speeds;
}

std::vector<LobeRow> rows_by_blocks(const std::vector<double>& spindle_speeds_rpm,
                                    const std::function<LobeRow(double, std::optional<double>)>& at,
                                    const KeptRows& kept) {
  constexpr std::size_t block = 8;  // of speeds, whose searches begin at their neighbour's limit
  const std::size_t count = spindle_speeds_rpm.size();
  std::vector<LobeRow> rows(count);
  std::mutex adding;
  core::Progress progress("speeds", count);
  core::parallel_for((count + block - 1) / block, [&](std::size_t b) {
    const std::size_t first = block * b, size = std::min(block, count - first);
    std::vector<LobeRow> found = kept.find ? kept.find(first) : std::vector<LobeRow>{};
    const bool is_new = found.size() != size;
    if (is_new) found.clear();
    std::optional<double> expected;
    for (std::size_t i = 0; i < size; ++i) {
      if (is_new) found.push_back(at(spindle_speeds_rpm[first + i], expected));
      expected = found[i].limiting_depth_m;
      progress.step();
    }
    if (is_new && kept.add) {
      const std::lock_guard lock(adding);
      kept.add(first, found);
    }
    std::move(found.begin(), found.end(), rows.begin() + static_cast<std::ptrdiff_t>(first));
  });
  return rows;
}

std::vector<LobeRow> separate_rows(const std::vector<double>& spindle_speeds_rpm,
                                   const std::function<LobeRow(std::size_t)>& at, std::size_t first,
                                   const KeptRows& kept) {
  std::vector<LobeRow> rows(spindle_speeds_rpm.size());
  std::mutex adding;
  core::Progress progress("speeds between", rows.size());
  core::parallel_for(rows.size(), [&](std::size_t i) {
    const std::vector<LobeRow> found = kept.find ? kept.find(first + i) : std::vector<LobeRow>{};
    if (found.size() == 1 && found.front().spindle_speed_rpm == spindle_speeds_rpm[i]) {
      rows[i] = found.front();
    } else {
      rows[i] = at(i);
      const std::lock_guard lock(adding);
      if (kept.add) kept.add(first + i, {rows[i]});
    }
    progress.step();
  });
  return rows;
}

Lobes stability_lobes(const LobeMethod& method, const std::vector<double>& spindle_speeds_rpm, const KeptRows& kept) {
  const auto at = [&method](double rpm, std::optional<double> expected) {
    return method.limiting_depth(rpm, expected);
  };
  Lobes lobes = lobes_of(rows_by_blocks(spindle_speeds_rpm, at, kept), method.name());
  lobes.residual_share = method.residual_share();
  return lobes;
}

Lobes stability_lobes(const RelativeStructure& structure, const MillingProcess& process,
                      const std::vector<double>& spindle_speeds_rpm, const StabilityOptions& options) {
  return stability_lobes(*lobe_method(Method::direct, structure, process, {options}), spindle_speeds_rpm);
}

}  // namespace thinwall::milling
