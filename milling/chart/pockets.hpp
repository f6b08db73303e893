#pragma once
// The pockets of a chart: where between two lobes most can be cut, by the structure and by the machine.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "milling/chart/machine_limits.hpp"
#include "milling/direct/lobe_row.hpp"

namespace thinwall::milling {

/// The limit that keeps a pocket from a higher removal rate.
enum class PocketLimit {
  stability,
  depth_limit,    ///< stable up to there
  power,          ///< of the machine
  torque,         ///< of the machine
  spindle_speed,  ///< its range ends where the rate would still rise
  feed_rate,      ///< beyond this speed the feed per tooth cannot be kept
};

/// The limit's name as in the enumeration.
[[nodiscard]] std::string name(PocketLimit limit);

/// A range of neighbouring speeds of a chart around a local maximum of speed times depth, which at a given feed per
/// tooth and radial depth is the material removal rate.
struct Pocket {
  double spindle_speed_rpm = 0.0;  ///< of the maximum; of a stretch at the depth limit its highest speed
  double depth_m = 0.0;
  bool at_limit = false;  ///< stable up to the depth limit
  PocketLimit limited_by = PocketLimit::stability;
  std::optional<double> removal_rate_m3_s = {};  ///< where the feed is known
  /// Speeds between which nine tenths of this depth can be cut, linear between the rows.
  double from_rpm = 0.0, to_rpm = 0.0;
  bool at_chart_edge = false;  ///< at the first or last speed of the chart, beyond which it may be deeper still
};

/// The best `most` pockets: the deepest first, of two as deep the one of the higher speed; those at an edge of the
/// chart, which may be no pockets, come last. A row that is no answer (answers()) is no pocket, nor does it hide one
/// beside it, and no pocket reaches over it, but for a row whose nodes ran out at an estimate of a tenth at most.
/// `rows` by rising speed. Cost O(rows log rows).
[[nodiscard]] std::vector<Pocket> best_pockets(const std::vector<LobeRow>& rows, std::size_t most);

/// The best pockets within the machine's speeds, with every depth cut to what power and torque allow under `load`,
/// which is none if the feed is not known: then neither they nor the feed rate bound anything. Speeds are those of the
/// rows. Throws InputError for a bad machine.
[[nodiscard]] std::vector<Pocket> best_pockets(const std::vector<LobeRow>& rows, const MachineLimits& machine,
                                               const std::optional<CutLoad>& load, std::size_t most);

}  // namespace thinwall::milling
