// `tool.fit`: poles stand in the place of a measured tool's lines.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "case/reader.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "dynamics/conversion.hpp"
#include "setup/identified/identify.hpp"
#include "tests/app/lobes_command.hpp"

namespace thinwall::tests::fitted_tool_test {
namespace {

/// Four helical teeth.
const std::string helical_tool = R"([tool]
teeth = 4
diameter = "10 mm"
length = "10 mm"
helices = ["30 deg"]
)";
const std::string cut = R"([cutting]
radial_depth = "1 mm"
feed_direction = "x"
Kt = "600 N/mm^2"
Kr = "200 N/mm^2"
feed_per_tooth = "0.05 mm"
spindle_speed = "12000 rpm"
[lobes]
from = "9000 rpm"
to = "16000 rpm"
count = 4
most_added = 0
method = "semi_discretization_1"
)";

std::string measured(const std::string& file, const std::string& response, const std::string& force) {
  return "[[tool.measured]]\nresponse = \"" + response + "\"\nforce = \"" + force + "\"\nfile = \"" + file +
         "\"\nquantity = \"receptance\"\nunit = \"m/N\"\n";
}

class FittedTool : public LobesCommand {
 protected:
  [[nodiscard]] Outcome chart(const std::string& tool) const {
    write("case.toml", helical_tool + tool + cut);
    return lobes({path("case.toml")});
  }
  [[nodiscard]] std::vector<double> depths() const {
    return io::numbers(io::read_csv(temporary.path / "results" / "lobes" / "tool.csv"), "limiting_depth_m", "lobes");
  }
  /// Modes of 922 and 1400 Hz, their share in an entry, and noise relative to its size.
  void write_entry(const std::string& name, double first, double second, double noise, unsigned seed) const {
    std::mt19937 random(seed);
    const auto normal = [&] {
      double sum = -6.0;  // of twelve even numbers: near enough to normal, and the same everywhere
      for (int i = 0; i < 12; ++i) sum += static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
      return sum;
    };
    std::ostringstream text;
    text.precision(17);
    text << "frequency_hz,real,imaginary\n";
    for (double hz = 200.0; hz <= 3000.0; hz += 2.0) {
      const double r = hz / 922.0, q = hz / 1400.0;
      std::complex<double> H = first / (1.3e6 * std::complex<double>(1.0 - r * r, 0.022 * r)) +
                               second / (4e6 * std::complex<double>(1.0 - q * q, 0.04 * q));
      H += noise * std::abs(H) * std::complex<double>(normal(), normal());
      text << hz << ',' << H.real() << ',' << H.imag() << '\n';
    }
    write(name, text.str());
  }
};

/// Helices and semi-discretization need poles: lines are refused with the remedy, and the remedy gives the chart of the
/// structure's own mode.
TEST_F(FittedTool, GivesTheChartOfItsModesWhereLinesAreRefused) {
  const double omega = 2.0 * std::numbers::pi * 922.0;
  std::ostringstream modes;
  modes.precision(17);
  modes << "[[tool.modes]]\nfrequency = 922\ndamping_ratio = 0.011\nstiffness = " << 0.03993 * omega * omega
        << "\ndirection = \"x\"\n";
  const Outcome of_modes = chart(modes.str());
  ASSERT_EQ(of_modes.code, 0) << of_modes.err;
  const std::vector<double> wanted = depths();
  const Outcome refused = chart(measured("tip.csv", "x", "x"));
  EXPECT_EQ(refused.code, 3);
  EXPECT_NE(refused.err.find("tool.fit = true"), std::string::npos) << refused.err;
  const Outcome fitted = chart("fit = true\n" + measured("tip.csv", "x", "x"));
  ASSERT_EQ(fitted.code, 0) << fitted.err;
  const std::vector<double> found = depths();
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], wanted[i], 1e-5 * wanted[i]) << i;
  EXPECT_EQ(chart("fit = true\n" + modes.str()).code, 3);  // nothing to be fitted
}

/// Both directions of a round tool have the same two poles, and a cross entry: residues of rank two.
TEST_F(FittedTool, HasTheReceptancesOfARoundToolWithNoise) {
  write_entry("xx.csv", 1.0, 0.7, 0.01, 1);
  write_entry("yx.csv", 0.0, 0.3, 0.01, 2);
  write_entry("yy.csv", 1.0, 0.9, 0.01, 3);
  write("case.toml", helical_tool + "fit = true\n" + measured("xx.csv", "x", "x") + measured("yx.csv", "y", "x") +
                         measured("yy.csv", "y", "y") + cut);
  Case source = read_case(path("case.toml"));
  setup::identify(source);
  ASSERT_TRUE(source.tool->fitted);
  const dynamics::ModalModel& model = source.tool->fitted->model;
  const dynamics::ResponseModel response = dynamics::to_response(model, {Eigen::Vector3d(600.0, 922.0, 1400.0)});
  const auto truth = [](double hz, double first, double second) {
    const double r = hz / 922.0, q = hz / 1400.0;
    return first / (1.3e6 * std::complex<double>(1.0 - r * r, 0.022 * r)) +
           second / (4e6 * std::complex<double>(1.0 - q * q, 0.04 * q));
  };
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double hz = response.axis.hz(i);
    Eigen::Matrix2cd H;
    H << truth(hz, 1.0, 0.7), truth(hz, 0.0, 0.3), truth(hz, 0.0, 0.3), truth(hz, 1.0, 0.9);
    const int x = dynamics::row_of(response.responses, "tool.x"), y = dynamics::row_of(response.responses, "tool.y");
    const std::vector<int> rows{x, y};
    EXPECT_LT((response.H[static_cast<std::size_t>(i)](rows, rows) - H).norm(), 0.01 * H.norm()) << hz;
  }
}

/// Directions without a cross entry are apart from each other.
TEST_F(FittedTool, KeepsDirectionsApartThatNothingJoins) {
  write_entry("xx.csv", 1.0, 0.0, 0.0, 1);
  write_entry("yy.csv", 0.0, 1.0, 0.0, 1);
  write("case.toml", helical_tool + "fit = true\n" + measured("xx.csv", "x", "x") + measured("yy.csv", "y", "y") + cut);
  Case source = read_case(path("case.toml"));
  setup::identify(source);
  ASSERT_TRUE(source.tool->fitted);
  const dynamics::ModalModel& model = source.tool->fitted->model;
  EXPECT_EQ(model.poles.size(), 4);
  const dynamics::ResponseModel response = dynamics::to_response(model, {Eigen::Vector2d(900.0, 1350.0)});
  for (const Eigen::MatrixXcd& H : response.H) EXPECT_EQ(H(0, 1), 0.0);
  EXPECT_EQ(source.tool->fitted->notes.size(), 2u);
  EXPECT_TRUE(source.tool->fitted->warnings.empty());
}

}  // namespace
}  // namespace thinwall::tests::fitted_tool_test
