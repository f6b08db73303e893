#pragma once
// The robot of cases/posture-map: its nominal arm, which has other stiffnesses and masses than the robot and no spindle
// bearings, and its truth at postures where it was not tapped (tests/data/milling-robot).

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <complex>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "identification/modal_fit.hpp"
#include "io/results/csv_table.hpp"
#include "tests/core/temporary_folder.hpp"

namespace thinwall::tests::milling_robot {

/// A link of the nominal arm behind its joint, SI.
struct NominalLink {
  const char* name;
  std::array<double, 3> position, axis;
  double mass;
  std::array<double, 3> centre;
  std::array<double, 6> inertia;
  double stiffness, damping;
};

/// A foot that tilts about two axes, and six joints.
inline const std::array<NominalLink, 8> links{{
    {"tilt_x", {0, 0, 0}, {1, 0, 0}, 0, {0, 0, 0}, {}, 25e6, 6000},
    {"tilt_y", {0, 0, 0}, {0, 1, 0}, 0, {0, 0, 0}, {}, 25e6, 6000},
    {"column", {0, 0, 0.3}, {0, 0, 1}, 441, {0.08, 0, 0.3}, {27.3, 25.2, 21}, 2.2e6, 2000},
    {"upper", {0.3, 0, 0.55}, {0, 1, 0}, 239.2, {0.03, 0.05, 0.5}, {29.44, 31.28, 5.98}, 4.2e6, 4000},
    {"elbow", {0, 0, 1.1}, {0, 1, 0}, 231, {0.1, -0.04, 0.16}, {9.9, 14.3, 12.1}, 3.2e6, 3000},
    {"forearm", {0.45, 0, 0.22}, {1, 0, 0}, 67.5, {0.35, 0, 0}, {1.08, 4.68, 4.68}, 185e3, 100},
    {"wrist", {0.8, 0, 0}, {0, 1, 0}, 32, {0.05, 0, 0}, {0.35, 0.45, 0.45}, 3e6, 400},
    {"housing",
     {0.16, 0, 0},
     {1, 0, 0},
     69.66442927,
     {0.2070490171, 0.01059019657, 0.004174255665},
     {1.790932416, 2.080894734, 1.034042511, 0.005200482889, 0.0952660057, -0.01905320114},
     2.3e6,
     250},
}};

/// The arm as tables of a case.
inline std::string arm() {
  std::string text = "[robot.tip]\nposition = [0.26, 0, -0.42]\n";
  for (const NominalLink& link : links) {
    text += fmt::format("[[robot.links]]\nname = \"{}\"\nposition = [{}]\naxis = [{}]\nmass = {}\ncentre = [{}]\n",
                        link.name, fmt::join(link.position, ", "), fmt::join(link.axis, ", "), link.mass,
                        fmt::join(link.centre, ", "));
    text += fmt::format("inertia = [{}]\nstiffness = {}\ndamping = {}\n", fmt::join(link.inertia, ", "), link.stiffness,
                        link.damping);
  }
  return text;
}

/// A posture at which the robot was not tapped, with the truth there.
struct TestPosture {
  std::vector<double> at, joints_rad;
  std::vector<identification::FittedMode> modes;  ///< at the tip along x and y
  std::vector<int> label;                         ///< 0: not one of the eleven of the case
  Eigen::Matrix2d rest;                           ///< static compliance beyond them, m/N
  std::vector<double> depth_mm;                   ///< at `speeds_rpm`; empty beyond the eighth posture
};

inline const std::vector<double> speeds_rpm{3000, 4500, 6000, 7200, 9000, 10800, 14000};

inline std::vector<double> row_of(const io::Table& table, const std::vector<std::string>& columns, std::size_t row) {
  std::vector<double> values;
  for (const std::string& column : columns) values.push_back(io::numbers(table, column, "a file of the robot")[row]);
  return values;
}

inline void read_modes(const std::filesystem::path& file, std::vector<TestPosture>& postures) {
  const io::Table table = io::read_csv(file);
  const std::vector<std::string> columns{"posture", "frequency_hz", "damping_ratio", "label",   "L_1X_re", "L_1X_im",
                                         "L_1Y_re", "L_1Y_im",      "R_1X_re",       "R_1X_im", "R_1Y_re", "R_1Y_im"};
  for (std::size_t i = 0; i < io::numbers(table, "label", file).size(); ++i) {
    const std::vector<double> v = row_of(table, columns, i);
    identification::FittedMode mode;
    mode.frequency_hz = v[1];
    mode.damping_ratio = v[2];
    const auto entry = [&v](std::size_t column) { return std::complex<double>(v[column], v[column + 1]); };
    mode.left = Eigen::Vector2cd(entry(4), entry(6));
    mode.right = Eigen::Vector2cd(entry(8), entry(10));
    mode.residue = mode.right * mode.left.transpose();
    TestPosture& posture = postures[static_cast<std::size_t>(v[0])];
    posture.modes.push_back(std::move(mode));
    posture.label.push_back(static_cast<int>(v[3]));
  }
}

inline std::vector<TestPosture> read_test_postures() {
  const std::filesystem::path folder(THINWALL_SOURCE_DIR "/tests/data/milling-robot");
  const io::Table places = io::read_csv(folder / "postures.csv"), depths = io::read_csv(folder / "depths.csv");
  std::vector<TestPosture> postures(io::numbers(places, "x_mm", "postures.csv").size());
  std::vector<std::string> at_speed;
  for (const double rpm : speeds_rpm) at_speed.push_back(fmt::format("depth_mm_{}", rpm));
  for (std::size_t i = 0; i < postures.size(); ++i) {
    postures[i].at = row_of(places, {"x_mm", "y_mm", "kappa_deg"}, i);
    postures[i].joints_rad = row_of(places, {"q1_rad", "q2_rad", "q3_rad", "q4_rad", "q5_rad", "q6_rad"}, i);
    const std::vector<double> rest = row_of(places, {"rest_xx", "rest_xy", "rest_yx", "rest_yy"}, i);
    postures[i].rest << rest[0], rest[1], rest[2], rest[3];
    if (i < io::numbers(depths, at_speed.front(), "depths.csv").size())
      postures[i].depth_mm = row_of(depths, at_speed, i);
  }
  read_modes(folder / "modes.csv", postures);
  return postures;
}

/// All 64, of which the first eight have depths.
inline const std::vector<TestPosture>& test_postures() {
  static const std::vector<TestPosture> all = read_test_postures();
  return all;
}

/// The keys of the arm as the mean, and how it stands at a posture.
inline std::string mean_at(const TestPosture& there) {
  return "joint_columns = [\"0\", \"0\", \"q1_rad\", \"q2_rad\", \"q3_rad\", \"q4_rad\", \"q5_rad\", \"q6_rad\"]\n" +
         fmt::format("posture.joints = [0, 0, {}]\n", fmt::join(there.joints_rad, ", ")) + arm();
}

/// The case at a posture, learned from the first `count` postures of the design, which fills the workspace.
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
  /// The text of the case; `of_mean`: mean_at(), or nothing for plain processes.
  [[nodiscard]] std::string text(const TestPosture& there, const std::string& of_mean) const {
    return "[robot]\nmodel = \"modal_table\"\ncarries = \"tool\"\npostures = \"postures.csv\"\ntable = \"" + modes +
           "/{posture}.csv\"\nover = [\"x_mm\", \"y_mm\", \"kappa_deg\"]\n" +
           fmt::format("at = [{}]\n", fmt::join(there.at, ", ")) + of_mean +
           "[tool]\nteeth = 2\ndiameter = \"10 mm\"\nlength = \"50 mm\"\n[cutting]\nradial_depth = \"10 mm\"\n"
           "feed_direction = \"x\"\ntool_axis = \"z\"\nKt = \"880 N/mm^2\"\nKr = \"52 N/mm^2\"\n";
  }

  TemporaryFolder folder;
  std::string modes;
};

}  // namespace thinwall::tests::milling_robot
