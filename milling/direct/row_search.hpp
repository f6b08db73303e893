#pragma once
// The crossings of one speed on grids from coarse to fine, checked, however the loop's gain was come by.

#include <vector>

#include "milling/direct/critical_depths.hpp"
#include "milling/direct/lobe_row.hpp"
#include "milling/direct/refined_crossing.hpp"

namespace thinwall::milling {

/// Grids of one cut from coarse to fine, the search's view of them: crossings are found on level 0.
class SearchGrids {
 public:
  SearchGrids() = default;
  virtual ~SearchGrids() = default;
  SearchGrids(const SearchGrids&) = delete;
  SearchGrids& operator=(const SearchGrids&) = delete;

  /// Moves a crossing to the grid of a level ≥ 1.
  [[nodiscard]] virtual OnFinerGrid move_to(std::size_t level, Crossing& crossing) = 0;
  /// The relative error of a depth on that grid which its distance to other grids does not show.
  [[nodiscard]] virtual double unresolved(std::size_t /*level*/, double /*depth_m*/) { return 0.0; }
  /// Nodes of that grid.
  [[nodiscard]] virtual int nodes(std::size_t level) = 0;
  /// Multipliers outside of the unit circle.
  [[nodiscard]] virtual int unstable(std::size_t level, double depth_m) = 0;
  /// True if no multiplier lies outside of the unit circle.
  [[nodiscard]] virtual bool stable(std::size_t level, double depth_m) { return unstable(level, depth_m) == 0; }
  /// The chatter frequency of a crossing of that grid, Hz.
  [[nodiscard]] virtual double chatter_frequency_hz(std::size_t level, const Crossing& crossing) = 0;
};

/// Grids of a cut without helix, one a level for all depths; finer ones are made when they are asked for.
class FixedGrids : public SearchGrids {
 public:
  /// The loop's gain on the grid of a level.
  [[nodiscard]] virtual const GainOnCircle& gain(std::size_t level) = 0;
  /// True if a level beyond this one may be made.
  [[nodiscard]] virtual bool more_after(std::size_t level) = 0;
  [[nodiscard]] OnFinerGrid move_to(std::size_t level, Crossing& crossing) final;
};

/// The outcome of a search of the coarse grids.
struct CoarseCrossings {
  std::vector<Crossing> found;  ///< by rising depth
  double searched_m = 0.0;      ///< the depth up to which they are all
  double unstable_to_m = 0.0;   ///< from there on the cut was unstable wherever it was looked at, up to this depth; 0:
                                ///< it was not looked at
};

/// The options of a search: a twentieth beyond the depth limit, for a crossing that lies there on a coarse grid may lie
/// within on a finer one (a flip at 22.785 of 22.856 mm was 1 % deeper on the coarse grid, and its stable gap was
/// lost).
[[nodiscard]] StabilityOptions beyond_limit(StabilityOptions options);

/// A search of the coarse grid from small depths on until a crossing is found.
struct FirstCrossing {
  CriticalDepths search;
  std::vector<Crossing> found;  ///< empty: stable up to the limit
  double searched_m = 0.0;

  /// The depth of the first crossing, or the depth that was searched where there is none.
  [[nodiscard]] double depth_m() const { return found.empty() ? searched_m : found.front().depth_m; }
};

/// The search as said above.
[[nodiscard]] FirstCrossing first_crossing(const GainOnCircle& gain, const StabilityOptions& options);

/// The depth up to which a row's crossings are wanted, m: `follow` times the first, or the depth limit.
[[nodiscard]] double wanted_m(const std::vector<Crossing>& found, const StabilityOptions& options);

/// Extends the search to `follow` times the first crossing, if there is one; with `follow` = 1 those within a tenth of
/// it are kept, one of which may turn out to be the first on a finer grid. Returns the depth that was searched, m.
[[nodiscard]] double follow(FirstCrossing& first, const StabilityOptions& options);

/// The row of the crossings that a coarse search found: each on a finer grid, those that bound a stable range to the
/// tolerance; then the two counts of limiting_depth() (stability.hpp), deep crossings that do not add up left out. The
/// status tells what failed. The limit is filled in if there is a crossing. Throws NumericalError if an eigen-solution
/// fails.
[[nodiscard]] LobeRow checked_row(SearchGrids& grids, CoarseCrossings coarse, double spindle_speed_rpm,
                                  const StabilityOptions& options);

/// checked_row() of a cut without helix, from its first crossing on: followed up to `follow` times that one. Throws
/// NumericalError as CriticalDepths.
[[nodiscard]] LobeRow row_from(FixedGrids& grids, FirstCrossing first, double spindle_speed_rpm,
                               const StabilityOptions& options);

/// True if nothing failed that a finer grid could mend.
[[nodiscard]] bool sound(const LobeRow& row);

}  // namespace thinwall::milling
