// The nine modes of an ABB IRB6660 (Lei, Hou & Ding 2022, Table B1) against the sum that defines them.

#include "robot/modal_table.hpp"

#include <gtest/gtest.h>

#include <array>
#include <complex>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "core/error.hpp"
#include "dynamics/conversion.hpp"
#include "io/frf/modal_table_csv.hpp"

namespace thinwall::modal_table_test {
namespace {

using Complex = std::complex<double>;

const std::filesystem::path file =
    std::filesystem::path(THINWALL_SOURCE_DIR) / "cases/irb6660-measured/irb6660_modes.csv";

dynamics::ModalTable irb6660() {
  const double low = 0.0334, high = 0.020;
  return io::read_modal_table(file, {io::modal_unit("sqrt(s/kg)"),
                                     io::modal_unit("1e-7 sqrt(s/kg)"),
                                     {{"1", {0.0}}, {"a", {low, low, low, low, low, high, high, high, high}}}});
}

/// The file's numbers as they stand, by position, nine lines of nineteen.
std::vector<std::array<double, 19>> raw_lines() {
  std::vector<std::array<double, 19>> lines;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || std::isdigit(static_cast<unsigned char>(line[0])) == 0) continue;
    std::istringstream fields(line);
    lines.emplace_back();
    for (double& value : lines.back()) {
      fields >> value;
      fields.ignore(1);
    }
  }
  return lines;
}

/// The header's sum, term by term: j, k = 0…3 for 1X, 1Y, aX, aY.
Complex defining_sum(std::size_t j, std::size_t k, double hz) {
  const double w = 2.0 * std::numbers::pi * hz;
  Complex H = 0.0;
  for (const auto& line : raw_lines()) {
    const double w_n = 2.0 * std::numbers::pi * line[1], zeta = line[2] / 100.0;
    const Complex L(line[3 + 2 * k], line[4 + 2 * k]), R = 1e-7 * Complex(line[11 + 2 * j], line[12 + 2 * j]);
    const Complex pole(-zeta * w_n, w_n * std::sqrt(1.0 - zeta * zeta)), iw(0.0, w);
    H += R * L / (iw - pole) + std::conj(R) * std::conj(L) / (iw - std::conj(pole));
  }
  return H;
}

TEST(Irb6660, ReceptancesAreTheDefiningSum) {
  ASSERT_EQ(raw_lines().size(), 9U);
  const dynamics::FrequencyAxis axis = dynamics::linear_axis(0.0, 1200.0, 301);
  const auto all = dynamics::to_response(robot::modal_model(irb6660(), robot::PointPlaces::may_differ), axis);
  const char* names[] = {"1.x", "1.y", "a.x", "a.y"};
  double largest = 0.0;
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t k = 0; k < 4; ++k) {
      const Eigen::VectorXcd H = dynamics::entry(all, names[j], names[k]);
      Eigen::VectorXcd sum(axis.size());
      for (Eigen::Index line = 0; line < axis.size(); ++line) sum(line) = defining_sum(j, k, axis.hz(line));
      largest = std::max(largest, ((H - sum).array() / sum.array()).abs().maxCoeff());
    }
  }
  std::printf("IRB6660: 16 receptances at 301 lines to %.1e of the sum\n", largest);
  EXPECT_LT(largest, 1e-12);
}

TEST(Irb6660, HasItsPeakAt15Point9Hertz) {
  const dynamics::FrequencyAxis axis = dynamics::linear_axis(5.0, 40.0, 3501);
  const auto tip = dynamics::to_response(robot::modal_model(robot::at_point(irb6660(), "1")), axis);
  ASSERT_EQ(tip.responses.size(), 2U);
  const Eigen::VectorXcd H = dynamics::entry(tip, "1.x", "1.x");
  Eigen::Index peak = 0;
  EXPECT_NEAR(H.cwiseAbs().maxCoeff(&peak), 15.2e-6, 0.05e-6);
  EXPECT_NEAR(axis.hz(peak), 15.9, 0.05);
  const Complex at_peak = defining_sum(0, 0, axis.hz(peak));
  EXPECT_LT(std::abs(H(peak) - at_peak), 1e-12 * std::abs(at_peak));
}

// The properties of the table of which the case's README warns.
TEST(Irb6660, IsNeitherSymmetricNorPassive) {
  const dynamics::FrequencyAxis axis = dynamics::linear_axis(5.0, 40.0, 3501);
  const auto tip = dynamics::to_response(robot::modal_model(robot::at_point(irb6660(), "1")), axis);
  Eigen::Index line = 0;
  EXPECT_NEAR(dynamics::entry(tip, "1.x", "1.x").imag().maxCoeff(&line), 0.146e-6, 0.0005e-6);
  EXPECT_NEAR(axis.hz(line), 9.95, 0.02);
  EXPECT_NEAR(dynamics::entry(tip, "1.y", "1.y").imag().maxCoeff(), 0.134e-6, 0.0005e-6);
  EXPECT_GT((dynamics::entry(tip, "1.x", "1.y") - dynamics::entry(tip, "1.y", "1.x")).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(Irb6660, ItsSecondPointIsTwo) {
  EXPECT_THROW((void)robot::modal_model(irb6660()), core::InputError);
  EXPECT_EQ(robot::with_point_at(irb6660(), "a", 0.0334).rows.size(), 5U);
  EXPECT_EQ(robot::with_point_at(irb6660(), "a", 0.020).rows.size(), 4U);
  const auto tip = robot::modal_model(robot::with_rotations(irb6660(), "1", "a", Eigen::Vector3d::UnitZ()));
  EXPECT_EQ(tip.dofs.size(), 4U);
  EXPECT_EQ(tip.poles.size(), 18);
}

}  // namespace
}  // namespace thinwall::modal_table_test
