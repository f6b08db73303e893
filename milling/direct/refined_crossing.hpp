#pragma once
// A crossing on finer and finer grids, until its error estimate meets a tolerance.

#include <cstddef>
#include <functional>

#include "milling/direct/crossing.hpp"
#include "milling/direct/lobe_row.hpp"

namespace thinwall::milling {

/// The error of the value on the finest grid from the last two changes, relative. Collocation converges fast, so that
/// the last change is mostly the error of the grid before: as an estimate of the finest grid's it is on the safe side.
/// A change alone may be small by chance, where the error of two neighbours is the same: the one before stands in with
/// a tenth. Where the grids converge slowly, as over the height of a ball, changes fall by a ratio r, and r/(1 − r) of
/// the last one remains. 1e-11 is the round-off of an eigenvalue.
[[nodiscard]] double estimate_from(double change, double change_before);

/// A crossing on the finest grid so far.
struct RefinedCrossing {
  Crossing crossing;
  double change = 1.0;  ///< of its depth by the last grid, relative
  double error_estimate = 1.0;
  std::size_t level = 0;  ///< grids since the one it was found on
  bool kept = true;       ///< it has not been lost on the way
};

/// The outcome of following a crossing to the next grid.
enum class OnFinerGrid { kept, lost, none_finer };

/// Moves a crossing to the grid of a level.
using ToLevel = std::function<OnFinerGrid(std::size_t level, Crossing& crossing)>;

/// The relative error of a crossing on the grid of a level that its distance to other grids does not show.
using Unresolved = std::function<double(std::size_t level, const Crossing& crossing)>;

/// Follows a crossing to finer grids, at least `levels` of them, until the tolerance is met, the crossing is lost or no
/// finer grid is left. One level more than an estimate needs is a second change, without which a small one could be
/// chance.
void refine_until(std::size_t levels, double tolerance, const ToLevel& to_level, const Unresolved& unresolved,
                  RefinedCrossing& crossing);

/// The crossing as it stands in a row.
[[nodiscard]] LobePoint lobe_point(const RefinedCrossing& crossing, double chatter_frequency_hz);

}  // namespace thinwall::milling
