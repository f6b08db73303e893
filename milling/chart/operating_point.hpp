#pragma once
// The distance of an operating point from the boundary of stability, in depth and in speed.

#include <functional>
#include <optional>
#include <vector>

#include "milling/direct/lobe_row.hpp"

namespace thinwall::milling {

/// A cut whose stability is asked for.
struct OperatingPoint {
  double spindle_speed_rpm = 0.0;
  double depth_m = 0.0;
};

/// limiting_depth() of a structure and process, from poles or from samples: all crossings of a speed.
using RowAt = std::function<LobeRow(double spindle_speed_rpm, const StabilityOptions& options)>;

/// The boundary in depth above or below an operating point.
struct DepthMargin {
  double margin_m = 0.0;  ///< up to the next loss of stability; of an unstable point, negative, down to the nearest
                          ///< stable depth
  bool at_limit = false;  ///< no loss of stability as deep as is known (the depth limit, or less where a row lost its
                          ///< crossings: the margin is negative then): the margin is at least this
  LobePoint boundary;     ///< the crossing; of no meaning at the limit
};

/// The boundary in speed at the point's depth.
struct SpeedMargin {
  std::optional<double> below_rpm;  ///< the nearest speed below at which stability changes; none within the chart
  std::optional<double> above_rpm;
};

/// True if a cut of this depth is stable by the crossings of a row: multipliers that have left the circle below it have
/// all returned. Beyond what was searched an unstable cut is taken to stay so.
[[nodiscard]] bool stable_at(const LobeRow& row, double depth_m);

/// `row` must have been searched to the depth, see row_to().
[[nodiscard]] DepthMargin depth_margin(const LobeRow& row, double depth_m);

/// The row of a speed with all crossings up to a depth at least. Throws InputError unless speed and depth are positive
/// and the depth is within the depth limit. Cost: one row, or two.
[[nodiscard]] LobeRow row_to(const RowAt& row_at, const OperatingPoint& point, const StabilityOptions& options);

/// The boundary at fixed depth: the neighbouring speeds of the chart that differ from the point, then the root between
/// them (to 1e-6 of the speed) of the logarithmic distance to the nearest crossing that bounds a stable range, positive
/// where stable, by linalg::bracketed_root(). A change of stability that lies
/// between two speeds of the chart as a whole is not seen. `chart` by rising speed. Cost: some eight rows a side.
[[nodiscard]] SpeedMargin speed_margin(const RowAt& row_at, const std::vector<LobeRow>& chart,
                                       const OperatingPoint& point, const StabilityOptions& options);

}  // namespace thinwall::milling
