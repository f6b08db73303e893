#pragma once
// The median of a list.

#include <algorithm>
#include <limits>
#include <vector>

namespace thinwall::core {

/// The value in the middle, the mean of the two middle ones of an even number; NaN of none. Cost O(n).
[[nodiscard]] inline double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*std::ranges::max_element(values.begin(), middle) + *middle);
}

}  // namespace thinwall::core
