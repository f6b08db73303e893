#pragma once
// Results of a search for crossings at one speed, before they become a row.

#include <vector>

#include "milling/direct/lobe_row.hpp"

namespace thinwall::milling {

/// The crossings of a row, and how far they were looked for.
struct FoundCrossings {
  std::vector<LobePoint> points;  ///< ascending
  double searched_m = 0.0;        ///< the depth up to which crossings were looked for
  int nodes = 0;                  ///< what the method counts: steps a period, or harmonics
};

}  // namespace thinwall::milling
