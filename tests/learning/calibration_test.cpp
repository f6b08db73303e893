// Calibrations from cuts of synthetic machines, against the machines' true parameters.

#include "learning/calibration.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "learning/interpolated_cuts.hpp"
#include "learning/next_cut.hpp"
#include "milling/direct/stability.hpp"
#include "tests/learning/synthetic.hpp"

namespace thinwall::learning::calibration_test {
namespace {

using testing::drawn_machine;
using testing::Machine;

double limit_of(const milling::Cut& cut, double rpm, milling::StabilityOptions options) {
  options.follow = 1.0;
  return milling::limiting_depth(cut.structure, cut.process, rpm, options).limiting_depth_m;
}

TEST(CutLikelihood, HasTheGradientOfItsOwnDifferences) {
  const Machine machine = drawn_machine(3, 12);
  CutModel model = machine.model;
  model.cuts[1].outcome = milling::CutOutcome::marginal;
  Eigen::VectorXd x = Eigen::VectorXd::Constant(9, 0.2);
  const auto value = [&](const Eigen::VectorXd& at) {
    return log_posterior(model, predict(model, at.head(8), false), at);
  };
  const PosteriorSlope slope = posterior_slope(model, predict(model, x.head(8), true), x);
  for (Eigen::Index i = 0; i < 9; ++i) {
    const Eigen::VectorXd h = 1e-4 * Eigen::VectorXd::Unit(9, i);
    const double by = (value(x + h) - value(x - h)) / 2e-4;
    EXPECT_NEAR(slope.gradient(i), by, 1e-3 * std::max(1.0, std::abs(by))) << i;
  }
}

TEST(CutLikelihood, GivesAMarginalCutItsHighestProbabilityOnTheBoundary) {
  Machine machine = drawn_machine(4, 1);
  machine.model.cuts[0] = {6000.0, 1e-3, milling::CutOutcome::marginal};
  const Eigen::VectorXd x = Eigen::VectorXd::Zero(9);
  const auto value = [&](double margin) {
    return log_posterior(machine.model, {Eigen::VectorXd::Constant(1, margin), Eigen::VectorXd::Zero(1), {}, {}}, x);
  };
  EXPECT_NEAR(value(0.0), std::log(0.5), 1e-12);
  EXPECT_LT(value(0.2), value(0.0));
  EXPECT_NEAR(value(0.2), value(-0.2), 1e-12);
}

TEST(CutLikelihood, GivesTheThreeAnswersProbabilitiesThatAddUpToOne) {
  CutModel model = drawn_machine(4, 1).model;
  const Eigen::VectorXd x = Eigen::VectorXd::Zero(9);
  for (const double margin : {-0.7, -0.05, 0.0, 0.4}) {
    double sum = 0.0;
    for (const auto outcome :
         {milling::CutOutcome::stable, milling::CutOutcome::chatter, milling::CutOutcome::marginal}) {
      // The second cut makes the third answer possible; its own term is taken off.
      model.cuts = {{6000.0, 1e-3, outcome}, {6000.0, 1e-3, milling::CutOutcome::marginal}};
      Eigen::VectorXd margins(2);
      margins << margin, 0.0;
      sum += std::exp(log_posterior(model, {margins, Eigen::VectorXd::Zero(2), {}, {}}, x) - std::log(0.5));
    }
    EXPECT_NEAR(sum, 1.0, 1e-12) << margin;
  }
}

/// The machine with a stiff mode of 12 Hz besides, as that of an arm or a floor, whose parameters are known.
Machine on_soft_ground(Machine machine) {
  constexpr double omega = 2.0 * std::numbers::pi * 12.0;
  milling::Cut& cut = machine.model.nominal;
  const milling::Cut alone = cut;
  cut.structure = milling::relative_structure(
      milling::testing::modal_model({{780.0, 0.0184, 0.27, Eigen::Vector3d::UnitX()},
                                     {750.0, 0.0186, 0.22, Eigen::Vector3d::UnitY()},
                                     {12.0, 0.01, 2e8 / (omega * omega), Eigen::Vector3d::UnitX()}}),
      "P");
  machine.model.parameters = milling::uncertain_parameters(cut, {0.03, 0.2, 0.1, 0.15});
  return machine;
}

TEST(Calibration, IsNotChangedByASlowModeThatTheCutDoesNotFeel) {
  const Machine plain = drawn_machine(6, 30), soft = on_soft_ground(plain);
  const Likeliest a = likeliest(plain.model), b = likeliest(soft.model);
  // The slow mode has three parameters behind the six of the tool, before K_t, K_r and the noise.
  Eigen::VectorXd without(a.x.size());
  without << b.x.head(6), b.x.tail(3);
  EXPECT_LT((without - a.x).norm(), 0.01) << without.transpose() << "\n" << a.x.transpose();
  EXPECT_LT(b.x.segment(6, 3).norm(), 0.01);
  EXPECT_NEAR(b.log_posterior, a.log_posterior, 0.02);
}

TEST(CutLikelihood, HasMarginsThatASlowModeDoesNotChangeWhereverItsFrequencyIs) {
  const Machine plain = drawn_machine(6, 30), soft = on_soft_ground(plain);
  Eigen::VectorXd z = Eigen::VectorXd::Zero(11);
  z.segment(6, 3) << 1.5, -1.0, 0.5;
  const Eigen::VectorXd expected = predict(plain.model, Eigen::VectorXd::Zero(8), false).margin;
  EXPECT_LT((predict(soft.model, z, false).margin - expected).cwiseAbs().maxCoeff(), 0.01);
}

TEST(Calibration, LearnsNothingFromCutsThatAreCertain) {
  Machine machine = drawn_machine(5, 1);
  machine.model.cuts = {{6000.0, 1e-6, milling::CutOutcome::stable}};
  machine.model.noise_median = 0.02;
  const Likeliest found = likeliest(machine.model);
  EXPECT_TRUE(found.converged);
  EXPECT_LT(found.x.norm(), 1e-3);
  EXPECT_LT((found.covariance - Eigen::MatrixXd::Identity(9, 9)).norm(), 1e-3);
}

TEST(Calibration, CoversTheTruthAndHalvesTheErrorOfTheLimit) {
  // Ten machines of eight parameters: of 80 intervals of 95 % some 76 hold the truth; 72 is two deviations less.
  int covered = 0;
  double before = 0.0, after = 0.0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const Machine machine = drawn_machine(seed, 30);
    const Likeliest found = likeliest(machine.model);
    EXPECT_TRUE(found.converged) << seed;
    for (Eigen::Index p = 0; p < machine.truth.size(); ++p)
      covered += std::abs(machine.truth(p) - found.x(p)) <= 1.96 * std::sqrt(found.covariance(p, p)) ? 1 : 0;
    const auto cut_at = [&](const Eigen::VectorXd& z) {
      return milling::cut_at(machine.model.nominal, machine.model.parameters, z);
    };
    const milling::Cut exact = cut_at(machine.truth), learned = cut_at(found.x.head(machine.truth.size()));
    for (double rpm = 5200.0; rpm < 13000.0; rpm += 2600.0) {
      const double limit = limit_of(exact, rpm, machine.model.options);
      before += std::abs(std::log(limit_of(machine.model.nominal, rpm, machine.model.options) / limit));
      after += std::abs(std::log(limit_of(learned, rpm, machine.model.options) / limit));
    }
  }
  EXPECT_GE(covered, 72);
  EXPECT_LE(covered, 79);
  EXPECT_LT(after, 0.5 * before);
}

TEST(Calibration, LearnsHowCoefficientsFallWithTheSpeed) {
  // Three machines with exponents drawn with a deviation of 0.5: nearer to the truth than 0, which is what is known
  // beforehand, and no further off than three deviations, where one in 370 is.
  double before = 0.0, after = 0.0;
  for (const unsigned seed : {1U, 2U, 3U}) {
    const Machine machine = drawn_machine(seed, 40, 0.5);
    const Eigen::Index exponent = std::ssize(machine.model.parameters) - 1;
    const Likeliest found = likeliest(machine.model);
    const double off = found.x(exponent) - machine.truth(exponent);
    EXPECT_LT(std::abs(off), 3.0 * std::sqrt(found.covariance(exponent, exponent))) << "seed " << seed;
    before += std::pow(machine.truth(exponent), 2);
    after += off * off;
  }
  EXPECT_LT(after, before);
}

TEST(Calibration, HasChainsThatMixAndAgreeWithTheNormalDistribution) {
  const Machine machine = drawn_machine(4, 30);
  ChainOptions options;
  options.draws = 100;
  options.left_out = 20;
  const Calibration learned = calibrate(machine.model, options);
  EXPECT_LT(learned.worst_r_hat, 1.1);
  EXPECT_GT(learned.least_effective_size, 40.0);
  EXPECT_GT(learned.chains.accepted, 0.5);
  for (const LearnedParameter& p : learned.parameters) {
    // The normal distribution about the likeliest x is near, not equal.
    EXPECT_NEAR(p.mean, p.laplace_mean, 0.6);
    EXPECT_NEAR(p.deviation / p.laplace_deviation, 1.0, 0.5);
  }
}

TEST(Calibration, NamesTheCutThatContradictsTheOthers) {
  Machine machine = drawn_machine(2, 30);
  const auto deepest = std::ranges::max_element(machine.model.cuts, {}, [](const milling::ObservedCut& cut) {
    return cut.outcome == milling::CutOutcome::chatter ? cut.depth_m : 0.0;
  });
  deepest->outcome = milling::CutOutcome::stable;
  deepest->chatter_frequency_hz.reset();
  ChainOptions options;
  options.draws = 60;
  const Calibration learned = calibrate(machine.model, options);
  const auto index = static_cast<std::size_t>(deepest - machine.model.cuts.begin());
  const auto least = std::ranges::max_element(learned.cuts, {}, [](const LearnedCut& cut) {
    return cut.cut.outcome == milling::CutOutcome::stable ? cut.chatter_probability : 0.0;
  });
  EXPECT_EQ(static_cast<std::size_t>(least - learned.cuts.begin()), index);
}

TEST(Calibration, RefusesAModelWithoutCutsOrUncertainty) {
  Machine machine = drawn_machine(1, 2);
  CutModel certain = machine.model;
  certain.parameters.clear();
  EXPECT_THROW((void)likeliest(certain), core::InputError);
  machine.model.cuts.clear();
  EXPECT_THROW((void)likeliest(machine.model), core::InputError);
}

TEST(InterpolatedCuts, AreThePredictionAtTheirPlacesAndNearItBetween) {
  const Machine machine = drawn_machine(4, 12);
  std::mt19937 random(5);
  std::vector<Eigen::VectorXd> places;
  for (int i = 0; i < 150; ++i) places.push_back(0.5 * milling::standard_normal(8, random));
  InterpolatedCuts cuts(machine.model, {places.begin(), places.end() - 30});
  cuts.add(machine.model, places);  // 120 of them once more
  for (const std::size_t i : {0u, 130u}) {
    const PredictedCuts exact = predict(machine.model, places[i], false), found = cuts(places[i]);
    EXPECT_LT((found.margin - exact.margin).cwiseAbs().maxCoeff(), 1e-8);
    for (Eigen::Index k = 0; k < 12; ++k) {
      if (!machine.model.cuts[static_cast<std::size_t>(k)].chatter_frequency_hz) continue;
      EXPECT_NEAR(found.frequency_hz(k), exact.frequency_hz(k), 1e-6);
    }
  }
  // Between them it is off by a small part of what the margins change.
  double error = 0.0, change = 0.0;
  const Eigen::VectorXd middle = predict(machine.model, Eigen::VectorXd::Zero(8), false).margin;
  for (int i = 0; i < 20; ++i) {
    const Eigen::VectorXd z = 0.5 * milling::standard_normal(8, random);
    const Eigen::VectorXd exact = predict(machine.model, z, false).margin;
    error += (cuts(z).margin - exact).squaredNorm();
    change += (middle - exact).squaredNorm();
  }
  EXPECT_LT(error, 0.05 * change);
  EXPECT_THROW(InterpolatedCuts(machine.model, {places.begin(), places.begin() + 44}), core::InputError);
}

TEST(NextCut, LeavesOutCandidatesWhoseProbabilityIsNotANumber) {
  const Machine machine = drawn_machine(4, 3);
  Calibration learned;
  learned.model = machine.model;
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  learned.draws = {Eigen::VectorXd::Zero(9), Eigen::VectorXd::Constant(9, 0.1)};
  learned.draws[1](8) = unknown;  // the noise, and with it the probability of this draw
  const std::vector<milling::OperatingPoint> shallow{{9000.0, 1e-6}, {9500.0, 1e-6}};
  EXPECT_FALSE(most_productive_cut(learned, 2, shallow, 0.1));
  EXPECT_FALSE(next_cut_for_best_speed(learned, {9000.0, 9500.0}, shallow));
  EXPECT_EQ(best_speed_rpm({1.0, 2.0}, {unknown, 1e-3}), 2.0);
}

TEST(NextCut, TellsThatMostDrawsHaveNoBestSpeed) {
  Calibration learned;
  learned.model = drawn_machine(4, 3).model;
  learned.draws = {Eigen::VectorXd::Zero(9), Eigen::VectorXd::Constant(9, 0.1), Eigen::VectorXd::Constant(9, 0.2)};
  const std::vector<milling::OperatingPoint> candidates{{9000.0, 1e-3}};
  EXPECT_THROW((void)next_cut_for_best_speed(learned, {9000.0, std::nullopt, std::nullopt}, candidates),
               core::NumericalError);
  EXPECT_THROW((void)next_cut_for_best_speed(learned, std::vector<std::optional<double>>(4, 9000.0), candidates),
               core::InputError);
}

TEST(NextCut, LeavesOutRowsWithoutAnAnswer) {
  milling::LobeRow row;
  row.limiting_depth_m = 1e-3;
  for (const auto status : {milling::StabilityStatus::converged, milling::StabilityStatus::node_limit_reached,
                            milling::StabilityStatus::data_limited, milling::StabilityStatus::stable_to_depth_limit}) {
    row.status = status;
    EXPECT_EQ(answered_limit_m(row), 1e-3) << milling::name(status);
  }
  for (const auto status : {milling::StabilityStatus::crossing_missed, milling::StabilityStatus::data_insufficient}) {
    row.status = status;
    EXPECT_FALSE(answered_limit_m(row)) << milling::name(status);
  }
  row.status = milling::StabilityStatus::converged;
  for (const double depth : {0.0, -1e-3, std::numeric_limits<double>::quiet_NaN()}) {
    row.limiting_depth_m = depth;
    EXPECT_FALSE(answered_limit_m(row)) << depth;
  }
}

TEST(NextCut, NarrowsTheLimitMostAndNeverWidensIt) {
  const Machine machine = drawn_machine(6, 6);
  ChainOptions options;
  options.draws = 60;
  const Calibration learned = calibrate(machine.model, options);
  std::vector<milling::OperatingPoint> candidates{
      {9000.0, 1e-6}};  // tells next to nothing: it is stable whatever the truth
  const NextCut useless = next_cut(learned, 40, 9000.0, candidates).value();
  EXPECT_NEAR(useless.deviation_after, useless.deviation_before, 0.01 * useless.deviation_before);
  for (double depth = 1e-4; depth < 2e-3; depth += 1e-4) candidates.push_back({9000.0, depth});
  const NextCut best = next_cut(learned, 40, 9000.0, candidates).value();
  EXPECT_LT(best.deviation_after, 0.9 * best.deviation_before);
  EXPECT_GT(best.chatter_probability, 0.1);
  EXPECT_LE(best.chatter_probability, 0.6);
  EXPECT_FALSE(next_cut(learned, 40, 9000.0, {{9000.0, 3e-3}}));  // chatters with near certainty
  // Of the candidates the most productive one is the deepest that is safe enough, and deeper where more is risked.
  const NextCut safe = most_productive_cut(learned, 40, candidates, 0.1).value();
  const NextCut bold = most_productive_cut(learned, 40, candidates, 0.5).value();
  EXPECT_LE(safe.chatter_probability, 0.1);
  EXPECT_LE(bold.chatter_probability, 0.5);
  EXPECT_GT(bold.point.depth_m, safe.point.depth_m);
  EXPECT_FALSE(most_productive_cut(learned, 40, {{9000.0, 3e-3}}, 0.1));
  EXPECT_THROW((void)most_productive_cut(learned, 40, candidates, 1.5), core::InputError);
}

TEST(NextCut, HasTheExpectedVarianceOfTwoOutcomes) {
  // Four draws of y = 0, 0, 1, 1: a cut that chatters with the last two alone leaves no variance, one that does not
  // tell them apart leaves all of it, and one that chatters with the last draw leaves that of 0, 0, 1 in three of four.
  Eigen::MatrixXd chatter(4, 3);
  chatter << 0.0, 0.5, 0.0, 0.0, 0.5, 0.0, 1.0, 0.5, 0.0, 1.0, 0.5, 1.0;
  const Eigen::VectorXd after =
      expected_variances(chatter, Eigen::Vector4d(0.0, 0.0, 1.0, 1.0), Eigen::Vector4d::Constant(0.25));
  EXPECT_NEAR(after(0), 0.0, 1e-15);
  EXPECT_NEAR(after(1), 0.25, 1e-15);
  EXPECT_NEAR(after(2), 0.75 * (2.0 / 9.0), 1e-15);
  EXPECT_EQ(best_speed_rpm({1.0, 2.0, 3.0}, {3e-3, 2e-3, std::nullopt}), 2.0);
  EXPECT_FALSE(best_speed_rpm({1.0}, {std::nullopt}));
}

}  // namespace
}  // namespace thinwall::learning::calibration_test
