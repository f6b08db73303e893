// The growth of a small vibration in the time domain: values of another program, the order of the steps, the lobes'
// multipliers for structures and cuts at random.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <sstream>

#include "core/error.hpp"
#include "milling/direct/stability.hpp"
#include "milling/simulation/growth.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::milling::simulated_growth_test {
namespace {

constexpr double pi = std::numbers::pi;

struct Row {
  MillingProcess process;
  RelativeStructure structure;
  double rpm, depth_m, modulus;
  std::string where;
};

Row row_of(const std::vector<std::string>& cell, const std::string& line) {
  Row row;
  row.process.cutter = {2, 0.01};
  row.process.coefficients = {6e8, 2e8, 0.0, 0.0, 0.0, 0.0};
  const auto direction = cell[4] == "up" ? MillingDirection::up : MillingDirection::down;
  row.process.engagement = engagement_of(row.process.cutter, 0.01 * std::stod(cell[0]), direction);
  const double first = std::stod(cell[5]);
  if (first != 180.0) row.process.cutter.pitches_rad = {first * pi / 180.0, (360.0 - first) * pi / 180.0};
  std::vector<testing::Mode> modes{{922.0, 0.011, 0.03993, Eigen::Vector3d::UnitX()}};
  if (cell[3] == "2") modes.push_back({922.0, 0.011, 0.03993, Eigen::Vector3d::UnitY()});
  row.structure = relative_structure(testing::modal_model(modes), "P");
  row.rpm = std::stod(cell[1]);
  row.depth_m = 1e-3 * std::stod(cell[2]);
  row.modulus = std::stod(cell[8]);
  row.where = line.substr(0, 45);
  return row;
}

std::vector<Row> rows() {
  std::ifstream file(THINWALL_SOURCE_DIR "/tests/milling/data/time_domain_growth.csv");
  std::vector<Row> result;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::stringstream cells(line);
    std::vector<std::string> cell;
    for (std::string text; std::getline(cells, text, ',');) cell.push_back(text);
    result.push_back(row_of(cell, line));
  }
  return result;
}

SimulatedGrowth growth(const Row& row, int steps) {
  return simulated_growth(row.structure, row.process, row.rpm, row.depth_m, {steps, 1});
}

TEST(SimulatedGrowth, IsThatOfCollocation) {
  const auto all = rows();
  ASSERT_EQ(all.size(), 8u);
  for (const Row& row : all) {
    const SimulatedGrowth found = growth(row, 200);
    EXPECT_TRUE(found.converged) << row.where;
    EXPECT_NEAR(found.modulus, row.modulus, 2e-8) << row.where;
    EXPECT_NEAR(growth(row, 400).modulus, row.modulus, 2e-9) << row.where;
    EXPECT_LE(std::abs(found.modulus / row.modulus - 1.0), found.error_estimate + 3e-10) << row.where;
  }
}

/// Lobatto's collocation has the order 4 in the force; 3.8 is where the last of eight rows has its asymptote.
TEST(SimulatedGrowth, ConvergesWithTheFourthPowerOfTheStep) {
  for (const Row& row : rows()) {
    const double coarse = std::abs(growth(row, 12).modulus - row.modulus);
    const double fine = std::abs(growth(row, 24).modulus - row.modulus);
    EXPECT_GE(std::log2(coarse / fine), 3.8) << row.where;
  }
}

/// Ten modes from 300 Hz to 6 kHz in three directions, with a residual; teeth, pitches, helices, envelopes at random.
struct RandomMilling {
  RelativeStructure structure;
  MillingProcess process;
  double rpm = 0.0, depth_m = 0.0;
};

