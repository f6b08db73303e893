#pragma once
// The points of a sweep: keys of a case, each with its values.

#include <string>
#include <vector>

namespace thinwall::app {

/// One key of a sweep. A value is the text that --set would take: "4.5 mm". Where all are quantities in one unit,
/// `unit` names it and `numbers` holds them; else both are empty and values are words.
struct SweepAxis {
  std::string key;  ///< in full, "part.thickness"
  std::vector<std::string> values;
  std::string unit;
  std::vector<double> numbers;

  /// The heading that a table writes above the values: "part.thickness [mm]".
  [[nodiscard]] std::string title() const;
  /// The text that a table writes: "4.5"; a word as it is.
  [[nodiscard]] std::string entry(std::size_t value) const;
};

/// "part.thickness=4 mm:8 mm:0.5 mm" (from, to, step; the unit on each, of any scale; `from`'s is kept) or
/// "part.thickness=4 mm, 6 mm" (a list). A value is from + i step, rounded to twelve digits so that 0.1, 0.2, 0.3 come
/// out as they are written; `to` is the last value where it lies on the grid. Throws UsageError: no such key, other
/// dimensions, a step of zero or away from `to`, more than 100 000 values.
[[nodiscard]] SweepAxis sweep_axis(const std::string& text);

/// Axes of a sweep, each key once; throws UsageError.
[[nodiscard]] std::vector<SweepAxis> sweep_axes(const std::vector<std::string>& texts);

/// For each axis which of its values; the last axis goes fastest.
using GridPoint = std::vector<std::size_t>;

/// All points. Throws UsageError for more than 100 000.
[[nodiscard]] std::vector<GridPoint> grid_points(const std::vector<SweepAxis>& axes);

/// "part.thickness=4.5 mm" for each axis.
[[nodiscard]] std::vector<std::string> overrides_at(const std::vector<SweepAxis>& axes, const GridPoint& point);

/// Part i of n of the points, counted from 1: the points whose number, less i, n divides.
struct Shard {
  std::size_t index = 1;
  std::size_t count = 1;
  [[nodiscard]] bool holds(std::size_t number) const { return number % count == index % count; }
};

/// "2/4"; "" is all. Throws UsageError.
[[nodiscard]] Shard shard_of(const std::string& text);

}  // namespace thinwall::app
