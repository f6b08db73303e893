// Files of `thinwall lobes` beside the chart: forces, surface and fits, and what the summary says of them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "io/results/csv_table.hpp"
#include "tests/app/lobes_command.hpp"
#include "tests/case/case_text.hpp"

namespace thinwall::tests::lobes_files_test {
namespace {

class LobesFiles : public LobesCommand {};

TEST_F(LobesFiles, AStablePointWithAFeedSaysWhatTheTeethForce) {
  // Down-milling with K_t and K_r alone: the force is largest at the entry, w f sin φ √(K_t² + K_r²), torque alike.
  write("tool.toml", with(tool_toml, "[cutting]", "[cutting]\nfeed_per_tooth = \"0.1 mm\""));
  const std::vector<std::string> at{"--at", "14000 rpm, 0.5 mm", "--at", "12000 rpm, 5 mm", "--set", "lobes.count=8"};
  std::vector<std::string> words{path("modes.csv"), "--tool", path("tool.toml")};
  words.insert(words.end(), at.begin(), at.end());
  const Outcome outcome = lobes(words);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto points = summary()["operating_points"];
  const auto forced = points[0]["forced_vibration"];
  const double entry = std::sin(std::acos(2.0 * 0.1 - 1.0));
  EXPECT_NEAR(forced["peak_force_n"].get<double>(), 0.5e-3 * 0.1e-3 * entry * std::hypot(6e8, 2e8), 1e-5);
  EXPECT_NEAR(forced["peak_torque_n_m"].get<double>(), 0.5e-3 * 0.1e-3 * entry * 6e8 * 0.005, 1e-7);
  EXPECT_EQ(forced["surface_location_error_m"], 0.0);  // the structure moves along the feed alone
  EXPECT_GT(forced["peak_to_peak_m"][0].get<double>(), 1e-6);
  EXPECT_LE(forced["error_estimate_relative"].get<double>(), 1e-4);
  EXPECT_EQ(forced["status"], "converged");
  EXPECT_GT(forced["mean_power_w"].get<double>(), 0.0);
  EXPECT_TRUE(points[1]["forced_vibration"].is_null());  // unstable
  const auto file = temporary.path / "results" / "lobes" / "tool_forces.csv";
  const io::Table forces = io::read_csv(file);
  const auto number = io::numbers(forces, "point", file), rotation = io::numbers(forces, "rotation_rad", file);
  EXPECT_TRUE(std::ranges::all_of(number, [](double n) { return n == 1.0; })) << "the second chatters";
  EXPECT_NEAR(rotation.back() - rotation.front(), std::numbers::pi, 1e-9) << "a period of two teeth";
  double peak = 0.0;
  const auto along = io::numbers(forces, "force_feed_n", file), across = io::numbers(forces, "force_normal_n", file);
  for (std::size_t i = 0; i < along.size(); ++i) peak = std::max(peak, std::hypot(along[i], across[i]));
  EXPECT_NEAR(peak, forced["peak_force_n"].get<double>(), 1e-3 * peak);
  EXPECT_NE(outcome.out.find("forced: surface 0 um, peak force "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("N, torque 0."), std::string::npos) << outcome.out;
}

TEST_F(LobesFiles, SurfaceAndForceAreGivenOverTheSpeedsAtTheDepthOfThePoint) {
  // A mode across the wall, so that the surface moves; at 12000 rpm 5 mm chatter, at others not.
  write("modes.csv", "frequency_hz,damping_ratio,mass,direction\n922,0.011,0.03993,y\n");
  write("tool.toml", with(tool_toml, "[cutting]", "[cutting]\nfeed_per_tooth = \"0.1 mm\""));
  const Outcome outcome =
      lobes({path("modes.csv"), "--tool", path("tool.toml"), "--at", "14000 rpm, 1 mm", "--set", "lobes.count=30"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto curve = summary()["lobes"][0]["forced_over_speed"][0];
  EXPECT_EQ(curve["depth_m"], 1e-3);
  EXPECT_EQ(curve["feed_per_tooth_m"], 1e-4);
  EXPECT_EQ(curve["speeds"], summary()["lobes"][0]["speeds"]);
  EXPECT_FALSE(curve.contains("preload_n")) << "a tool has no contact";
  const auto file = temporary.path / "results" / "lobes" / "tool_forced.csv";
  const io::Table table = io::read_csv(file);
  const auto rpm = io::numbers(table, "spindle_speed_rpm", file);
  const auto limit = io::numbers(io::read_csv(file.parent_path() / "tool.csv"), "limiting_depth_m", file);
  const auto surface = io::numbers_or_gaps(table, "surface_location_error_m", file);
  const auto force = io::numbers_or_gaps(table, "peak_force_n", file);
  ASSERT_EQ(rpm.size(), limit.size());
  const double entry = 1e-3 * 1e-4 * std::sin(std::acos(2.0 * 0.1 - 1.0)) * std::hypot(6e8, 2e8);
  long stable = 0;
  double largest = 0.0;
  for (std::size_t i = 0; i < rpm.size(); ++i) {
    EXPECT_EQ(std::isnan(force[i]), limit[i] <= 1e-3) << rpm[i];
    EXPECT_EQ(std::isnan(surface[i]), std::isnan(force[i])) << rpm[i];
    if (std::isnan(force[i])) continue;
    ++stable;
    EXPECT_NEAR(force[i], entry, 1e-4 * entry) << rpm[i];
    if (std::abs(surface[i]) > std::abs(largest)) largest = surface[i];
    if (rpm[i] != 14000.0) continue;
    EXPECT_NEAR(surface[i],
                summary()["operating_points"][0]["forced_vibration"]["surface_location_error_m"].get<double>(), 1e-9);
  }
  EXPECT_EQ(curve["speeds_stable"], stable);
  EXPECT_GT(stable, 0);
  EXPECT_LT(stable, std::ssize(rpm)) << "some must chatter for this to be a test";
  EXPECT_EQ(curve["largest_surface_error_m"], largest);
  EXPECT_NEAR(curve["peak_force_n"].get<double>(), entry, 1e-4 * entry);
}

TEST_F(LobesFiles, APointWithoutAFeedSaysNothingOfForces) {
  const Outcome outcome =
      lobes({path("modes.csv"), "--tool", path("tool.toml"), "--at", "14000 rpm, 0.5 mm", "--set", "lobes.count=2"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(summary()["operating_points"][0]["forced_vibration"].is_null());
  EXPECT_FALSE(summary()["lobes"][0].contains("forced_over_speed"));
  EXPECT_EQ(outcome.out.find("forced"), std::string::npos) << outcome.out;
}

/// A file of zeros is taken as a tool that is rigid along its direction, which nobody measures.
TEST_F(LobesFiles, ADrivingPointThatIsZeroAtEveryLineIsTold) {
  std::string zeros = "frequency_hz,real,imaginary\n";
  for (int hz = 2; hz <= 6000; hz += 2) zeros += std::to_string(hz) + ",0,0\n";
  write("zeros.csv", zeros);
  const Outcome outcome = lobes({path("tip.csv"), "y=" + path("zeros.csv"), "--tool", path("tool.toml"), "--quantity",
                                 "receptance", "--unit", "m/N", "--set", "lobes.count=2"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string log = core::read_file(temporary.path / "results" / "run.log");
  EXPECT_NE(log.find("zeros.csv: every line along tool.y is 0, as of a tool that is rigid there"), std::string::npos)
      << log;
  EXPECT_EQ(log.find("tip.csv: every line"), std::string::npos);
}

TEST_F(LobesFiles, TheReceptanceOfFittedPolesIsWrittenBesideWhatWasMeasured) {
  ASSERT_EQ(frf(path("tip.csv"), {"--set", "lobes.count=2"}).code, 0);
  const auto file = temporary.path / "results" / "lobes" / "tool_frf.csv";
  const io::Table table = io::read_csv(file);
  double largest = 0.0, apart = 0.0;
  for (const std::string part : {"re", "im"}) {
    const auto measured = io::numbers(table, part + " tool.x/tool.x m/N", file);
    const auto fitted = io::numbers_or_gaps(table, "synthesised " + part + " tool.x/tool.x m/N", file);
    for (std::size_t i = 0; i < measured.size(); ++i) {
      largest = std::max(largest, std::abs(measured[i]));
      if (std::isfinite(fitted[i])) apart = std::max(apart, std::abs(fitted[i] - measured[i]));
    }
    EXPECT_GT(std::ranges::count_if(fitted, [](double v) { return std::isfinite(v); }), std::ssize(fitted) / 2);
  }
  EXPECT_LT(apart, 1e-6 * largest) << "of one mode without noise the poles say it all";
}

}  // namespace
}  // namespace thinwall::tests::lobes_files_test
