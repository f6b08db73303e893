#include "milling/row_search.hpp"

#include <algorithm>
#include <utility>

namespace thinwall::milling {

namespace {

/// All crossings in ascending depth; those that bound a stable range to the tolerance.
std::vector<RefinedCrossing> refined(SearchGrids& grids, std::vector<Crossing> found, const StabilityOptions& options,
                                     LobeRow& row) {
  std::vector<RefinedCrossing> all;
  for (Crossing& crossing : found) {
    all.push_back({std::move(crossing)});
    refine_until(1, 1.0, grids.to_level(), all.back());
  }
  const auto ascending = [&] {
    std::stable_sort(all.begin(), all.end(), [](const RefinedCrossing& a, const RefinedCrossing& b) {
      return a.crossing.depth_m < b.crossing.depth_m;
    });
  };
  ascending();
  // What lies this near to the first may turn out to be the first.
  const double beside_first_m = all.empty() ? 0.0 : 1.01 * all.front().crossing.depth_m;
  int count = 0;  // of unstable multipliers above the crossings so far
  for (RefinedCrossing& c : all) {
    const bool bounds = count == 0 || count + c.crossing.unstable_change == 0 || c.crossing.depth_m <= beside_first_m;
    count += c.crossing.unstable_change;
    if (!bounds || c.crossing.depth_m > options.depth_limit_m) continue;
    refine_until(2, options.error_tolerance, grids.to_level(), c);
    const double beyond_grids = c.kept ? grids.error_beyond_grids(c.level, c.crossing) : 0.0;
    if (!c.kept) row.status = StabilityStatus::crossing_missed;
    else if (c.error_estimate > options.error_tolerance) row.status = StabilityStatus::node_limit_reached;
    else if (beyond_grids > options.error_tolerance) row.status = StabilityStatus::range_limited;
    c.error_estimate += beyond_grids;
  }
  if (options.follow > 1.0 && grids.unstable(0, row.searched_m) != count) row.status = StabilityStatus::crossing_missed;
  ascending();
  return all;
}

}  // namespace

ToLevel SearchGrids::to_level() {
  return [this](std::size_t level, Crossing& crossing) {
    if (level > 1 && !more_after(level - 1)) return OnFinerGrid::none_finer;
    return refine(gain(level), crossing) ? OnFinerGrid::kept : OnFinerGrid::lost;
  };
}

FirstCrossing first_crossing(const GainOnCircle& gain, const StabilityOptions& options) {
  constexpr double step = 1.5;
  FirstCrossing first{CriticalDepths(gain), {}, 0.0};
  const double expected = 1.1 * options.expected_depth_m.value_or(0.75 * first.search.none_below_m());
  first.searched_m = std::max(expected, first.search.none_below_m()) / step;
  do {
    first.searched_m = std::min(options.depth_limit_m, step * first.searched_m);
    first.found = first.search.up_to(first.searched_m);
  } while (first.found.empty() && first.searched_m < options.depth_limit_m);
  return first;
}

double follow(FirstCrossing& first, const StabilityOptions& options) {
  if (first.found.empty()) return first.searched_m;
  const double first_m = first.found.front().depth_m;
  if (options.follow == 1.0) {
    std::erase_if(first.found, [&](const Crossing& c) { return c.depth_m > 1.1 * first_m; });
    return first_m;
  }
  const double reach = std::min(options.depth_limit_m, options.follow * first_m);
  if (reach <= first.searched_m) return first.searched_m;
  first.found = first.search.up_to(reach);
  return reach;
}

LobeRow row_from(SearchGrids& grids, FirstCrossing first, double spindle_speed_rpm, const StabilityOptions& options) {
  LobeRow row;
  row.spindle_speed_rpm = spindle_speed_rpm;
  row.searched_m = follow(first, options);
  std::size_t finest = 1;
  for (const RefinedCrossing& c : refined(grids, std::move(first.found), options, row)) {
    if (c.crossing.depth_m > options.depth_limit_m) continue;
    finest = std::max(finest, c.level);
    row.crossings.push_back(lobe_point(c, grids.chatter_frequency_hz(c.level, c.crossing)));
  }
  row.nodes = grids.nodes(finest);
  const double below = row.crossings.empty() ? row.searched_m : 0.999 * row.crossings.front().depth_m;
  if (grids.unstable(finest, below) != 0) row.status = StabilityStatus::crossing_missed;
  take_limit_from_crossings(row);
  return row;
}

bool sound(const LobeRow& row) {
  return row.status == StabilityStatus::converged || row.status == StabilityStatus::range_limited ||
         row.status == StabilityStatus::stable_to_depth_limit;
}

}  // namespace thinwall::milling
