#include "milling/direct/row_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace thinwall::milling {

namespace {

void sort_by_depth(std::vector<RefinedCrossing>& all) {
  std::stable_sort(all.begin(), all.end(), [](const RefinedCrossing& a, const RefinedCrossing& b) {
    return a.crossing.depth_m < b.crossing.depth_m;
  });
}

ToLevel to_level_of(SearchGrids& grids) {
  return [&grids](std::size_t level, Crossing& crossing) { return grids.move_to(level, crossing); };
}

Unresolved unresolved_of(SearchGrids& grids) {
  return [&grids](std::size_t level, const Crossing& crossing) { return grids.unresolved(level, crossing.depth_m); };
}

/// Leaves out the deepest crossing. The depths up to it are no longer known to be searched: the row ends half way, in
/// ratio, between the two deepest.
void drop_last(std::vector<RefinedCrossing>& all, LobeRow& row) {
  const double deepest = all.back().crossing.depth_m;
  all.pop_back();
  row.searched_m = std::sqrt(all.back().crossing.depth_m * std::min(deepest, row.searched_m));
}

/// Refines the crossings that bound a stable range to the tolerance; `all` ends before one of them that gets lost.
/// Returns the sum of the changes of those that are left: the multipliers that should be unstable at the end.
int refine_boundaries(SearchGrids& grids, std::vector<RefinedCrossing>& all, const StabilityOptions& options,
                      LobeRow& row) {
  // A crossing this near to the first may turn out to be the first on a finer grid.
  const double beside_first_m = 1.01 * all.front().crossing.depth_m;
  int count = 0;  // of unstable multipliers above the crossings so far
  for (std::size_t i = 0; i < all.size(); ++i) {
    RefinedCrossing& c = all[i];
    // A stable range ends where the first multiplier leaves the circle, and begins where the last one returns. What
    // crosses while others are outside changes no limit, so that the second grid does for it.
    const bool bounds = count == 0 || count + c.crossing.unstable_change == 0 || c.crossing.depth_m <= beside_first_m;
    count += c.crossing.unstable_change;
    if (!bounds || c.crossing.depth_m > options.depth_limit_m) continue;
    refine_until(2, options.error_tolerance, to_level_of(grids), unresolved_of(grids), c);
    // A deep crossing that finer grids do not have was one of the coarse grid only, and what is beyond it is as
    // doubtful. The limiting depth does not depend on it, and the row ends before. Without the first one there is no
    // row.
    if (!c.kept && i > 0 && c.crossing.depth_m > beside_first_m) {
      count -= c.crossing.unstable_change;
      while (all.size() > i) drop_last(all, row);
      return count;
    }
    if (!c.kept) row.status = StabilityStatus::crossing_missed;
    else if (row.status == StabilityStatus::crossing_missed) continue;
    else if (c.error_estimate > options.error_tolerance) row.status = StabilityStatus::node_limit_reached;
  }
  return count;
}

/// All crossings in ascending depth, as deep as they add up to the count of unstable multipliers.
std::vector<RefinedCrossing> refined(SearchGrids& grids, std::vector<Crossing> found, const StabilityOptions& options,
                                     LobeRow& row) {
  std::vector<RefinedCrossing> all;
  all.reserve(found.size());
  // One finer grid for each before anything is said of their order: the coarse grid's may be another.
  for (Crossing& crossing : found) {
    all.push_back({std::move(crossing)});
    refine_until(1, 1.0, to_level_of(grids), unresolved_of(grids), all.back());
  }
  sort_by_depth(all);
  int count = all.empty() ? 0 : refine_boundaries(grids, all, options, row);
  // The count knows nothing of how crossings are found. Where it differs one was missed or is none, as a rule a deep
  // one: the row is cut back to where both agree. With `follow` = 1 there is the first crossing alone, which is checked
  // below it in any case.
  if (options.follow > 1.0) {
    while (grids.unstable(0, row.searched_m) != count) {
      if (all.size() <= 1) {
        row.status = StabilityStatus::crossing_missed;
        break;
      }
      count -= all.back().crossing.unstable_change;
      drop_last(all, row);
    }
  }
  sort_by_depth(all);
  return all;
}

}  // namespace

