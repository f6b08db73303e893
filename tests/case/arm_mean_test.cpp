// An arm whose joints are calibrated on a few postures, as the mean of what a case learns there: the robot of
// cases/posture-map, whose nominal model has other stiffnesses and masses than the robot, and no spindle bearings.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "case/reader.hpp"
#include "core/error.hpp"
#include "milling/direct/stability.hpp"
#include "setup/identified/identify.hpp"
#include "setup/milling_process.hpp"
#include "setup/robot_tip.hpp"
#include "study/lobes/cut_structure.hpp"
#include "study/postures/posture_study.hpp"
#include "study/support/support_stage.hpp"
#include "tests/core/temporary_folder.hpp"

namespace thinwall::cases::arm_mean_test {
namespace {

/// The nominal arm: a foot that tilts about two axes, and six joints.
const std::string arm = R"([robot.tip]
position = [0.26, 0.0, -0.42]
[[robot.links]]
name = "tilt_x"
position = [0.0, 0.0, 0.0]
axis = [1.0, 0.0, 0.0]
mass = 0.0
centre = [0.0, 0.0, 0.0]
inertia = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
stiffness = 25000000.0
damping = 6000.0
[[robot.links]]
name = "tilt_y"
position = [0.0, 0.0, 0.0]
axis = [0.0, 1.0, 0.0]
mass = 0.0
centre = [0.0, 0.0, 0.0]
inertia = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
stiffness = 25000000.0
damping = 6000.0
[[robot.links]]
name = "column"
position = [0.0, 0.0, 0.3]
axis = [0.0, 0.0, 1.0]
mass = 441.0
centre = [0.08, 0.0, 0.3]
inertia = [27.3, 25.2, 21.0, 0.0, 0.0, 0.0]
stiffness = 2200000.0
damping = 2000.0
[[robot.links]]
name = "upper"
position = [0.3, 0.0, 0.55]
axis = [0.0, 1.0, 0.0]
mass = 239.2
centre = [0.03, 0.05, 0.5]
inertia = [29.44, 31.28, 5.98, 0.0, 0.0, 0.0]
stiffness = 4200000.0
damping = 4000.0
[[robot.links]]
name = "elbow"
position = [0.0, 0.0, 1.1]
axis = [0.0, 1.0, 0.0]
mass = 231.0
centre = [0.1, -0.04, 0.16]
inertia = [9.9, 14.3, 12.1, 0.0, 0.0, 0.0]
stiffness = 3200000.0
damping = 3000.0
[[robot.links]]
name = "forearm"
position = [0.45, 0.0, 0.22]
axis = [1.0, 0.0, 0.0]
mass = 67.5
centre = [0.35, 0.0, 0.0]
inertia = [1.08, 4.68, 4.68, 0.0, 0.0, 0.0]
stiffness = 185000.0
damping = 100.0
[[robot.links]]
name = "wrist"
position = [0.8, 0.0, 0.0]
axis = [0.0, 1.0, 0.0]
mass = 32.0
centre = [0.05, 0.0, 0.0]
inertia = [0.35, 0.45, 0.45, 0.0, 0.0, 0.0]
stiffness = 3000000.0
damping = 400.0
[[robot.links]]
name = "housing"
position = [0.16, 0.0, 0.0]
axis = [1.0, 0.0, 0.0]
mass = 69.66442927
centre = [0.2070490171, 0.01059019657, 0.004174255665]
inertia = [1.790932416, 2.080894734, 1.034042511, 0.005200482889, 0.0952660057, -0.01905320114]
stiffness = 2300000.0
damping = 250.0
)";

const std::string joint_columns =
    "joint_columns = [\"0\", \"0\", \"q1_rad\", \"q2_rad\", \"q3_rad\", \"q4_rad\", \"q5_rad\", \"q6_rad\"]\n";

const std::string cut = R"([tool]
teeth = 2
diameter = "10 mm"
length = "50 mm"
[cutting]
radial_depth = "10 mm"
feed_direction = "x"
tool_axis = "z"
Kt = "880 N/mm^2"
Kr = "52 N/mm^2"
)";

/// A posture at which the robot was not tapped, and the robot's true limiting depths there, computed with the robot
/// itself outside of this program.
struct TestPosture {
  std::array<double, 3> at;
  std::array<double, 6> joints_rad;
  std::array<double, 7> depth_mm;  ///< at `speeds_rpm`
};

constexpr std::array<double, 7> speeds_rpm{3000, 4500, 6000, 7200, 9000, 10800, 14000};

const std::vector<TestPosture> test_postures{
    {{1800, -200, 0},
     {-0.143925449, 0.364986065, 0.794147608, -0.156840161, -1.163643527, 0.062540810},
     {1.07296, 1.84346, 4.1774, 3.37426, 5.06374, 3.93269, 5.57307}},
    {{1800, 200, 60},
     {-0.102613582, 0.489904130, 0.592475342, -1.194260166, -1.377846501, 0.451544894},
     {2.71356, 2.57806, 4.99215, 3.00837, 4.94445, 3.45712, 5.48716}},
    {{1350, 150, -30},
     {0.349985319, 0.138484458, 1.115860448, 0.898531725, -1.369628490, -0.245956375},
     {1.60295, 1.9712, 5.97529, 3.56956, 4.46657, 4.00759, 4.9558}},
    {{1450, -250, 35},
     {-0.417745557, 0.248342970, 0.968491970, -1.056464687, -1.390971475, 0.306550446},
     {1.90941, 2.03814, 4.94801, 3.3462, 5.06928, 3.54121, 5.54036}},
    {{1620, 40, 8},
     {-0.015323853, 0.244558412, 0.973866518, -0.164916621, -1.222826933, 0.056689471},
     {0.873512, 1.53065, 3.05701, 2.99321, 4.85739, 3.38872, 5.35794}},
    {{1560, 260, -50},
     {0.423643664, 0.377757506, 0.774150968, 1.319006129, -1.460321896, -0.404891705},
     {1.82552, 1.97659, 6.30432, 3.72954, 4.32669, 4.73375, 4.91429}},
    {{1800, 200, 0},
     {0.143925449, 0.364986065, 0.794147608, 0.156840161, -1.163643527, -0.062540810},
     {0.995879, 1.7311, 3.89279, 3.37577, 5.06592, 3.93297, 5.57512}},
    {{1720, -60, 25},
     {-0.175500180, 0.343815745, 0.826935076, -0.651009913, -1.246321622, 0.238256819},
     {1.71083, 3.2584, 4.73586, 2.99058, 5.14663, 3.3926, 5.64588}}};

