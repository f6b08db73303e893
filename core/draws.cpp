#include "core/draws.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace thinwall::core {

double normal_draw(std::mt19937& random) {
  const auto uniform = [&] {
    return (static_cast<double>(random()) + 0.5) / (static_cast<double>(std::mt19937::max()) + 1.0);
  };
  const double radius = std::sqrt(-2.0 * std::log(uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

std::pair<double, double> middle_95_percent(std::vector<double> values) {
  std::ranges::sort(values);
  const double number = std::max(1.0, 0.025 * static_cast<double>(values.size() + 1)) - 1.0;
  const auto below = static_cast<std::size_t>(number);
  const double share = number - static_cast<double>(below);
  const auto between = [share](double a, double b) { return share == 0.0 || a == b ? a : a + share * (b - a); };
  const std::size_t last = values.size() - 1, next = std::min(below + 1, last);
  return {between(values[below], values[next]), between(values[last - below], values[last - next])};
}

}  // namespace thinwall::core
