// What `thinwall init` writes runs as it is, and its files are what its comments say.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "case/templates.hpp"
#include "core/atomic_file.hpp"
#include "dynamics/response_model.hpp"
#include "io/frf/response_csv.hpp"
#include "io/results/vtp.hpp"
#include "report/summary/summary_json.hpp"
#include "tests/core/temporary_folder.hpp"
#include "tests/system/run_in_folder.hpp"

namespace thinwall::tests::template_test {

using namespace app;
using namespace cases;

namespace {

namespace fs = std::filesystem;

/// The summary of a template, run as it was written.
nlohmann::json summary_of_template(const std::string& name) {
  const fs::path folder = scratch("template_" + name);
  const Case source = read_case(write_template(name, folder / "case"));
  nlohmann::json summary = summary_json(run_case(source, {folder, true, -1, false}).summary);
  EXPECT_EQ(summary["status"], "ok");
  expect_as_published(folder / "summary.json");
  for (const auto& chart : summary["lobes"]) EXPECT_EQ(chart["speeds_not_converged"], 0) << name;
  return summary;
}

/// Stable depth at the case's speed, in m, of the chart `name`.
double depth_at_speed(const nlohmann::json& summary, const std::string& name) {
  for (const auto& chart : summary["lobes"]) {
    if (chart["name"] == name) return chart["at_case_speed"]["limiting_depth_m"];
  }
  ADD_FAILURE() << "no chart " << name;
  return 0.0;
}

TEST(Template, ThePlateIsHeldByItsRobot) {
  const auto summary = summary_of_template("plate");
  EXPECT_GT(depth_at_speed(summary, "supported"), depth_at_speed(summary, "part"));
}

TEST(Template, TheWallIsACantilever) {
  const auto summary = summary_of_template("wall");
  // A clamped plate of this aspect (h/l = 0.5) lies near the strip of unit width in plane strain: 1.875^2 / (2 pi h^2)
  // * sqrt(E t^2 / (12 rho (1 - nu^2))) with h = 60 mm, t = 2 mm.
  const double strip = 1.8751 * 1.8751 / (2.0 * M_PI * 0.06 * 0.06) *
                       std::sqrt(70e9 * 0.002 * 0.002 / (12.0 * 2810.0 * (1.0 - 0.33 * 0.33)));
  EXPECT_NEAR(summary["part"]["modes"][0]["frequency_hz"].get<double>() / strip, 1.0, 0.05);
}

/// Of the points between which the line of a chart passes a stable operating point, none may lie below it: verdict and
/// line say the same. 200 even speeds drew it at 0.64 mm where 1.17 mm are stable.
TEST(Template, TheWallsChartIsDrawnAboveAPointThatIsStable) {
  const fs::path folder = scratch("template_wall_point");
  const Case source = read_case(write_template("wall", folder / "case"));
  const double rpm = 6739.0, beside_rpm = 6725.0, depth = 1e-3;
  const nlohmann::json summary =
      summary_json(run_case(source, {folder, true, -1, false, {{rpm, depth}, {beside_rpm, depth}}}).summary);
  for (const auto& point : summary["operating_points"]) EXPECT_EQ(point["stable"], true);
  const auto& line = summary["lobes"][0]["line"];
  EXPECT_EQ(line["met"], true);
  EXPECT_LE(line["error_estimate_relative"].get<double>(), 0.02);
  EXPECT_LE(line["speeds_added"], 400);
  const auto speeds = column(folder / "lobes" / "part.csv", "spindle_speed_rpm");
  const auto limits = column(folder / "lobes" / "part.csv", "limiting_depth_m");
  EXPECT_EQ(std::ranges::count(speeds, rpm), 1);
  EXPECT_EQ(std::ranges::count(speeds, 9000.0), 1) << "the case's own";
  const auto at = static_cast<std::size_t>(std::ranges::find(speeds, rpm) - speeds.begin());
  EXPECT_GT(limits[at - 1], depth);
  EXPECT_NEAR(limits[at], 1.19e-3, 0.01e-3);
  EXPECT_GT(limits[at + 1], depth);
}

TEST(Template, TheBracketIsAsLargeAsItsOutlineSays) {
  const auto summary = summary_of_template("stl-part");
  // (30 * 6 + 3 * 44) mm^2 * 80 mm of 2810 kg/m^3; the file holds whole millimetres.
  EXPECT_NEAR(summary["part"]["mass_kg"].get<double>(), 312e-6 * 0.08 * 2810.0, 1e-9);
  EXPECT_EQ(summary["part"]["rigid_body_modes"], 0);
  ASSERT_EQ(summary["lobes"].size(), 1U);
  EXPECT_TRUE(summary["lobes"][0]["line"]["met"].get<bool>()) << "the first picture is within its tolerance";
}

/// The contact holds x only, and the arm's first mode turns it about z: the plate does not take part.
void expect_plate_at_rest_in_the_first_mode(const fs::path& modes) {
  const auto shapes = io::read_vtp(modes / "coupled_surface.vtp");
  EXPECT_EQ(shapes.vectors.front().values.cwiseAbs().maxCoeff(), 0.0);
  const auto likeness = column(modes / "mac.csv", "coupled_mode_1");
  EXPECT_EQ(*std::ranges::max_element(likeness), 0.0);
  Eigen::MatrixX3d robot(std::ssize(shapes.vectors), 3);
  for (int axis = 0; axis < 3; ++axis)
    robot.col(axis) = Eigen::VectorXd::Map(
        column(modes / "coupled_modes.csv", std::string("robot_") + "xyz"[axis]).data(), robot.rows());
  for (Eigen::Index k = 0; k < robot.rows(); ++k) {
    const double part = shapes.vectors[static_cast<std::size_t>(k)].values.cwiseAbs().maxCoeff();
    EXPECT_NEAR(std::max(part, robot.row(k).cwiseAbs().maxCoeff()), 1.0, 1e-6) << "mode " << k + 1;
  }
}

TEST(Template, TheArmReachesThePlateAndHoldsIt) {
  const auto summary = summary_of_template("robot");
  EXPECT_EQ(summary["robot"]["model"], "flexible_joints");
  for (const auto& chart : summary["lobes"]) EXPECT_TRUE(chart["line"]["met"].get<bool>()) << chart["name"];
  EXPECT_GT(depth_at_speed(summary, "supported"), 0.0);
  EXPECT_LT(summary["coupling"]["route_difference"]["max_relative"].get<double>(), 1e-9);
  expect_plate_at_rest_in_the_first_mode(tests::temporary_files() / "template_robot" / "modes");
}

TEST(Template, MeasuredFilesAreJoinedAsTwoSpringsInSeriesWouldBe) {
  const fs::path folder = tests::temporary_files() / "template_frf-only";
  (void)summary_of_template("frf-only");
  // At a rigid contact along one direction 1/G = 1/H + 1/R; H and R are the modes that the files name.
  const auto G = dynamics::entry(io::read_response(folder / "frf" / "coupled_receptance.csv"), "P.x", "P.x");
  const auto mode = [](double hz, double f, double zeta, double k) {
    return 1.0 / (k * std::complex(1.0 - hz * hz / (f * f), 2.0 * zeta * hz / f));
  };
  ASSERT_EQ(G.size(), 991);
  for (const int hz : {10, 205, 700}) {
    const auto H = mode(hz, 205.0, 0.01, 1.3e6) + mode(hz, 545.0, 0.01, 4.2e6);
    const auto R = mode(hz, 29.0, 0.02, 1.7e6);
    EXPECT_LT(std::abs(G(hz - 10) * (1.0 / H + 1.0 / R) - 1.0), 1e-6) << hz;
  }
}

TEST(Template, TheToolsLobesComeFromItsFiles) {
  const auto summary = summary_of_template("lobes");
  ASSERT_EQ(summary["lobes"].size(), 1U);
  EXPECT_EQ(summary["lobes"][0]["name"], "tool");
  EXPECT_GT(depth_at_speed(summary, "tool"), 1e-4);
}

TEST(Template, NoFileIsOverwritten) {
  const fs::path folder = scratch("template_kept");
  core::write_file_atomically(folder / "tip_yy.csv", "mine");
  EXPECT_THROW((void)write_template("lobes", folder), core::DataError);
  EXPECT_EQ(core::read_file(folder / "tip_yy.csv"), "mine");
  EXPECT_FALSE(fs::exists(folder / "case.toml"));
  EXPECT_FALSE(fs::exists(folder / "tip_xx.csv"));
}

}  // namespace
}  // namespace thinwall::tests::template_test
