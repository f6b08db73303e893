#pragma once
// Draws of random numbers that are the same on every machine, and the range in which most of some drawn values lie.

#include <random>
#include <utility>
#include <vector>

namespace thinwall::core {

/// A number of the standard normal distribution by the rule of Box and Muller (1958). The distributions of the standard
/// library draw differently from one implementation to another.
[[nodiscard]] double normal_draw(std::mt19937& random);

/// The range that leaves out as many of the least values as of the largest, 2.5 % of them each: with n values in
/// ascending order, those of number k = 0.025 (n + 1) from either end, which lie apart by 95 % of the distribution on
/// average (David & Nagaraja 2003, ch. 2.5), linear between two of them. Below 39 values it is that of all. `values`
/// are not empty and may be infinite. Cost O(n log n).
[[nodiscard]] std::pair<double, double> middle_95_percent(std::vector<double> values);

}  // namespace thinwall::core
