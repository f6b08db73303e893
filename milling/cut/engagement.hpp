#pragma once
// The arc in which a tooth cuts.

#include <string>
#include <vector>

#include "milling/cut/tool.hpp"

namespace thinwall::milling {

/// Which way the teeth go through the cut.
enum class MillingDirection {
  up,    ///< conventional: the chip starts at zero thickness; the wall lies on the +y_T side of the tool
  down,  ///< climb: the chip ends at zero thickness; the wall lies on the −y_T side
};

/// A tooth cuts for entry < φ < exit, angles as in ToolFrame (φ = 0 on +y_T, φ = π/2 along the feed).
struct Engagement {
  double entry_rad = 0.0;
  double exit_rad = 0.0;  ///< entry < exit ≤ entry + 2π

  /// Angle in the cut, rad.
  [[nodiscard]] double arc_rad() const { return exit_rad - entry_rad; }
};

/// The arc of a straight wall of radial depth a (m, 0 < a ≤ D):
///
///     up: 0 < φ < acos(1 − 2a/D),    down: acos(2a/D − 1) < φ < π                         (Insperger & Stepan 2004)
///
/// Throws InputError if the radial depth is not positive or exceeds the diameter.
[[nodiscard]] Engagement engagement_of(const Cutter& cutter, double radial_depth_m, MillingDirection direction);

/// Every violation, empty if there is none: finite, entry < exit ≤ entry + 2π.
[[nodiscard]] std::vector<std::string> validate(const Engagement& engagement);

/// Every violation of the arcs of one turn, which must not overlap either.
[[nodiscard]] std::vector<std::string> validate(const std::vector<Engagement>& arcs);

/// A stretch of the tooth period during which the same number of teeth cuts.
struct CutSegment {
  double from_rad = 0.0;  ///< rotation since the last tooth entry
  double to_rad = 0.0;
  int teeth = 0;  ///< ≥ 1
};

/// The cutting part of one tooth period, which begins at a tooth entry. With the pitch p and the arc α = k p + r,
/// 0 ≤ r < p: k + 1 teeth cut for 0 < θ < r and k teeth for r < θ < p; tooth j of a segment stands at
/// φ_j = entry + θ + j p. A stretch without teeth (k = 0) is left out: it is free flight. One or two segments,
/// contiguous, the first from 0; an overlap shorter than 1e-9 of the pitch is taken for none.
[[nodiscard]] std::vector<CutSegment> cut_segments(const Engagement& engagement, const Cutter& cutter);

}  // namespace thinwall::milling
