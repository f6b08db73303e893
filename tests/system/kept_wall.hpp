#pragma once
// A small wall with a robot behind, and its run in a folder.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "app/case_run.hpp"
#include "case/reader.hpp"
#include "report/summary/summary_json.hpp"
#include "tests/replaced.hpp"

namespace thinwall::tests {

/// The case as text: 60 x 50 x 3 mm, cut at P with 72 speeds.
inline std::string kept_wall() {
  return R"([part]
length = "60 mm"
height = "50 mm"
thickness = "3 mm"
[part.axes]
length = "x"
height = "z"
thickness = "y"
[part.material]
youngs_modulus = "71 GPa"
poisson_ratio = 0.33
density = "2810 kg/m^3"
[part.mesh]
element_size = "12 mm"
[[part.supports]]
on = "z_min"
[points.P]
position = ["30 mm", "3 mm", "50 mm"]
patch_radius = "3 mm"
[modes]
count = 4
[damping]
ratio = 0.01
[robot]
model = "one_mode"
frequency = "30 Hz"
damping_ratio = 0.02
stiffness = "2e6 N/m"
direction = "y"
[[contacts]]
part = "P"
robot = "R"
directions = "y"
stiffness = "1e6 N/m"
[tool]
teeth = 4
diameter = "16 mm"
length = "20 mm"
[cutting]
at = "P"
radial_depth = "1 mm"
Kt = "800 MPa"
Kr = "240 MPa"
spindle_speed = "8000 rpm"
[lobes]
from = "6000 rpm"
to = "12000 rpm"
count = 72
modes_up_to = "4 kHz"
tolerance = 0.01
[reduction]
modes = 6
)";
}

/// The summary of a run of the text in a folder, which takes over what an earlier one there has kept unless `fresh`.
inline nlohmann::json run_kept(const std::string& text, const std::filesystem::path& folder, bool fresh = false) {
  return report::summary_json(app::run_case(cases::parse_case(text, folder), {folder, fresh, -1, false}).summary);
}

}  // namespace thinwall::tests
