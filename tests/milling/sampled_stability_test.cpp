// Stability from samples of a receptance, without poles, against the same structures by their poles and against the
// benchmark's independent values.

#include "milling/chart/sampled_stability.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "milling/direct/critical_depths.hpp"
#include "milling/direct/cut_at_speed.hpp"
#include "milling/direct/harmonic_gain.hpp"
#include "milling/direct/passivity.hpp"
#include "milling/direct/stability.hpp"
#include "tests/milling/benchmark.hpp"

namespace thinwall::milling::sampled_stability_test {
namespace {

using testing::base_frequency;
using testing::benchmark_process;
using testing::benchmark_structure;
using testing::Reference;
using testing::references;

/// Lines as an analyser gives them, tool axes.
SampledReceptance sampled(const RelativeStructure& structure, const ToolFrame& frame, double from_hz, double to_hz,
                          double spacing_hz) {
  const RelativeStructure in_tool = in_tool_axes(structure, frame);
  const auto lines = static_cast<Eigen::Index>(std::lround((to_hz - from_hz) / spacing_hz)) + 1;
  SampledReceptance result{Eigen::VectorXd::LinSpaced(lines, from_hz, to_hz), {}};
  for (const double hz : result.frequency_hz) result.H.push_back(receptance(in_tool, 2.0 * std::numbers::pi * hz));
  return result;
}

const SampledReceptance& benchmark_lines() {
  static const SampledReceptance lines = sampled(benchmark_structure(), {}, 0.0, 12000.0, 1.0);
  return lines;
}

const FittedStructure& benchmark_fit() {
  static const FittedStructure fit = fitted_structure({benchmark_lines(), {}}, {});
  return fit;
}

std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const core::InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "";
}

TEST(SampledStability, TheBenchmarksCriticalDepths) {
  const auto rows = references("wcrit_mm");
  ASSERT_EQ(rows.size(), 15u);
  for (const Reference& row : rows) {
    SCOPED_TRACE(row.where());
    StabilityOptions options;
    options.depth_limit_m = 3.0 * row.depth_m;
    const LobeRow found = limiting_depth(benchmark_fit(), benchmark_process(row.immersion), row.rpm, options);
    EXPECT_EQ(found.status, StabilityStatus::converged);
    EXPECT_LE(found.error_estimate, options.error_tolerance);
    // Six-point interpolation of lines 1 Hz apart at a half width of 10 Hz is good to 3e-6 of the peak; the inertia
    // line beyond 12 kHz to (922/12000)² of what is left there.
    EXPECT_NEAR(found.limiting_depth_m / row.depth_m, 1.0, found.error_estimate + 5e-6);
    EXPECT_EQ(found.kind, row.kind == "Hopf" ? Bifurcation::hopf : Bifurcation::flip);
    EXPECT_NEAR(base_frequency(found.chatter_frequency_hz, row.rpm), row.base_hz, 1e-3 * row.rpm / 30.0);
  }
}

TEST(SampledStability, ATighterToleranceStaysWithinTheLooserEstimate) {
  // Nodes and harmonics only: both answers come from the same lines.
  StabilityOptions loose;
  loose.error_tolerance = 1e-2;
  loose.follow = 1.0;
  StabilityOptions sharp = loose;
  sharp.error_tolerance = 1e-6;
  const auto all = references("wcrit_mm");
  const std::size_t step = std::getenv("THINWALL_SLOW") != nullptr ? 1 : 4;  // every fourth row in the short run
  for (std::size_t i = 0; i < all.size(); i += step) {
    const Reference& row = all[i];
    SCOPED_TRACE(row.where());
    const MillingProcess process = benchmark_process(row.immersion);
    const LobeRow coarse = limiting_depth(benchmark_fit(), process, row.rpm, loose);
    const LobeRow fine = limiting_depth(benchmark_fit(), process, row.rpm, sharp);
    EXPECT_LE(std::abs(coarse.limiting_depth_m / fine.limiting_depth_m - 1.0),
              coarse.error_estimate + fine.error_estimate);
    EXPECT_LE(fine.error_estimate, 2e-5);  // what lies beyond 12 kHz has its share
  }
}

/// Two directions that share no axis with the cut, and a third in z that K_a excites.
const std::vector<testing::Mode> skewed{{420.0, 0.03, 0.4, Eigen::Vector3d(0.9, 0.3, 0.1)},
                                        {660.0, 0.02, 0.3, Eigen::Vector3d(-0.2, 0.8, 0.3)}};

MillingProcess skewed_cut() {
  MillingProcess process;
  process.cutter = {3, 0.012};
  process.coefficients = {1.2e9, 0.4e9, 0.2e9, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, 3e-3, MillingDirection::up);
  process.frame = {Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
  return process;
}

TEST(SampledStability, AgreesWithThePolesForThreeByThreeReceptances) {
  const RelativeStructure structure = relative_structure(testing::modal_model(skewed), "P");
  const MillingProcess process = skewed_cut();
  const SampledReceptance lines = sampled(structure, process.frame, 0.0, 8000.0, 2.0);
  StabilityOptions options;
  options.follow = 4.0;
  int compared = 0;
  for (const double rpm : {2300.0, 4100.0, 5600.0, 9700.0}) {
    SCOPED_TRACE(rpm);
    const LobeRow by_lines = limiting_depth(SampledStructure{lines, {}}, process, rpm, options);
    const LobeRow by_poles = limiting_depth(structure, process, rpm, options);
    ASSERT_EQ(by_lines.status, by_poles.status);
    const double reach = std::min(by_lines.searched_m, by_poles.searched_m);
    for (std::size_t i = 0; i < by_poles.crossings.size() && by_poles.crossings[i].depth_m < 0.99 * reach; ++i) {
      const LobePoint& pole = by_poles.crossings[i];
      ASSERT_LT(i, by_lines.crossings.size());
      const LobePoint& line = by_lines.crossings[i];
      EXPECT_NEAR(line.depth_m / pole.depth_m, 1.0, line.error_estimate + pole.error_estimate + 2e-5);
      EXPECT_EQ(line.unstable_change, pole.unstable_change);
      EXPECT_EQ(line.kind, pole.kind);
      EXPECT_NEAR(line.chatter_frequency_hz, pole.chatter_frequency_hz, 0.1);
      ++compared;
    }
  }
  EXPECT_GE(compared, 6);
}

/// The fit with the modes near a frequency left to the remainder, as of a fit that missed them.
FittedStructure without_modes_near(FittedStructure structure, double hz, const ToolFrame& frame) {
  for (FittedStructure::Fit* fit : {&structure.all, &structure.even, &structure.odd, &structure.within}) {
    RelativeStructure& s = fit->poles;
    std::vector<Eigen::Index> kept;
    for (Eigen::Index k = 0; k < s.poles.size(); ++k) {
      if (std::abs(s.poles(k).imag() / (2.0 * std::numbers::pi) - hz) > 20.0) kept.push_back(k);
    }
    s = {s.poles(kept).eval(), s.phi(Eigen::all, kept).eval(), s.b(Eigen::all, kept).eval(), s.R};
  }
  SampledReceptance& rest = structure.all.remainder;
  rest = structure.lines.samples;
  const RelativeStructure left = in_tool_axes(structure.all.poles, frame);
  for (std::size_t i = 0; i < rest.H.size(); ++i)
    rest.H[i] -= receptance(left, 2.0 * std::numbers::pi * rest.frequency_hz(static_cast<Eigen::Index>(i)));
  return structure;
}

TEST(SampledStability, ModesThatTheFitMissedAreFoundAmongTheLinesAndNeverCalledStable) {
  const MillingProcess process = skewed_cut();
  const SampledReceptance lines =
      sampled(relative_structure(testing::modal_model(skewed), "P"), process.frame, 0.0, 8000.0, 2.0);
  const FittedStructure whole = fitted_structure({lines, {}}, process.frame);
  StabilityOptions options;
  options.follow = 1.0;
  int missed = 0;
  for (const double missing_hz : {420.0, 660.0}) {
    const FittedStructure damaged = without_modes_near(whole, missing_hz, process.frame);
    ASSERT_LT(damaged.all.poles.poles.size(), whole.all.poles.poles.size());
    for (const double rpm : {2300.0, 4100.0, 5600.0, 7300.0, 9700.0}) {
      SCOPED_TRACE(std::to_string(missing_hz) + " Hz missing, " + std::to_string(rpm) + " rpm");
      const double true_m = limiting_depth(whole, process, rpm, options).limiting_depth_m;
      const LobeRow row = limiting_depth(damaged, process, rpm, options);
      if (row.status == StabilityStatus::data_insufficient) ++missed;
      EXPECT_LE(std::abs(row.limiting_depth_m - true_m), row.error_estimate * row.limiting_depth_m + 1e-3 * true_m);
      EXPECT_LT(row.limiting_depth_m, 1.02 * true_m);
      EXPECT_FALSE(row.at_limit && true_m < options.depth_limit_m);
    }
  }
  EXPECT_GE(missed, 3) << "the test leaves out modes that matter";
}

/// A tool from lines to 3 kHz, a part that has a mode at 5.2 kHz besides.
TEST(SampledStability, APartKeepsItsModesBeyondTheLinesOfTheTool) {
  const RelativeStructure tool = relative_structure(testing::modal_model(skewed), "P");
  const std::vector<testing::Mode> part_modes{{880.0, 0.01, 0.5, Eigen::Vector3d(0.3, 0.9, 0.0)},
                                              {5200.0, 0.004, 0.02, Eigen::Vector3d(0.1, 1.0, 0.2)}};
  const RelativeStructure part = relative_structure(testing::modal_model(part_modes), "P");
  const MillingProcess process = skewed_cut();
  const SampledReceptance lines = sampled(tool, process.frame, 0.0, 3000.0, 2.0);
  StabilityOptions options;
  options.follow = 1.0;
  int by_the_high_mode = 0;
  for (const double rpm : {2900.0, 4100.0, 5600.0, 9700.0}) {
    SCOPED_TRACE(rpm);
    const LobeRow mixed = limiting_depth(SampledStructure{lines, part}, process, rpm, options);
    const LobeRow by_poles = limiting_depth(sum(tool, part), process, rpm, options);
    EXPECT_EQ(by_poles.status, StabilityStatus::converged);
    EXPECT_NEAR(mixed.limiting_depth_m / by_poles.limiting_depth_m, 1.0,
                mixed.error_estimate + by_poles.error_estimate + 2e-5);
    EXPECT_LE(mixed.error_estimate, 1e-2);
    EXPECT_EQ(mixed.kind, by_poles.kind);
    EXPECT_NEAR(mixed.chatter_frequency_hz, by_poles.chatter_frequency_hz, 0.1);
    by_the_high_mode += by_poles.chatter_frequency_hz > 5000.0 ? 1 : 0;
  }
  EXPECT_GE(by_the_high_mode, 1) << "else the lines alone would do";
}

TEST(SampledStability, ARangeThatEndsEarlyCostsNothingWhereLinesAreExact) {
  const RelativeStructure structure = relative_structure(testing::modal_model(skewed), "P");
  const MillingProcess process = skewed_cut();
  StabilityOptions options;
  options.follow = 1.0;
  for (const double from_hz : {1.0, 150.0}) {
    for (const double to_hz : {1000.0, 1400.0, 2500.0, 6000.0}) {
      const SampledReceptance lines = sampled(structure, process.frame, from_hz, to_hz, 1.0);
      for (const double rpm : {2300.0, 4100.0, 5600.0}) {
        const LobeRow by_lines = limiting_depth(SampledStructure{lines, {}}, process, rpm, options);
        const LobeRow by_poles = limiting_depth(structure, process, rpm, options);
        EXPECT_NEAR(by_lines.limiting_depth_m / by_poles.limiting_depth_m, 1.0, 1e-9)
            << from_hz << " to " << to_hz << " Hz, " << rpm << " rpm";
        EXPECT_EQ(by_lines.status, StabilityStatus::converged);
      }
    }
  }
}

/// Cutters of all kinds: unequal pitches, process damping, helices, a ball.
std::vector<MillingProcess> all_kinds() {
  std::vector<MillingProcess> all(5, benchmark_process(0.1));
  all[1].cutter.pitches_rad = {3.0, 2.0 * std::numbers::pi - 3.0};
  all[2].damping.C = 1e4;
  all[3].cutter.helices_rad = {0.5, 0.5};
  all[4].cutter.envelope = ball_end(all[4].cutter.diameter_m);
  return all;
}

TEST(SampledStability, TheSumOverHarmonicsIsTheGainOfThePolesOnGridsOfAnyCutter) {
  // Close lines to 4 kHz, wider ones up to 100 kHz, beyond which the sum lacks O(1/f): the kernel has a kink where
  // response and force are at one node.
  SampledReceptance lines{Eigen::VectorXd(4001 + 3840), {}};
  lines.frequency_hz << Eigen::VectorXd::LinSpaced(4001, 0.0, 4000.0), Eigen::VectorXd::LinSpaced(3840, 4025.0, 1e5);
  for (const double hz : lines.frequency_hz)
    lines.H.push_back(receptance(benchmark_structure(), 2.0 * std::numbers::pi * hz));
  for (const MillingProcess& process : all_kinds()) {
    const CutAtSpeed cut = cut_at_speed(benchmark_structure(), process, 9000.0);
    const DiscreteCut d = discrete(cut, {2, 8}, 1.5e-3);
    const GainOnCircle by_poles = gain_of(d);
    const GainOnCircle by_lines = harmonic_gain(lines, d.grid, 9000.0);
    const double size = by_poles.Z(1.7).norm();
    for (const double theta : {0.0, 0.4, 1.7, std::numbers::pi})
      EXPECT_LT((by_lines.Z(theta) - by_poles.Z(theta)).norm(), 1e-3 * size) << theta << ", C " << process.damping.C;
  }
}

TEST(SampledStability, TheSlopeOfAGainBetweenTwoVectorsIsThatOfItsDifferences) {
  constexpr double h = 1e-5;
  const SampledReceptance lines = sampled(benchmark_structure(), {}, 20.0, 4000.0, 20.0);
  for (const MillingProcess& process : all_kinds()) {
    const CutAtSpeed cut = cut_at_speed(benchmark_structure(), process, 9000.0);
    const DiscreteCut d = discrete(cut, {2, 8}, 1.5e-3);
    for (const GainOnCircle& gain : {gain_of(d), harmonic_gain(lines, d.grid, 9000.0)}) {
      Eigen::VectorXcd l(gain.size), r(gain.size);
      for (Eigen::Index i = 0; i < gain.size; ++i) {
        l(i) = std::polar(1.0, 0.7 * static_cast<double>(i));
        r(i) = std::polar(1.0, 1.0 + 0.3 * static_cast<double>(i * i));
      }
      for (const double theta : {0.4, 1.7, 2.9}) {
        const Eigen::MatrixXcd difference = (gain.Z(theta + h) - gain.Z(theta - h)) / (2.0 * h);
        const std::complex<double> slope = gain.slope(theta, l, r);
        EXPECT_NEAR(std::abs(slope - (l.transpose() * difference * r).value()), 0.0, 1e-6 * std::abs(slope));
      }
    }
  }
}

TEST(SampledStability, TheGainOfALoopBetweenTwoVectorsIsThatOfItsMatrix) {
  for (const MillingProcess& process : all_kinds()) {
    const CutAtSpeed cut = cut_at_speed(benchmark_structure(), process, 9000.0);
    const DiscreteCut d = discrete(cut, {2, 8}, 1.5e-3);
    const Eigen::VectorXcd l = Eigen::VectorXcd::LinSpaced(d.loop.K.rows(), {1.0, 0.3}, {-0.4, 1.0});
    const Eigen::VectorXcd r = l.cwiseAbs2() + std::complex<double>(0.0, 1.0) * l.reverse();
    for (const std::complex<double> mu : {on_circle(1.7), on_circle(std::numbers::pi), {1.1, 0.4}}) {
      const std::complex<double> by_matrix = (l.transpose() * loop_gain(d.loop, mu) * r).value();
      EXPECT_NEAR(std::abs(loop_gain(d.loop, mu, l, r) - by_matrix), 0.0, 1e-12 * std::abs(by_matrix));
    }
  }
}

TEST(SampledStability, AnyCutterHasTheRowOfThePoles) {
  StabilityOptions options;
  options.follow = 1.0;
  options.depth_limit_m = 5e-3;
  for (const MillingProcess& process : all_kinds()) {
    const LobeRow by_lines = limiting_depth(benchmark_fit(), process, 9000.0, options);
    const LobeRow by_poles = limiting_depth(benchmark_structure(), process, 9000.0, options);
    EXPECT_EQ(by_lines.status, by_poles.status);
    EXPECT_NEAR(by_lines.limiting_depth_m / by_poles.limiting_depth_m, 1.0, 1e-9);
    EXPECT_NEAR(by_lines.error_estimate, by_poles.error_estimate, 1e-9);
  }
}

TEST(SampledStability, AMotionThatGrowsIsNamedAndTheChartIsThatOfTheLinesElsewhere) {
  // A growing motion at 200 Hz beside the benchmark's mode at 922 Hz, along x.
  const double rpm = 9000.0;
  SampledReceptance lines = sampled(benchmark_structure(), {}, 20.0, 4000.0, 1.0);
  EXPECT_FALSE(fitted_structure({lines, {}}, {}).growing);
  const std::complex<double> pole = 2.0 * std::numbers::pi * 200.0 * std::complex<double>(0.05, 1.0);
  for (std::size_t i = 0; i < lines.H.size(); ++i) {
    const std::complex<double> s(0.0, 2.0 * std::numbers::pi * lines.frequency_hz(static_cast<Eigen::Index>(i)));
    lines.H[i](0, 0) += 1e-6 * std::norm(pole) / ((s - pole) * (s - std::conj(pole)));
  }
  const FittedStructure fit = fitted_structure({lines, {}}, {});
  ASSERT_TRUE(fit.growing);
  EXPECT_LT(std::abs(*fit.growing - pole), 1e-6 * std::abs(pole));
  // This structure has that motion as it would decay, by its pole.
  RelativeStructure decaying = benchmark_structure();
  RelativeStructure motion{Eigen::VectorXcd::Constant(1, -std::conj(pole)), Eigen::Matrix3Xcd::Zero(3, 1),
                           Eigen::Matrix3Xcd::Zero(3, 1)};
  motion.phi(0, 0) = 1.0;
  motion.b(0, 0) = 1e-6 * std::norm(pole) / (pole - std::conj(pole));
  decaying = sum(decaying, motion);
  const MillingProcess process = benchmark_process(0.1);
  const LobeRow by_lines = limiting_depth(fit, process, rpm, {});
  const LobeRow by_poles = limiting_depth(decaying, process, rpm, {});
  EXPECT_NEAR(by_lines.limiting_depth_m / by_poles.limiting_depth_m, 1.0, 0.02 + by_lines.error_estimate);
}

TEST(SampledStability, ARangeThatIsTooNarrowNamesTheHarmonicAndWhatWouldDo) {
  const MillingProcess process = benchmark_process(0.1);
  // At 25000 rpm two teeth pass 833.3 times a second: 922 + 833.3 = 1755.3 Hz is needed.
  const SampledReceptance narrow = sampled(benchmark_structure(), {}, 20.0, 1500.0, 2.0);
  const std::string text = refusal([&] { (void)limiting_depth(SampledStructure{narrow, {}}, process, 25000.0, {}); });
  EXPECT_NE(text.find("1755.3"), std::string::npos) << text;
  EXPECT_NE(text.find("20 to 1500 Hz"), std::string::npos) << text;
  EXPECT_NE(text.find("measure from 20 to 1755.3"), std::string::npos) << text;
  EXPECT_NO_THROW(require_range(narrow, process, 12000.0));
  // A range that begins on the flank of the resonance has no static line: 922 − 333.3 = 588.7 Hz is missing.
  const SampledReceptance late = sampled(benchmark_structure(), {}, 700.0, 4000.0, 2.0);
  EXPECT_NE(refusal([&] { require_range(late, process, 10000.0); }).find("588.6"), std::string::npos);
  EXPECT_NO_THROW(require_range(late, process, 5000.0)) << "922 - 166.7 = 755.3 Hz is there";
  const SampledReceptance flank = sampled(benchmark_structure(), {}, 20.0, 900.0, 2.0);
  EXPECT_NE(refusal([&] { require_range(flank, process, 5000.0); }).find("no resonance"), std::string::npos);
}

TEST(SampledStability, RefusesABadSpeedAndAStructureThatIsStill) {
  EXPECT_NE(refusal([&] { (void)limiting_depth(benchmark_fit(), benchmark_process(0.1), 0.0, {}); }).find("0 rpm"),
            std::string::npos);
  SampledReceptance still = benchmark_lines();
  for (auto& H : still.H) H.topRows<2>().setZero();
  EXPECT_NE(refusal([&] {
              (void)limiting_depth(SampledStructure{still, {}}, benchmark_process(0.1), 5000.0, {});
            }),
            "");
}

TEST(SampledStability, StableToTheDepthLimitIsSaidWithTheMotionNearestToChatter) {
  StabilityOptions options;
  options.depth_limit_m = 2e-4;
  const MillingProcess process = benchmark_process(0.1);
  const LobeRow row = limiting_depth(benchmark_fit(), process, 5000.0, options);
  EXPECT_EQ(row.status, StabilityStatus::stable_to_depth_limit);
  EXPECT_TRUE(row.at_limit);
  EXPECT_EQ(row.limiting_depth_m, 2e-4);
  EXPECT_NEAR(row.chatter_frequency_hz, 922.0, 30.0);
}

TEST(SampledStability, NodeLimitIsAStatusWithTheErrorThatRemains) {
  StabilityOptions options;
  options.most_nodes = 8;
  options.error_tolerance = 1e-9;
  const LobeRow row = limiting_depth(benchmark_fit(), benchmark_process(0.1), 5000.0, options);
  EXPECT_EQ(row.status, StabilityStatus::node_limit_reached);
  EXPECT_GT(row.error_estimate, 1e-9);
}

TEST(SampledStability, ChartsDoNotDependOnTheNumberOfThreads) {
  const auto speeds = spindle_speeds(8000.0, 20000.0, 5);
  const int before = core::thread_count();
  core::set_thread_count(1);
  const Lobes one = stability_lobes(benchmark_fit(), benchmark_process(0.1), speeds, {});
  core::set_thread_count(3);
  const Lobes three = stability_lobes(benchmark_fit(), benchmark_process(0.1), speeds, {});
  core::set_thread_count(before);
  EXPECT_EQ(one.rows_not_converged, 0);
  for (std::size_t i = 0; i < speeds.size(); ++i)
    EXPECT_EQ(one.rows[i].limiting_depth_m, three.rows[i].limiting_depth_m);
  EXPECT_THROW((void)stability_lobes(benchmark_fit(), benchmark_process(0.1), {}, {}), core::InputError);
}

/// Multiplicative noise of a standard deviation, real and imaginary part alike.
SampledReceptance with_noise(SampledReceptance r, double deviation) {
  std::mt19937 engine(7);
  std::normal_distribution<double> normal(0.0, deviation);
  for (auto& H : r.H) H *= std::complex<double>(1.0 + normal(engine), normal(engine));
  return r;
}

TEST(SampledStability, NoiseOfAPerCentMovesTheLimitByPerCents) {
  // A line's noise moves 1/H, and the depth with it, by as much: three deviations, as the lines that decide are few.
  const SampledReceptance noisy = with_noise(sampled(benchmark_structure(), {}, 20.0, 5000.0, 1.0), 0.01);
  for (const Reference& row : references("wcrit_mm")) {
    if (row.immersion != 0.1) continue;
    const LobeRow found = limiting_depth(SampledStructure{noisy, {}}, benchmark_process(0.1), row.rpm, {});
    EXPECT_NEAR(found.limiting_depth_m / row.depth_m, 1.0, 0.03) << row.where();
  }
}

TEST(Passivity, ANoisyPassiveReceptanceGivesNoEnergyAndAConjugateOneDoes) {
  const SampledReceptance good = sampled(benchmark_structure(), {}, 2.0, 4000.0, 2.0);
  EXPECT_FALSE(energy_given(good));
  EXPECT_FALSE(energy_given(with_noise(good, 0.03)));
  SampledReceptance conjugate = good;
  for (auto& H : conjugate.H) H = H.conjugate().eval();
  const auto given = energy_given(conjugate);
  ASSERT_TRUE(given);
  EXPECT_EQ(given->direction, 0);
  EXPECT_NEAR(given->frequency_hz, 922.0, 2.0);
  EXPECT_NEAR(given->share, 1.0, 0.02);
  // A mobility that is read as a receptance: iωH has a positive imaginary part below the resonance.
  SampledReceptance mobility = good;
  for (std::size_t i = 0; i < good.H.size(); ++i)
    mobility.H[i] *= std::complex<double>(0.0, good.frequency_hz(static_cast<Eigen::Index>(i)));
  ASSERT_TRUE(energy_given(mobility));
  EXPECT_LT(energy_given(mobility)->frequency_hz, 922.0);
}

TEST(Resonances, AreFoundOnceAndNoiseIsNone) {
  const RelativeStructure structure = relative_structure(testing::modal_model(skewed), "P");
  for (const double noise : {0.0, 0.02}) {
    const auto found = resonances(with_noise(sampled(structure, {}, 10.0, 3000.0, 1.0), noise));
    ASSERT_EQ(found.size(), 2u);
    EXPECT_NEAR(found[0].frequency_hz, 420.0, 6.0);
    EXPECT_NEAR(found[1].frequency_hz, 660.0, 6.0);
    EXPECT_NEAR(found[0].half_width_hz, 0.03 * 420.0, 3.0);
  }
}

}  // namespace
}  // namespace thinwall::milling::sampled_stability_test
