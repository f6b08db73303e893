// Runs that stand on a fitted tool or a learned robot: the range of their limits, and what is kept for the next run.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <fstream>
#include <numbers>
#include <random>
#include <sstream>

#include "app/command_line.hpp"
#include "app/simulate_command.hpp"
#include "case/numbers.hpp"
#include "core/draws.hpp"
#include "run_in_folder.hpp"

namespace thinwall::tests::identified_test {
namespace {

namespace fs = std::filesystem;

const std::string cut = R"([cutting]
radial_depth = "10 mm"
feed_direction = "x"
Kt = "600 N/mm^2"
Kr = "200 N/mm^2"
feed_per_tooth = "0.05 mm"
spindle_speed = "9000 rpm"
[lobes]
from = "6000 rpm"
to = "12000 rpm"
count = 7
most_added = 0
)";

const std::string tool = R"([tool]
teeth = 2
diameter = "10 mm"
length = "20 mm"
)";

/// Six postures of a robot of one mode along x, whose frequency rises with the posture and scatters.
void write_postures(const fs::path& folder) {
  std::mt19937 random(3);
  std::ofstream list(folder / "postures.csv");
  list << "posture,u\n";
  for (int i = 0; i < 6; ++i) {
    list << "p" << i << "," << i << "\n";
    std::ofstream table(folder / ("p" + std::to_string(i) + ".csv"));
    const double hz = 360.0 * std::exp(0.01 * i + 0.003 * core::normal_draw(random));
    // φ of 0.5 kg: R L = 1/(2i ω m) = (a (1 − i))², a² = 1/(4 ω m)
    const double a = std::sqrt(1.0 / (4.0 * 2.0 * std::numbers::pi * hz * 0.5));
    table << "frequency_hz,damping_ratio,R_1X_re,R_1X_im,L_1X_re,L_1X_im\n"
          << hz << ",0.03," << a << "," << -a << "," << a << "," << -a << "\n";
  }
}

std::string robot(double at) {
  return "[robot]\nmodel = \"modal_table\"\ncarries = \"tool\"\npostures = \"postures.csv\"\ntable = "
         "\"{posture}.csv\"\n"
         "over = [\"u\"]\nat = [" +
         std::to_string(at) + "]\n";
}

nlohmann::json run_kept(const std::string& text, const fs::path& folder) {
  return summary_json(run_case(parse_case(text, folder), {folder, false, -1, false}).summary);
}

bool identified(const fs::path& cache_of, const std::string& stage) {
  return fs::exists(cache_of / "cache" / (stage + ".bin"));
}

TEST(LearnedRobot, GivesItsChartARangeAndIsKept) {
  const fs::path folder = scratch("learned_robot");
  write_postures(folder);
  const auto first = run(robot(2.5) + tool + cut, folder);
  const auto& row = first["lobes"][0]["at_case_speed"];
  const double depth = row["limiting_depth_m"], low = row["error_budget"]["identification"]["low_m"],
               high = row["error_budget"]["identification"]["high_m"];
  EXPECT_LT(low, depth);
  EXPECT_GT(high, depth);
  const fs::path chart = folder / "lobes" / "carried.csv";
  const auto lows = column(chart, "identification_low_m"), highs = column(chart, "identification_high_m"),
             depths = column(chart, "limiting_depth_m");
  for (std::size_t i = 0; i < depths.size(); ++i) {
    EXPECT_LE(lows[i], depths[i]);
    EXPECT_GE(highs[i], depths[i]);
  }
  ASSERT_TRUE(identified(folder, "robot"));
  // The tables are those that were read, so that another result would be one that was learned anew.
  const auto learned_at = fs::last_write_time(folder / "cache" / "robot.bin");
  const auto again = run_kept(robot(2.5) + tool + cut, folder);
  EXPECT_EQ(again["lobes"], first["lobes"]);
  EXPECT_EQ(fs::last_write_time(folder / "cache" / "robot.bin"), learned_at);
  (void)run_kept(robot(2.5) + tool + cut + "method = \"zeroth_order\"\n", folder);
  EXPECT_EQ(fs::last_write_time(folder / "cache" / "robot.bin"), learned_at) << "another chart of the same robot";
  const auto elsewhere = run_kept(robot(0.5) + tool + cut, folder);
  EXPECT_NE(elsewhere["robot"]["modes"], first["robot"]["modes"]);
}

/// `thinwall robot` looks at the modes that are learned, between those of the two postures beside.
TEST(LearnedRobot, IsSurveyed) {
  const fs::path folder = scratch("learned_survey");
  write_postures(folder);
  std::ofstream(folder / "case.toml") << robot(2.5) + tool + cut;
  const std::string file = (folder / "case.toml").string(), out = (folder / "out").string();
  const char* words[] = {"thinwall", "robot", file.c_str(), "--out", out.c_str()};
  std::ostringstream said, err;
  EXPECT_EQ(run_command_line(5, words, run_case, said, err), 0) << said.str() << err.str();
  EXPECT_NE(said.str().find("Hz"), std::string::npos) << said.str();
}

/// A tip of one mode with noise: the range covers the depth of the mode itself, and less noise makes it narrower by as
/// much, as both ends are to first order.
TEST(FittedTool, GivesItsChartARangeInTheMeasureOfItsNoise) {
  const fs::path folder = scratch("fitted_tool_range");
  const auto width_of = [&](double noise) {
    std::mt19937 random(9);
    std::ofstream file(folder / "tip.csv");
    file.precision(17);
    file << "frequency_hz,real,imaginary\n";
    for (double hz = 100.0; hz <= 2000.0; hz += 2.0) {
      const double r = hz / 700.0;
      std::complex<double> H = 1.0 / (1.5e6 * std::complex<double>(1.0 - r * r, 0.06 * r));
      const double real = core::normal_draw(random);
      H += noise * std::abs(H) * std::complex<double>(real, core::normal_draw(random));
      file << hz << ',' << H.real() << ',' << H.imag() << '\n';
    }
    file.close();
    const auto summary = run(tool +
                                 "fit = true\n[[tool.measured]]\nresponse = \"x\"\nforce = \"x\"\nfile = \"tip.csv\"\n"
                                 "quantity = \"receptance\"\nunit = \"m/N\"\n" +
                                 cut,
                             folder);
    const auto& row = summary["lobes"][0]["at_case_speed"];
    const auto& range = row["error_budget"]["identification"];
    EXPECT_LT(range["low_m"], row["limiting_depth_m"]);
    EXPECT_GT(range["high_m"], row["limiting_depth_m"]);
    return (range["high_m"].get<double>() - range["low_m"].get<double>()) / row["limiting_depth_m"].get<double>();
  };
  const double wide = width_of(0.04), narrow = width_of(0.01);
  EXPECT_NEAR(wide / narrow, 4.0, 1.0) << wide << " " << narrow;
  EXPECT_TRUE(identified(folder, "tool"));
}

}  // namespace
}  // namespace thinwall::tests::identified_test