OnFinerGrid FixedGrids::move_to(std::size_t level, Crossing& crossing) {
  if (level > 1 && !more_after(level - 1)) return OnFinerGrid::none_finer;
  return refine(gain(level), crossing) ? OnFinerGrid::kept : OnFinerGrid::lost;
}

StabilityOptions beyond_limit(StabilityOptions options) {
  options.depth_limit_m *= 1.05;
  return options;
}

FirstCrossing first_crossing(const GainOnCircle& gain, const StabilityOptions& options) {
  // Each search costs an eigenvalue problem at every stop that the depth can reach, so that a search to the limit of a
  // cut that chatters at a hundredth of it would be dear. A neighbour's depth is passed by a tenth, so that one search
  // is enough where the lobes change little from speed to speed.
  constexpr double step = 1.5;
  FirstCrossing first{CriticalDepths(gain, CriticalDepths::Eigenvalues::deeper), {}, 0.0};
  const double expected = 1.1 * options.expected_depth_m.value_or(0.0);
  first.searched_m = (expected > 0.0 ? expected : first.search.none_below_m()) / step;
  do {
    first.searched_m = std::min(options.depth_limit_m, step * first.searched_m);
    first.found = first.search.up_to(first.searched_m);
  } while (first.found.empty() && first.searched_m < options.depth_limit_m);
  return first;
}

double wanted_m(const std::vector<Crossing>& found, const StabilityOptions& options) {
  if (found.empty()) return options.depth_limit_m;
  return std::min(options.depth_limit_m, options.follow * found.front().depth_m);
}

double follow(FirstCrossing& first, const StabilityOptions& options) {
  if (first.found.empty()) return first.searched_m;
  const double wanted = wanted_m(first.found, options);
  if (options.follow == 1.0) {
    std::erase_if(first.found, [&](const Crossing& c) { return c.depth_m > 1.1 * wanted; });
    return wanted;
  }
  if (wanted <= first.searched_m) return first.searched_m;
  first.found = first.search.up_to(wanted);
  return wanted;
}

LobeRow row_from(FixedGrids& grids, FirstCrossing first, double spindle_speed_rpm, const StabilityOptions& options) {
  const double searched_m = follow(first, beyond_limit(options));
  return checked_row(grids, {std::move(first.found), searched_m}, spindle_speed_rpm, options);
}

LobeRow checked_row(SearchGrids& grids, CoarseCrossings coarse, double spindle_speed_rpm,
                    const StabilityOptions& options) {
  LobeRow row;
  row.spindle_speed_rpm = spindle_speed_rpm;
  row.searched_m = coarse.searched_m;
  std::size_t finest = 1;
  const std::vector<RefinedCrossing> all = refined(grids, std::move(coarse.found), options, row);
  // That the cut is unstable from the end of the search on says nothing where the row was cut back below that end.
  if (row.searched_m == coarse.searched_m) row.searched_m = std::max(row.searched_m, coarse.unstable_to_m);
  row.searched_m = std::min(row.searched_m, options.depth_limit_m);
  for (const RefinedCrossing& c : all) {
    if (c.crossing.depth_m > options.depth_limit_m) continue;
    finest = std::max(finest, c.level);
    row.crossings.push_back(lobe_point(c, grids.chatter_frequency_hz(c.level, c.crossing)));
  }
  row.nodes = grids.nodes(finest);
  // The limiting depth rests on nothing unstable below it, which is counted a thousandth below.
  const double below = row.crossings.empty() ? row.searched_m : 0.999 * row.crossings.front().depth_m;
  if (!grids.stable(finest, below)) row.status = StabilityStatus::crossing_missed;
  take_limit_from_crossings(row);
  return row;
}

bool sound(const LobeRow& row) {
  return row.status == StabilityStatus::converged || row.status == StabilityStatus::stable_to_depth_limit;
}

}  // namespace thinwall::milling
