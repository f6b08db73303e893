// The error budget of a run: what a reduction leaves out against a reduction that leaves out less; noise against closed
// forms and drawn samples.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/frf/response_csv.hpp"
#include "tests/system/run_in_folder.hpp"

namespace thinwall::tests::error_budget_test {

using namespace setup;
using namespace cases;

namespace {

namespace fs = std::filesystem;

/// With THINWALL_SLOW=1 in the environment there are more draws.
const bool slow = std::getenv("THINWALL_SLOW") != nullptr;

/// The bound on the relative difference between the deviation of so many draws and that of first order: a deviation is
/// known to 1/√(2n), of which three are allowed, and 8 % for what is not of first order.
double scatter_of(int draws) {
  return 3.0 / std::sqrt(2.0 * draws) + 0.08;
}
using std::complex;

/// A wall that is cut at P and held behind it at B. Its damping does not depend on how many modes are kept.
std::string wall(int modes) {
  return R"([part]
shape = "box"
length = "120 mm"
height = "60 mm"
thickness = "5 mm"
[part.material]
youngs_modulus = "210 GPa"
poisson_ratio = 0.3
density = "7850 kg/m^3"
[part.mesh]
element_size = "15 mm"
[[part.supports]]
on = "z_min"
[points.P]
at = [1, 1, 1]
[points.B]
at = [0, 0.5, 0.8]
[reduction]
modes = )" +
         std::to_string(modes) + R"(
[damping]
model = "rayleigh"
alpha = "40 1/s"
beta = "1e-6 s"
[response]
from = "20 Hz"
to = "4 kHz"
lines = 1991
)";
}

/// What is cut at P, and the chart's speeds and tolerance.
std::string chart(int count, const std::string& tolerance) {
  return R"([tool]
teeth = 2
diameter = "12 mm"
length = "20 mm"
[cutting]
at = "P"
radial_depth = "1 mm"
mode = "down"
feed_direction = "y"
tool_axis = "z"
Kt = "600 N/mm^2"
Kr = "200 N/mm^2"
spindle_speed = "9000 rpm"
[lobes]
from = "5000 rpm"
to = "12000 rpm"
modes_up_to = "8 kHz"
)" + ("count = " + std::to_string(count) + "\nmost_added = 0\ntolerance = " + tolerance +
      "\n");  // the same speeds in every run
}

const std::string one_mode_robot = R"([robot]
frequency = "40 Hz"
damping_ratio = 0.05
stiffness = "8e5 N/m"
)";

const std::string contact = R"([[contacts]]
part = "B"
robot = "R"
directions = ["x"]
stiffness = "3e6 N/m"
)";

TEST(ErrorBudget, OfAReductionIsWhatMoreModesShow) {
  const fs::path few = scratch("budget_few"), many = scratch("budget_many");
  const auto summary = run(wall(24) + chart(12, "1e-5") + one_mode_robot + contact, few);
  static_cast<void>(run(wall(150) + chart(12, "1e-5") + one_mode_robot + contact, many));
  for (const std::string chart : {"part", "supported"}) {
    const fs::path file = few / "lobes" / (chart + ".csv");
    const auto depth = column(file, "limiting_depth_m"),
               truth = column(many / "lobes" / (chart + ".csv"), "limiting_depth_m");
    const auto told = column(file, "truncation_m");
    int compared = 0;
    for (std::size_t i = 0; i < depth.size(); ++i) {
      if (!std::isfinite(told[i])) continue;
      ++compared;
      // What stays: the square of the change, and modes above modes_up_to, which both charts take as static.
      const double off = depth[i] - truth[i];
      EXPECT_NEAR(told[i], off, 0.15 * std::abs(off) + 1e-4 * depth[i]) << chart << ", row " << i;
    }
    EXPECT_GE(compared, 6) << chart;
  }
  EXPECT_GT(summary["lobes"][0]["error_budget"]["largest_truncation_relative"].get<double>(), 1e-3)
      << "24 modes are too few to leave nothing out";
  const auto G = io::read_response(few / "frf" / "coupled_receptance.csv");
  const auto truth = io::read_response(many / "frf" / "coupled_receptance.csv");
  const auto told = column(few / "frf" / "coupled_error.csv", "truncation P.x/P.x");
  const Eigen::VectorXcd off = dynamics::entry(G, "P.x", "P.x") - dynamics::entry(truth, "P.x", "P.x");
  double largest = 0.0;
  for (Eigen::Index line = 0; line < off.size(); ++line) {
    // Told to a share (ω/ω_25)⁴ of itself (reduction/trust/truncation.hpp); and the reference of 150 modes leaves out,
    // too.
    EXPECT_NEAR(told[static_cast<std::size_t>(line)], std::abs(off(line)), 0.02 * std::abs(off(line)) + 1e-13)
        << G.axis.hz(line) << " Hz";
    largest = std::max(largest, std::abs(off(line)));
  }
  std::printf("24 modes leave out up to %.1e m/N of the coupled receptance\n", largest);
  EXPECT_GT(largest, 1e-10);
}

