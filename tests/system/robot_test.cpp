// Robots in a case: an arm in a posture and along a path, a measured tip beside the model that it was measured on.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "core/atomic_file.hpp"
#include "tests/app/command_call.hpp"
#include "tests/system/run_in_folder.hpp"

namespace thinwall::tests::robot_test {

using namespace setup;
using namespace cases;
using namespace app;

namespace {

namespace fs = std::filesystem;

/// The four-axis arm of Huynh et al. 2017, tables 1 and 2.
const std::string huynh_arm = R"([robot]
model = "flexible_joints"
[[robot.links]]
mass = "342 kg"
centre = [0, 0, 0.325]
inertia = [18.044, 29.213, 30.014]
stiffness = "3.8e6 N m/rad"
damping = "1057.2 N m s/rad"
[[robot.links]]
position = [0, 0, "650 mm"]
axis = "y"
mass = "243 kg"
centre = [0, 0, 0.475]
inertia = [35.033, 37.463, 4.050]
stiffness = "6.6e6 N m/rad"
damping = "1393.3 N m s/rad"
[[robot.links]]
position = [0, 0, "950 mm"]
axis = "y"
mass = "202 kg"
centre = [0, 0, 0.425]
inertia = [5.507, 5.507, 4.547]
stiffness = "3.9e6 N m/rad"
damping = "1071.0 N m s/rad"
[[robot.links]]
position = [0, 0, "850 mm"]
axis = "y"
mass = "11 kg"
centre = [0, 0, 0.1]
inertia = [0.103, 0.103, 0.041]
stiffness = "0.66e6 N m/rad"
damping = "440.6 N m s/rad"
[robot.tip]
position = [0, 0, "200 mm"]
)";

const std::string reference_posture = "[robot.posture]\njoints = [0, 0.2, 1.2, 1.7415926535897931]\n";

// Two independent computations that agree to 1e-14 (tests/robot/flexible_joints_test.cpp); seven and six digits given.
TEST(Robot, AnArmAloneIsACaseAndHasTheReferencesModesAndStiffness) {
  const fs::path out = scratch("arm_alone");
  core::write_file_atomically(out / "case.toml", huynh_arm + reference_posture);
  const Outcome outcome = call({"robot", out / "case.toml", "--out", out / "results"}, run_case);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const fs::path table = out / "results" / "robot" / "postures.csv";
  const double hz[] = {19.703627, 27.303195, 56.800864, 283.103294};
  const double ratio[] = {0.0134127, 0.0238637, 0.0480681, 0.5935355};
  const double compliance[] = {1.775981e-7, 2.772188e-7, 3.396096e-7};
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR(column(table, "frequency_" + std::to_string(k + 1) + "_hz")[0] / hz[k], 1.0, 1e-7);
    EXPECT_NEAR(column(table, "damping_ratio_" + std::to_string(k + 1))[0] / ratio[k], 1.0, 4e-6);
  }
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(column(table, std::string("stiffness_") + "xyz"[i] + "_n_per_m")[0] * compliance[i], 1.0, 5e-7);
  EXPECT_TRUE(fs::exists(out / "results" / "robot" / "postures.vtu"));
  EXPECT_NE(outcome.out.find("19.70"), std::string::npos) << outcome.out;
  const auto summary = run(huynh_arm + reference_posture, out / "run");
  EXPECT_NEAR(summary["robot"]["static_stiffness_n_per_m"][2].get<double>() * compliance[2], 1.0, 5e-7);
  EXPECT_TRUE(fs::exists(out / "run" / "frf" / "robot.csv"));
}

/// A wall of 80 × 40 × 2 mm with a robot behind its edge, and what cuts it.
std::string wall(double y_mm, const std::string& robot, const std::string& more) {
  const auto at = [y_mm](const char* x, const char* z) {
    return std::string("position = [\"") + x + "\", \"" + std::to_string(y_mm) + " mm\", \"" + z + "\"]\n";
  };
  return R"([part]
length = "80 mm"
height = "40 mm"
thickness = "2 mm"
[part.material]
youngs_modulus = "70 GPa"
poisson_ratio = 0.33
density = "2810 kg/m^3"
[part.mesh]
element_size = "20 mm"
[[part.supports]]
on = "z_min"
[points.P]
)" + at("2 mm", "40 mm") +
         "patch_radius = \"2 mm\"\n[points.B]\n" + at("0 mm", "30 mm") + R"(patch_radius = "2 mm"