RandomMilling random_milling(unsigned seed) {
  std::mt19937 generator(seed);
  const auto between = [&](double a, double b) {
    return a + (b - a) * static_cast<double>(generator()) / static_cast<double>(std::mt19937::max());
  };
  constexpr int modes = 10;
  RandomMilling cut;
  RelativeStructure& s = cut.structure;
  s.poles.resize(modes);
  s.phi.resize(3, modes);
  s.b.resize(3, modes);
  s.R = Eigen::Vector3d(1e-9, 2e-9, 1e-9).asDiagonal();
  for (int k = 0; k < modes; ++k) {
    const double omega = 2.0 * pi * 300.0 * std::pow(20.0, between(0.0, 1.0));
    const double zeta = 0.005 * std::pow(10.0, between(0.0, 1.0));
    s.poles(k) = {-zeta * omega, omega * std::sqrt(1.0 - zeta * zeta)};
    const double angle = between(0.0, pi);
    const Eigen::Vector3d shape(std::cos(angle), std::sin(angle), between(-0.3, 0.3));
    s.phi.col(k) = shape.cast<std::complex<double>>();
    s.b.col(k) = shape / std::complex<double>(0.0, 2.0 * s.poles(k).imag() * between(0.3, 2.0));
  }
  const int teeth = 1 + static_cast<int>(between(0.0, 3.999));
  Cutter& cutter = cut.process.cutter;
  cutter = {teeth, 0.01};
  cut.process.coefficients = {6e8, 2e8, 1e8, 0.0, 0.0, 0.0};
  const bool helical = between(0.0, 1.0) > 0.3;
  if (helical) cutter.helices_rad.assign(static_cast<std::size_t>(teeth), between(0.2, 0.6));
  if (teeth > 1 && between(0.0, 1.0) < 0.5) {
    const double shift = between(0.02, 0.15) * 2.0 * pi / teeth;
    cutter.pitches_rad.assign(static_cast<std::size_t>(teeth), 2.0 * pi / teeth);
    cutter.pitches_rad.front() += shift;
    cutter.pitches_rad.back() -= shift;
    if (helical && between(0.0, 1.0) < 0.5) cutter.helices_rad.front() *= 0.9;
  }
  if (between(0.0, 1.0) < 0.25) cutter.envelope = between(0.0, 1.0) < 0.5 ? ball_end(0.01) : bull_nose(0.01, 0.002);
  const auto direction = between(0.0, 1.0) < 0.5 ? MillingDirection::up : MillingDirection::down;
  cut.process.engagement = engagement_of(cutter, 0.01 * std::pow(0.03, between(0.0, 1.0)), direction);
  cut.rpm = between(3000.0, 20000.0);
  cut.depth_m = between(0.2e-3, 2e-3);
  return cut;
}

/// Two ways that share the directional matrix and nothing else: contact-phase collocation with means over the depth,
/// and the march of discs. Where the lobes' own estimate is larger than the bar it is what can be asked for.
TEST(SimulatedGrowth, IsThatOfTheLobesForStructuresAndCutsAtRandom) {
  StabilityOptions fine;
  fine.error_tolerance = 1e-7;
  int compared = 0;
  for (unsigned seed = 1; seed <= 24; ++seed) {
    const RandomMilling cut = random_milling(seed);
    const Multiplier lobes = multiplier_at(cut.structure, cut.process, cut.rpm, cut.depth_m, fine);
    const SimulatedGrowth found = simulated_growth(cut.structure, cut.process, cut.rpm, cut.depth_m);
    EXPECT_TRUE(found.converged) << seed;
    const double difference = std::abs(found.modulus / lobes.modulus - 1.0);
    if (lobes.error_estimate > 1e-5) continue;
    ++compared;
    EXPECT_LE(difference, 1e-5 + lobes.error_estimate) << seed;
  }
  EXPECT_GE(compared, 20);
}

/// The promise of the estimate, against three times as many steps and twice as many discs.
TEST(SimulatedGrowth, IsNoFurtherOffThanItSays) {
  for (unsigned seed = 1; seed <= 24; ++seed) {
    const RandomMilling cut = random_milling(seed);
    const SimulatedGrowth found = simulated_growth(cut.structure, cut.process, cut.rpm, cut.depth_m);
    const SimulatedGrowth finer = simulated_growth(cut.structure, cut.process, cut.rpm, cut.depth_m, {600, 24});
    EXPECT_LE(std::abs(found.modulus / finer.modulus - 1.0), found.error_estimate + 1e-10) << seed;
  }
}

/// Runout shifts what each tooth finds, by the same in every turn: a small vibration grows as without it.
TEST(SimulatedGrowth, DoesNotFeelRunout) {
  Row row = rows()[1];
  const double without = growth(row, 100).modulus;
  row.process.cutter.runout_m.assign(static_cast<std::size_t>(row.process.cutter.teeth), 5e-6);
  row.process.cutter.runout_m.front() = -5e-6;
  EXPECT_NEAR(growth(row, 100).modulus, without, 1e-12);
}

TEST(SimulatedGrowth, FeelsProcessDampingAsTheLobesDo) {
  Row row = rows()[1];
  row.process.damping = {2e3, 0.3};
  const Multiplier lobes = multiplier_at(row.structure, row.process, row.rpm, row.depth_m, {.error_tolerance = 1e-9});
  EXPECT_LT(lobes.modulus, row.modulus - 1e-3);  // it matters here
  EXPECT_NEAR(growth(row, 400).modulus, lobes.modulus, 1e-7);
}

TEST(SimulatedGrowth, RefusesWhatItCannotMarch) {
  const Row row = rows()[0];
  EXPECT_THROW((void)growth(row, 3), core::InputError);
  EXPECT_THROW((void)simulated_growth(row.structure, row.process, 0.0, 1e-3), core::InputError);
  EXPECT_THROW((void)simulated_growth(row.structure, row.process, 1e4, 0.0), core::InputError);
}

}  // namespace
}  // namespace thinwall::milling::simulated_growth_test