/// A robot's receptance of one mode, measured along x, with a coherence.
void write_robot(const fs::path& file, double coherence) {
  std::ostringstream text;
  text.precision(17);
  text << "frequency_hz,re,im,coherence\n";
  for (int i = 0; i < 1991; ++i) {
    const double hz = 20.0 + 2.0 * i, r = hz / 45.0;
    const complex<double> H = 1.0 / (8e5 * complex<double>(1.0 - r * r, 0.1 * r));
    text << hz << "," << H.real() << "," << H.imag() << "," << coherence << "\n";
  }
  core::write_file_atomically(file, text.str());
}

std::string measured_robot(const std::string& noise) {
  return R"([robot]
model = "measured"
[[robot.measured]]
response = "R.x"
force = "R.x"
file = "robot.csv"
quantity = "receptance"
unit = "m/N"
)" + noise;
}

TEST(ErrorBudget, NoiseOfARobotReachesThePointThroughTheContact) {
  const fs::path out = scratch("budget_noise");
  write_robot(out / "robot.csv", 1.0);
  static_cast<void>(run(wall(20) + measured_robot("noise = 0.02\n") + contact, out));
  const auto part = io::read_response(out / "frf" / "part.csv"), robot = io::read_response(out / "frf" / "robot.csv");
  const auto told = column(out / "frf" / "coupled_error.csv", "noise_deviation P.x/P.x");
  for (Eigen::Index line = 0; line < part.axis.size(); ++line) {
    const auto at = [&](const char* a, const char* b) { return dynamics::entry(part, a, b)(line); };
    const complex<double> H_R = dynamics::entry(robot, "R.x", "R.x")(line);
    const complex<double> S = at("B.x", "B.x") + H_R + 1.0 / 3e6;
    const double expected = std::abs(at("P.x", "B.x") * at("B.x", "P.x") / (S * S)) * 0.02 * std::abs(H_R);
    ASSERT_NEAR(told[static_cast<std::size_t>(line)], expected, 1e-9 * expected) << part.axis.hz(line) << " Hz";
  }
}

TEST(ErrorBudget, OfARegularisedKernelIsThatOfTheComponentsAlone) {
  const fs::path out = scratch("budget_regularised");
  write_robot(out / "robot.csv", 1.0);
  const auto budget = run(wall(20) + measured_robot("noise = 0.02\n") + contact +
                              "[coupling]\nregularisation = \"tikhonov\"\nthreshold = 1e-3\n",
                          out)["error_budget"];
  EXPECT_NEAR(budget["robot"]["noise"]["largest_relative"].get<double>(), 0.02, 1e-9);
  EXPECT_GT(budget["part"]["truncation"]["largest_relative"].get<double>(), 0.0);
  EXPECT_FALSE(budget.contains("coupled"));
}

TEST(ErrorBudget, CoherenceAndAveragesTellTheNoise) {
  const fs::path stated = scratch("budget_stated"), coherent = scratch("budget_coherent");
  const double gamma2 = 0.98, averages = 10.0, share = std::sqrt((1.0 - gamma2) / (2.0 * averages * gamma2));
  write_robot(stated / "robot.csv", 1.0);
  write_robot(coherent / "robot.csv", gamma2);
  const auto by_share =
      run(wall(20) + measured_robot("noise = " + std::to_string(share) + "\n") + contact, stated)["error_budget"];
  const auto by_coherence = run(wall(20) + measured_robot("averages = 10\n") + contact, coherent)["error_budget"];
  EXPECT_NEAR(by_coherence["robot"]["noise"]["largest_relative"].get<double>(), share, 1e-9);
  EXPECT_NEAR(by_coherence["coupled"]["noise"]["largest_relative"].get<double>(),
              by_share["coupled"]["noise"]["largest_relative"].get<double>(), 1e-4 * share);
}

TEST(ErrorBudget, DrawnSamplesScatterAsFirstOrderSays) {
  const int draws = slow ? 40 : 10;
  const fs::path out = scratch("budget_draws");
  write_robot(out / "robot.csv", 1.0);
  const auto summary = run(wall(20) + chart(2, "1e-3") + "noise_samples = " + std::to_string(draws) + "\nseed = 7\n" +
                               measured_robot("noise = 0.01\n") + contact,
                           out);
  const auto& supported = summary["lobes"][1];
  ASSERT_EQ(supported["name"], "supported");
  const auto& error = supported["at_case_speed"]["error_budget"];
  const double first_order = error["noise_deviation_m"].get<double>();
  const double drawn = error["sampled"]["deviation_m"].get<double>();
  std::printf("noise 1 %%: deviation of the depth %.3g mm by first order, %.3g mm by %d draws\n", first_order * 1e3,
              drawn * 1e3, error["sampled"]["draws"].get<int>());
  EXPECT_NEAR(drawn, first_order, scatter_of(draws) * first_order);
  EXPECT_GT(first_order, 0.0);
  EXPECT_EQ(error["sampled"]["seed"], 7);
}

