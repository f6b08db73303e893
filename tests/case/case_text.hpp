#pragma once
// A small case that is right, for tests to make wrong.

#include <string>

namespace thinwall::tests {

inline std::string plate_case() {
  return R"(title = "plate"
[part]
length = "392 mm"
height = "100 mm"
thickness = "6 mm"
[part.material]
youngs_modulus = "210 GPa"
poisson_ratio = 0.3
density = "7850 kg/m^3"
[part.mesh]
element_size = "12 mm"
[[part.supports]]
on = "y_min"
[[part.supports]]
on = "y_max"
fixed = ["x", "y", "z"]
[points.P]
at = [1.0, 0.5, 0.95]
[points.P2]
at = [1.0, 0.5, 0.95]
offset = ["0 mm", "20 mm", "0 mm"]
[damping]
ratio = 0.01
ratios = [0.008, "0.6 %"]
[robot]
frequency = "29 Hz"
stiffness = "1.7e6 N/m"
damping_ratio = 0.02
[[contacts]]
part = "P"
[[updating]]
parameters = [{ key = "part.length", lower = "380 mm", upper = "410 mm" }]
name = "free length"
[[updating.targets]]
quantity = "part_frequency"
value = "212 Hz"
point = "P.x"
[tool]
teeth = 6
diameter = "16 mm"
length = "20 mm"
[cutting]
at = "P"
radial_depth = "0.2 mm"
Kt = "1800 N/mm^2"
spindle_speed = "1900 rpm"
feed_rate = "1800 mm/min"
[lobes]
from = "1000 rpm"
to = "3000 rpm"
)";
}

/// A cutter of one mode, whose chart of three speeds takes some hundredths of a second.
inline std::string cutter_case() {
  return R"(title = "Cutter"
[tool]
teeth = 2
diameter = "10 mm"
length = "10 mm"
[[tool.modes]]
frequency = "922 Hz"
damping_ratio = 0.011
stiffness = "1.34e6 N/m"
direction = "x"
[cutting]
radial_depth = "1 mm"
feed_direction = "x"
tool_axis = "z"
Kt = "600 N/mm^2"
Kr = "200 N/mm^2"
spindle_speed = "5000 rpm"
[lobes]
from = "5000 rpm"
to = "6000 rpm"
count = 3
)";
}

/// `text` with the first `from` replaced by `to`.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const auto place = text.find(from);
  return place == std::string::npos ? "" : text.replace(place, from.size(), to);
}

}  // namespace thinwall::tests