template <std::size_t n>
std::string list_of(const std::array<double, n>& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : ", ") + std::to_string(number);
  return text;
}

/// The case at a posture, learned from the first `count` postures of the design.
class FewPostures {
 public:
  explicit FewPostures(int count) {
    const std::filesystem::path all(THINWALL_SOURCE_DIR "/cases/posture-map");
    std::ifstream list(all / "postures.csv");
    std::ofstream few(folder.path / "postures.csv");
    std::string line;
    for (int i = 0; i < count + 2 && std::getline(list, line); ++i)
      few << line << '\n';  // beside a remark and the header
    modes = (all / "modes").string();
  }
  [[nodiscard]] std::string text(const TestPosture& there, const std::string& of_mean) const {
    return "[robot]\nmodel = \"modal_table\"\ncarries = \"tool\"\npostures = \"postures.csv\"\ntable = \"" + modes +
           "/{posture}.csv\"\nover = [\"x_mm\", \"y_mm\", \"kappa_deg\"]\nat = [" + list_of(there.at) + "]\n" +
           of_mean + cut;
  }
  [[nodiscard]] Case at(const TestPosture& there, const std::string& of_mean) const {
    return parse_case(text(there, of_mean), folder.path);
  }

  tests::TemporaryFolder folder;
  std::string modes;
};

/// The arm as the mean, and how it stands.
std::string mean_at(const TestPosture& there) {
  return joint_columns + "posture.joints = [0, 0, " + list_of(there.joints_rad) + "]\n" + arm;
}

/// Limiting depths at all speeds, m.
std::vector<double> depths_of(Case source) {
  setup::identify(source);
  const study::Component tip = study::robot_component(*source.robot, {Eigen::VectorXd::Ones(1)}, {});
  const auto structure = study::cut_poles(source, nullptr, &study::carrier_modes(tip));
  milling::StabilityOptions options;
  options.depth_limit_m = 0.05;
  options.follow = 1.0;
  std::vector<double> depths;
  for (const double rpm : speeds_rpm)
    depths.push_back(
        milling::limiting_depth(*structure, setup::milling_process(source), rpm, options).limiting_depth_m);
  return depths;
}

/// |w/w_true − 1| at all speeds.
std::vector<double> errors_of(const Case& source, const TestPosture& there) {
  std::vector<double> errors = depths_of(source);
  for (std::size_t i = 0; i < errors.size(); ++i) errors[i] = std::abs(1e3 * errors[i] / there.depth_mm[i] - 1.0);
  return errors;
}

double median_error(const FewPostures& postures) {
  std::vector<double> errors;
  for (const TestPosture& there : test_postures) {
    const auto here = errors_of(postures.at(there, mean_at(there)), there);
    errors.insert(errors.end(), here.begin(), here.end());
  }
  std::ranges::sort(errors);
  return errors[errors.size() / 2];
}

/// With an arm as the mean the median error of the depth is below 7 % from seven postures. All eight test postures are
/// learned for, which takes ten seconds, for a median of fewer would hang on one lobe.
TEST(ArmMean, MakesSevenPosturesDo) {
  EXPECT_LT(median_error(FewPostures(7)), 0.07);
}

/// The answers on learned postures have the arm, too: the depth of all modes at robot.at is that of a chart, which
/// plain processes of seven postures miss. A map needs joints that the columns of robot.over do not tell here.
TEST(ArmMean, IsThatOfTheAnswersOnPostures) {
  const FewPostures postures(7);
  const TestPosture& there = test_postures.front();
  const std::string lobes = "[lobes]\nfrom = \"3000 rpm\"\nto = \"14000 rpm\"\ncount = 2\n";
  const Case source = parse_case(postures.text(there, mean_at(there)) + lobes, postures.folder.path);
  const study::PostureStudy found = study::study_postures(source, study::questions_on({"envelope"}));
  const std::vector<double> depths = depths_of(source), plain = depths_of(postures.at(there, ""));
  ASSERT_TRUE(found.envelope);
  EXPECT_NEAR(found.envelope->together(0), depths.front(), 3e-3 * depths.front());
  EXPECT_NEAR(found.envelope->together(1), depths.back(), 3e-3 * depths.back());
  EXPECT_GT(std::abs(plain.front() - depths.front()), 0.02 * depths.front());
  EXPECT_THROW((void)study::study_postures(source, study::questions_on({"map"})), core::InputError);
}

/// A measured tool has no poles beside the robot's, whether it still awaits a fit or not.
TEST(AnswersOnPostures, RefuseAMeasuredTool) {
  Case source = FewPostures(7).at(test_postures.front(), "");
  source.tool->measured.emplace_back();
  for (const bool fit : {false, true}) {
    source.tool->fit = fit;
    EXPECT_THROW((void)study::study_postures(source, study::questions_on({"envelope"})), core::InputError) << fit;
  }
}

}  // namespace
}  // namespace thinwall::cases::arm_mean_test