/// A tool's tip of one mode, the same along x and y.
void write_tool(const fs::path& file) {
  std::ostringstream text;
  text.precision(17);
  for (int i = 0; i < 1200; ++i) {
    const double hz = 200.0 + 4.0 * i, r = hz / 2100.0;
    const complex<double> H = 1.0 / (2e7 * complex<double>(1.0 - r * r, 0.06 * r));
    text << hz << "," << H.real() << "," << H.imag() << "\n";
  }
  core::write_file_atomically(file, text.str());
}

std::string measured_tool(const std::string& noise) {
  std::string text;
  for (const char* dof : {"x", "y"}) {
    text += std::string("[[tool.measured]]\nresponse = \"") + dof + "\"\nforce = \"" + dof +
            "\"\nfile = \"tool.csv\"\nquantity = \"receptance\"\nunit = \"m/N\"\n" + noise;
  }
  return text;
}

TEST(ErrorBudget, NoiseOfAToolAndTruncationOfThePartBesideIt) {
  const int draws = slow ? 40 : 10;
  const fs::path out = scratch("budget_tool"), more = scratch("budget_tool_more");
  write_tool(out / "tool.csv");
  write_tool(more / "tool.csv");
  const std::string cut = chart(4, "1e-4") + "noise_samples = " + std::to_string(draws) + "\nseed = 3\n";
  const auto summary = run(wall(24) + cut + measured_tool("noise = 0.01\n"), out);
  static_cast<void>(run(wall(150) + chart(4, "1e-4") + measured_tool(""), more));
  const auto& error = summary["lobes"][0]["at_case_speed"]["error_budget"];
  const double first_order = error["noise_deviation_m"].get<double>();
  EXPECT_NEAR(error["sampled"]["deviation_m"].get<double>(), first_order, scatter_of(draws) * first_order);
  EXPECT_GT(first_order, 0.0);
  const auto depth = column(out / "lobes" / "part.csv", "limiting_depth_m");
  const auto truth = column(more / "lobes" / "part.csv", "limiting_depth_m");
  const auto told = column(out / "lobes" / "part.csv", "truncation_m");
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const double off = depth[i] - truth[i];
    if (!std::isfinite(told[i])) continue;
    EXPECT_NEAR(told[i], off, 0.2 * std::abs(off) + 3e-4 * depth[i]) << "row " << i;
  }
}

TEST(ErrorBudget, NoiseOfEntriesThatCountAgainstAnAxis) {
  const fs::path out = scratch("budget_turned");
  write_robot(out / "robot.csv", 1.0);
  std::string robot = "[robot]\nmodel = \"measured\"\n";
  for (const auto& [response, force] : {std::pair{"R.-x", "R.-x"}, {"R.y", "R.-x"}, {"R.y", "R.y"}}) {
    robot += std::string("[[robot.measured]]\nresponse = \"") + response + "\"\nforce = \"" + force +
             "\"\nfile = \"robot.csv\"\nquantity = \"receptance\"\nunit = \"m/N\"\nnoise = 0.05\n";
  }
  static_cast<void>(run(wall(20) + robot + contact, out));
  const auto H = io::read_response(out / "frf" / "robot.csv");
  const fs::path file = out / "frf" / "robot_error.csv";
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      const auto told =
          column(file, "noise_deviation " + dynamics::name(H.responses[i]) + "/" + dynamics::name(H.forces[j]));
      const complex<double> entry = H.H[7](static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      EXPECT_NEAR(told[7], 0.05 * std::abs(entry), 1e-12 * std::abs(entry)) << i << j;
    }
  }
}

TEST(ErrorBudget, SaysWhatDoesNotFit) {
  const fs::path out = scratch("budget_bad");
  write_robot(out / "robot.csv", 1.0);
  const auto message = [&](const std::string& text) -> std::string {
    try {
      static_cast<void>(run(text, out));
    } catch (const core::Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message(wall(20) + measured_robot("noise = 0.02\naverages = 5\n") + contact).find("keep one of the two"),
            std::string::npos);
  EXPECT_NE(message(wall(20) + chart(2, "1e-3") + "noise_samples = 9\n" + measured_robot("") + contact)
                .find("nothing is noisy"),
            std::string::npos);
  write_robot(out / "robot.csv", 0.0);
  EXPECT_NE(message(wall(20) + measured_robot("averages = 5\n") + contact).find("coherence is 0"), std::string::npos);
  core::write_file_atomically(out / "robot.csv", "f,re,im\n10,1e-6,-1e-8\n5000,1e-6,-1e-8\n");
  EXPECT_NE(message(wall(20) + measured_robot("averages = 5\n") + contact).find("has no coherence"), std::string::npos);
}

}  // namespace
}  // namespace thinwall::tests::error_budget_test