[reduction]
modes = 60
check_frequencies = 0
[damping]
ratio = 0.02
[[contacts]]
part = "B"
stiffness = "5e5 N/m"
damping = "5 N s/m"
[tool]
teeth = 3
diameter = "10 mm"
length = "20 mm"
[cutting]
at = "P"
radial_depth = "0.5 mm"
Kt = "600 N/mm^2"
Kr = "180 N/mm^2"
)" + robot +
         more;
}

const std::string rows = "[lobes]\nfrom = \"9000 rpm\"\nto = \"14000 rpm\"\ncount = 2\nmost_added = 0\n";

/// The arm in front of the wall's back, its tip where the contact is.
const std::string arm_behind_the_wall = huynh_arm + "[robot.base]\nposition = [\"-1.2 m\", \"40 mm\", \"-1.1 m\"]\n";

// At each position of the path the arm stands otherwise; a single case there, with the joints given, has the same arm.
TEST(Robot, AlongAPathTheArmIsThatOfSingleCasesWithTheSameJoints) {
  const fs::path out = scratch("arm_path"), single = scratch("arm_single");
  const std::string path =
      "[path]\nfrom = [\"2 mm\", \"8 mm\", \"40 mm\"]\nto = [\"2 mm\", \"64 mm\", \"40 mm\"]\npositions = 2\n"
      "support = \"follows\"\n";
  const auto by_pitch = arm_behind_the_wall + "[robot.posture]\npitch = \"90 deg\"\n";
  const auto summary = run(wall(40.0, by_pitch, "[response]\nlines = 10\n" + rows + path), out);
  const auto& there = summary["path"][1]["positions"][0]["robot"];
  EXPECT_NEAR(there["tip_m"][1].get<double>(), 8e-3, 1e-12) << "the tip is at the contact";
  EXPECT_NE(there["joints_rad"], summary["path"][1]["positions"][1]["robot"]["joints_rad"]);
  const auto by_joints = arm_behind_the_wall + "[robot.posture]\njoints = " + there["joints_rad"].dump() + "\n";
  (void)run(wall(8.0, by_joints, "[response]\nlines = 10\n" + rows), single);
  const auto found = column(out / "lobes" / "supported_path.csv", "limiting_depth_m");
  const auto expected = column(single / "lobes" / "supported.csv", "limiting_depth_m");
  double worst = 0.0;
  for (std::size_t i = 0; i < expected.size(); ++i) worst = std::max(worst, std::abs(found[i] / expected[i] - 1.0));
  std::printf("arm along a path against a single case: %.1e of the depth\n", worst);
  EXPECT_LT(worst, 2e-3) << "the single case's reduction: tests/system/path_test.cpp";
}

// The robot's own receptance, written by one run and read as a measurement by the next. The chart then comes from
// samples, 2 Hz apart where the narrowest half width is 20 Hz, up to 24 kHz: a mode beyond the lines is not known to a
// measurement, and the wall's at 9.5 kHz moves a depth by 16 %.
TEST(Robot, AMeasuredTipGivesTheChartOfTheModelItWasMeasuredOn) {
  const fs::path out = scratch("measured_tip"), measured = scratch("measured_tip_again");
  const std::string lines = "[response]\nfrom = \"1 Hz\"\nto = \"24 kHz\"\nlines = 12000\n";
  const std::string one_mode = "[robot]\nfrequency = \"150 Hz\"\nstiffness = \"1e6 N/m\"\ndamping_ratio = 0.2\n";
  const auto few_modes = [](std::string text) { return text.replace(text.find("modes = 60"), 10, "modes = 20"); };
  (void)run(few_modes(wall(40.0, one_mode, lines + rows)), out);
  fs::copy(out / "frf" / "robot.csv", measured / "robot.csv");
  const std::string by_file =
      "[robot]\nmodel = \"measured\"\n[[robot.measured]]\nresponse = \"R.x\"\nforce = \"R.x\"\nfile = \"robot.csv\"\n"
      "quantity = \"receptance\"\nunit = \"m/N\"\n";
  const auto summary = run(few_modes(wall(40.0, by_file, lines + rows)), measured);
  ASSERT_EQ(summary["lobes"].size(), 2U) << "part and supported";
  const auto expected = column(out / "lobes" / "supported.csv", "limiting_depth_m");
  const auto found = column(measured / "lobes" / "supported.csv", "limiting_depth_m");
  double worst = 0.0;
  for (std::size_t i = 0; i < expected.size(); ++i) worst = std::max(worst, std::abs(found[i] / expected[i] - 1.0));
  std::printf("chart from a measured robot against its model: %.1e of the depth\n", worst);
  EXPECT_LT(worst, 5e-3);
}

}  // namespace
}  // namespace thinwall::tests::robot_test
