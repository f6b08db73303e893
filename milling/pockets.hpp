#pragma once
// The pockets of a chart: where between two lobes most can be cut.

#include <cstddef>
#include <vector>

#include "milling/lobe_row.hpp"

namespace thinwall::milling {

/// A range of neighbouring speeds of a chart around a local maximum of speed times limiting depth, which at a given
/// feed per tooth and radial depth is the material removal rate.
struct Pocket {
  double spindle_speed_rpm = 0.0;  ///< of the maximum; of a stretch at the depth limit its highest speed
  double depth_m = 0.0;
  bool at_limit = false;  ///< stable up to the depth limit
};

/// The best `most` pockets, highest speed times depth first. `rows` by rising speed. Cost O(rows log rows).
[[nodiscard]] std::vector<Pocket> best_pockets(const std::vector<LobeRow>& rows, std::size_t most);

}  // namespace thinwall::milling
