#pragma once
// The benchmark oscillator of tests/milling as a case: 922 Hz along feed and normal, an end mill of two teeth.

#include <string>

namespace thinwall::tests {

/// [tool] and [cutting], with the feed.
inline const std::string benchmark_tool = R"(
[tool]
teeth = 2
diameter = "10 mm"
length = "20 mm"
[[tool.modes]]
frequency = "922 Hz"
damping_ratio = 0.011
stiffness = "1340049.6480507487 N/m"
direction = "x"
[[tool.modes]]
frequency = "922 Hz"
damping_ratio = 0.011
stiffness = "1340049.6480507487 N/m"
direction = "y"
[cutting]
radial_depth = "0.5 mm"
mode = "down"
Kt = "600 N/mm^2"
Kr = "200 N/mm^2"
feed_per_tooth = "0.1 mm"
)";

}  // namespace thinwall::tests
