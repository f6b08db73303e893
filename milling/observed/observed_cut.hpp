#pragma once
// Cuts that were made, and what was seen of them.

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "core/words.hpp"

namespace thinwall::milling {

/// The outcome of a cut: no chatter, chatter, or neither clearly.
enum class CutOutcome { stable, chatter, marginal };

/// A cut that was made.
struct ObservedCut {
  double spindle_speed_rpm = 0.0;
  double depth_m = 0.0;
  CutOutcome outcome = CutOutcome::stable;
  std::optional<double> chatter_frequency_hz = {};  ///< that was heard; none: not told
};

}  // namespace thinwall::milling

namespace thinwall::core {

template <>
inline constexpr std::array<std::string_view, 3> words<milling::CutOutcome>{"stable", "chatter", "marginal"};

}  // namespace thinwall::core
