#pragma once
// The structures of which a run makes stability charts, and their words in files.

#include <array>
#include <string_view>

#include "core/words.hpp"

namespace thinwall::study {

/// The structure that a chart is of.
enum class ChartOf {
  part,       ///< the part alone
  supported,  ///< the part with the robot that supports it
  tool,       ///< a tool that cuts a rigid part
  carried     ///< a tool on a robot that carries it, which cuts the part, or a rigid one
};

}  // namespace thinwall::study

namespace thinwall::core {

template <>
inline constexpr std::array<std::string_view, 4> words<study::ChartOf>{"part", "supported", "tool", "carried"};

}  // namespace thinwall::core
