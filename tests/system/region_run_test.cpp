// A run whose part is a region, which begins at a border, or whose support opens.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "io/results/vtp.hpp"
#include "mesh/faceted_surface.hpp"
#include "tests/system/run_in_folder.hpp"

namespace thinwall::tests::region_run_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A tool that hardly moves: 40 turns of 0.2 mm with 4 mm radial and 1 mm axial depth.
std::string stiff_tool(const std::string& simulation) {
  return R"(
[tool]
teeth = 2
diameter = "10 mm"
length = "20 mm"
[[tool.modes]]
frequency = "5000 Hz"
damping_ratio = 0.05
stiffness = "1e10 N/m"
direction = "x"
[[tool.modes]]
frequency = "5000 Hz"
damping_ratio = 0.05
stiffness = "1e10 N/m"
direction = "y"
[cutting]
radial_depth = "4 mm"
mode = "down"
Kt = "600 N/mm^2"
Kr = "200 N/mm^2"
feed_per_tooth = "0.1 mm"
[simulation]
at = ["6000 rpm, 1 mm"]
)" + simulation;
}

/// From a border the tool takes 40 turns · 0.2 mm · 4 mm out of a block that reaches 1.1 radii beside its path, less
/// the round end of the slot that it stands in: what is left is known to the cusps.
TEST(RegionRun, LeavesThePartAsAClosedSurface) {
  const fs::path folder = scratch("region_run");
  const json point =
      run(stiff_tool("paths = \"region\"\nstart = \"border\"\nturns = 40\n"), folder)["simulation"]["points"][0];
  EXPECT_EQ(point["status"], "completed");
  const io::SurfaceFields part = io::read_vtp(folder / "simulation" / "tool-1-part.vtp");
  constexpr double fed = 40 * 0.2e-3, R = 5e-3, beside = 5.5e-3, depth = 1e-3;
  // The block: from the border at x = R to the end of the window, y from the lower side of the window to −1 mm.
  const double block = (fed + beside - R) * (beside - 1e-3);
  // Swept by the disc of radius R whose centre moves from 0 to the feed: of it y < −1 mm and x > R, where the front is
  // an arc, x = centre + √(R² − y²).
  double swept = 0.0;
  constexpr int strips = 20000;
  for (int i = 0; i < strips; ++i) {
    const double y = -R + (R - 1e-3) * (i + 0.5) / strips;
    swept += (R - 1e-3) / strips * std::max(0.0, fed + std::sqrt(R * R - y * y) - R);
  }
  // The front was cut by the last teeth, up to one feed behind the disc.
  const double left = mesh::volume(part.surface) - depth * (block - swept);
  EXPECT_GT(left, 0.0);
  EXPECT_LT(left, depth * 0.1e-3 * (R - 1e-3));
}

/// Of a cut from a border the approach of the mean deflection is told, and the whole of it is traced.
TEST(RegionRun, TellsHowADeflectionApproachesItsEnd) {
  const fs::path folder = scratch("border_run");
  const json simulation = run(stiff_tool("paths = \"exact\"\nstart = \"border\"\nturns = 60\n"), folder)["simulation"];
  EXPECT_EQ(simulation["settling_turns"], 0);
  const json& point = simulation["points"][0];
  ASSERT_EQ(point["approach"].size(), 2U);
  // The tool hardly moves, so that its deflection is the force over the stiffness, at the end that of the full cut.
  const json steady =
      run(stiff_tool("paths = \"exact\"\nturns = 20\n"), scratch("steady_run"))["simulation"]["points"][0];
  for (const int axis : {0, 1}) {
    const double end = steady["mean_force_n"][static_cast<std::size_t>(axis)].get<double>() / 1e10;
    EXPECT_NEAR(point["approach"][static_cast<std::size_t>(axis)]["final_m"].get<double>(), end, 2e-3 * std::abs(end));
  }
  // The centre passes the border after R/v_f = 0.25 s; the deflection across is within 5 % of its end by then.
  EXPECT_LT(point["approach"][1]["settling_5_s"].get<double>(), 0.25);
  EXPECT_GT(point["approach"][1]["settling_2_s"].get<double>(), 0.05);
}

/// A wall on its foot, cut on one face and backed by a robot on the other.
const std::string supported_wall = R"(
[part]
length = "150 mm"
height = "80 mm"
thickness = "5 mm"
[part.material]
youngs_modulus = "70 GPa"
poisson_ratio = 0.33
density = "2700 kg/m^3"
[part.mesh]
element_size = "20 mm"
[[part.supports]]
on = "z_min"
[points.P]
at = [1.0, 0.4, 0.8]
[points.S]
at = [0.0, 0.4, 0.8]
[reduction]
modes = 8
check_frequencies = 0
[damping]
ratio = 0.02
[robot]
model = "modes"
modes = [{ frequency = "35 Hz", damping_ratio = 0.05, stiffness = "1.5e6 N/m", direction = "x" }]
preload = ["-PRELOAD", "0 N", "0 N"]
[[contacts]]
part = "S"
stiffness = "1e6 N/m"
damping = "50 N s/m"
[tool]
teeth = 3
diameter = "12 mm"
length = "20 mm"
[cutting]
at = "P"
feed_direction = "y"
tool_axis = "z"
radial_depth = "1 mm"
Kt = "700 N/mm^2"
Kr = "250 N/mm^2"
feed_per_tooth = "0.05 mm"
[simulation]
at = ["6000 rpm, 0.5 mm"]
structures = ["supported"]
paths = "exact"
support = "one_sided"
settling_turns = 40
turns = 20
steps_a_turn = 480
)";

/// With a preload that the cut does not use up the motion is that of the joined support; with little it opens.
TEST(RegionRun, OpensTheContactOfASupport) {
  const auto at = [](const std::string& preload, const std::string& name, bool one_sided = true) {
    std::string text = supported_wall;
    text.replace(text.find("PRELOAD"), 7, preload);
    if (!one_sided) text.replace(text.find("one_sided"), 9, "two_sided");
    return run(text, scratch(name))["simulation"]["points"][0];
  };
  const json joined = at("1000 N", "two_sided_run", false);
  const json pressed = at("1000 N", "pressed_run");
  EXPECT_FALSE(joined.contains("opening_contact"));
  EXPECT_EQ(pressed["opening_contact"]["open_share"], 0.0);
  EXPECT_GT(pressed["opening_contact"]["least_n"].get<double>(), 0.0);
  const double range = joined["peak_to_peak_m"][1].get<double>();
  EXPECT_NEAR(pressed["peak_to_peak_m"][1].get<double>(), range, 1e-9 * range);
  const json loose = at("0.1 N", "loose_run");
  EXPECT_GT(loose["opening_contact"]["open_share"].get<double>(), 0.0);
  EXPECT_EQ(loose["opening_contact"]["least_n"], 0.0);
  EXPECT_GT(std::abs(loose["peak_to_peak_m"][1].get<double>() / range - 1.0), 1e-3);
}

}  // namespace
}  // namespace thinwall::tests::region_run_test
