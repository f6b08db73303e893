#pragma once
// An operating point as people write it.

#include <string>

#include "milling/chart/operating_point.hpp"

namespace thinwall::cases {

/// The operating point of a text, "5000 rpm, 0.5 mm". Throws InputError that says what is wrong with it, for texts
/// without one comma, other quantities, and a speed or depth that no machine has.
[[nodiscard]] milling::OperatingPoint operating_point(const std::string& text);

}  // namespace thinwall::cases
