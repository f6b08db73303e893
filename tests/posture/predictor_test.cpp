// Modes between postures, their bands, and where to measure next.

#include "posture/predictor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/error.hpp"
#include "posture/bands.hpp"
#include "posture/calibration.hpp"
#include "posture/hull.hpp"
#include "posture/mode_targets.hpp"
#include "posture/next_posture.hpp"
#include "tests/posture/arm_with_truth.hpp"

namespace thinwall::posture::predictor_test {
namespace {

/// Against the closed forms of a triangle's corner, edge and inside, and of a random place beyond a face of a cube.
TEST(DistanceFromHull, IsThatToCornerEdgeAndFace) {
  Eigen::MatrixXd triangle(3, 2);
  triangle << 0, 0, 2, 0, 0, 2;
  EXPECT_NEAR(distance_from_hull(triangle, Eigen::Vector2d(-3, -4)), 5.0, 1e-12);
  EXPECT_NEAR(distance_from_hull(triangle, Eigen::Vector2d(2, 2)), std::numbers::sqrt2, 1e-12);
  EXPECT_NEAR(distance_from_hull(triangle, Eigen::Vector2d(1, -0.5)), 0.5, 1e-12);
  EXPECT_EQ(distance_from_hull(triangle, Eigen::Vector2d(0.5, 0.7)), 0.0);
  Eigen::MatrixXd cube(9, 3);
  for (int i = 0; i < 8; ++i) cube.row(i) << (i & 1), (i >> 1 & 1), (i >> 2 & 1);
  cube.row(8).setConstant(0.5);
  EXPECT_NEAR(distance_from_hull(cube, Eigen::Vector3d(0.3, 0.8, 1.7)), 0.7, 1e-12);
  EXPECT_THROW((void)distance_from_hull(cube, Eigen::Vector2d(0, 0)), core::InputError);
}

TEST(ModeTargets, ComeBackAsTheMode) {
  const TappedArm tapped = testing::elbow_arm();
  for (const identification::FittedMode& mode :
       as_identified(arm_modes(tapped.arm, testing::elbow_posture({0.2, 0.3, -0.5})), tapped)) {
    const identification::FittedMode again = mode_of(targets_of(mode), 4);
    EXPECT_NEAR(again.frequency_hz, mode.frequency_hz, 1e-10 * mode.frequency_hz);
    EXPECT_NEAR(again.damping_ratio, mode.damping_ratio, 1e-10);
    EXPECT_LT((again.residue - mode.residue).norm(), 1e-10 * mode.residue.norm());
    EXPECT_LT((again.right * again.left.transpose() - mode.residue).norm(), 1e-10 * mode.residue.norm());
  }
  identification::FittedMode growing;
  growing.frequency_hz = 10.0;
  growing.damping_ratio = -0.01;
  growing.residue = Eigen::MatrixXcd::Ones(1, 1);
  EXPECT_THROW((void)targets_of(growing), core::InputError);
}

/// Fewer draws than by default, which are quicker and do here.
PredictorOptions plain() {
  PredictorOptions options;
  options.averaging.samples = 16;
  return options;
}

PredictorOptions with_mean(const TappedArm& arm) {
  PredictorOptions options = plain();
  options.mean = arm;
  return options;
}

/// With the true arm as the mean nothing is left to learn: every mode at every place is that of the arm.
TEST(Predictor, IsTheModelWhereTheModelIsTrue) {
  const TappedArm truth = testing::true_arm();
  const Predictor predictor(testing::tapped_postures(truth, testing::spread_places(6, 1)), with_mean(truth));
  for (const TappedPosture& there : testing::tapped_postures(truth, testing::spread_places(4, 2))) {
    const PosturePrediction at = predictor.predict(there.place);
    ASSERT_EQ(at.modes.size(), there.modes.size());
    for (std::size_t k = 0; k < there.modes.size(); ++k) {
      const auto mode = std::ranges::find(at.modes, there.label[k], &PredictedMode::label);
      ASSERT_NE(mode, at.modes.end());
      EXPECT_NEAR(mode->mean(0), std::log(there.modes[k].frequency_hz), 1e-9);
      EXPECT_NEAR(mode->mean(1), std::log(there.modes[k].damping_ratio), 1e-8);
    }
    EXPECT_LT((receptance(expected_modes(at), 20.0) - receptance(there.modes, 20.0)).norm(),
              1e-7 * receptance(there.modes, 20.0).norm());
  }
}

/// An arm whose gearboxes soften with the weight that they carry, which no constant stiffness can follow.
TappedArm softened(TappedArm arm, const Eigen::VectorXd& q) {
  arm.arm.links[1].joint.stiffness *= 1.0 + 0.08 * std::sin(3.0 * q(1));
  arm.arm.links[4].joint.stiffness *= 1.0 + 0.05 * std::cos(2.0 * q(4));
  return arm;
}

std::vector<TappedPosture> softened_postures(const std::vector<Eigen::Vector3d>& places) {
  std::vector<TappedPosture> postures;
  for (const Eigen::Vector3d& u : places)
    postures.push_back(testing::tapped_postures(softened(testing::true_arm(), testing::elbow_posture(u)), {u}).front());
  return postures;
}

double mean_frequency_error(const Predictor& predictor, const std::vector<TappedPosture>& truth) {
  double sum = 0.0;
  int count = 0;
  for (const TappedPosture& there : truth) {
    for (const PredictedMode& mode : predictor.predict(there.place).modes) {
      for (std::size_t k = 0; k < there.modes.size(); ++k) {
        if (there.label[k] != mode.label) continue;
        sum += std::abs(mode.mean(0) - std::log(there.modes[k].frequency_hz));
        ++count;
      }
    }
  }
  return sum / count;
}

/// Seven postures: the calibrated model with a process beats the model alone, which beats a plain process.
TEST(Predictor, LearnsFasterFromTheDifferenceToACalibratedModel) {
  const auto postures = softened_postures(testing::spread_places(7, 11));
  const auto truth = softened_postures(testing::spread_places(20, 12));
  TappedArm calibrated = testing::elbow_arm();
  calibrated.arm = calibrate(calibrated, postures).arm;
  const double without = mean_frequency_error(Predictor(postures, plain()), truth);
  const double residual = mean_frequency_error(Predictor(postures, with_mean(calibrated)), truth);
  EXPECT_LT(residual, 0.3 * without);
  double alone = 0.0, count = 0.0;
  for (const TappedPosture& there : truth) {
    const auto model = as_identified(arm_modes(calibrated.arm, there.place.q), calibrated);
    const std::vector<int> pair = paired(there.modes, model);
    for (std::size_t k = 0; k < pair.size(); ++k, count += 1.0)
      alone += std::abs(std::log(there.modes[k].frequency_hz / model[static_cast<std::size_t>(pair[k])].frequency_hz));
  }
  EXPECT_LT(residual, alone / count);
}

/// Of 30 places × 5 modes 95 % are covered to within three standard errors of a share (0.018), places taken as
/// independent; they are not quite, and more is no fault.
TEST(Predictor, CoversFrequenciesWithFewPostures) {
  TappedArm calibrated = testing::elbow_arm();
  const auto postures = softened_postures(testing::spread_places(8, 21));
  calibrated.arm = calibrate(calibrated, postures).arm;
  const Predictor predictor(postures, with_mean(calibrated));
  int covered = 0, all = 0;
  for (const TappedPosture& there : softened_postures(testing::spread_places(30, 22))) {
    for (const PredictedMode& mode : predictor.predict(there.place).modes) {
      for (std::size_t k = 0; k < there.modes.size(); ++k) {
        if (there.label[k] != mode.label) continue;
        covered += std::abs(mode.mean(0) - std::log(there.modes[k].frequency_hz)) <= 1.96 * mode.deviation(0);
        ++all;
      }
    }
  }
  EXPECT_GE(covered, 0.89 * all);
}

/// A mode fixed to the tip turns with it: its residue in the world changes, that in the tip's frame does not, and so it
/// is known at once at all postures.
TEST(Predictor, SeesModesOfTheSpindleInTheTipsFrame) {
  const TappedArm arm = testing::elbow_arm();
  identification::FittedMode fixed;
  fixed.frequency_hz = 800.0;
  fixed.damping_ratio = 0.04;
  fixed.residue = Eigen::MatrixXcd::Zero(4, 4);
  fixed.residue(0, 0) = {0.0, -1e-5};
  const auto seen_at = [&](const Place& place) {
    identification::FittedMode mode = turned(fixed, back(place.turn));
    mode.left = mode.right = Eigen::VectorXcd::Ones(4);
    return mode;
  };
  std::vector<TappedPosture> postures;
  for (const Eigen::Vector3d& u : testing::spread_places(5, 31)) {
    const Place place = testing::place_of(arm, u);
    postures.push_back({place, {seen_at(place)}, {0}});
  }
  const Predictor predictor(postures, plain());
  const Place place = testing::place_of(arm, {0.1, -0.2, 0.9});
  const identification::FittedMode expected = expected_modes(predictor.predict(place)).front();
  EXPECT_LT((expected.residue - seen_at(place).residue).norm(), 1e-6 * fixed.residue.norm());
  Place without = place;
  without.turn = {};
  EXPECT_THROW((void)predictor.predict(without), core::InputError);
}

TEST(Predictor, TellsOfExtrapolationAndOfModesWithTooFewPostures) {
  const TappedArm truth = testing::true_arm();
  auto postures = testing::tapped_postures(truth, testing::spread_places(6, 1));
  postures[0].modes.push_back(postures[0].modes[0]);
  postures[0].label.push_back(17);
  const Predictor predictor(postures, plain());
  EXPECT_EQ(predictor.left_out(), std::vector<int>{17});
  EXPECT_EQ(predictor.labels(), (std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_EQ(predictor.predict(postures[2].place).from_hull, 0.0);
  const Eigen::Vector3d far(9.0, 0.0, 0.0);
  EXPECT_GT(predictor.predict({far, postures[0].place.q, postures[0].place.turn}).from_hull, 8.0);
  postures[3].place = postures[2].place;
  EXPECT_THROW(Predictor(postures, plain()), core::InputError);
  postures[3].place.at.resize(2);
  EXPECT_THROW(Predictor(postures, plain()), core::InputError);
  postures = testing::tapped_postures(truth, testing::spread_places(6, 1));
  postures[2].place.turn = {};
  EXPECT_THROW(Predictor(postures, plain()), core::InputError);
  postures = testing::tapped_postures(truth, testing::spread_places(6, 1));
  postures[1].rest = Eigen::Matrix2d::Identity();
  EXPECT_THROW(Predictor(postures, plain()), core::InputError);
  postures = testing::tapped_postures(truth, testing::spread_places(6, 1));
  postures[3].label.pop_back();
  EXPECT_THROW(Predictor(postures, plain()), core::InputError);
}

PosturePrediction one_mode(double deviation) {
  PosturePrediction at{1, {{0, Eigen::Vector4d(std::log(50.0), std::log(0.03), 0.02, 0.0), {}}}};
  at.modes[0].deviation = Eigen::Vector4d(deviation, 5.0 * deviation, 0.02 * deviation, 0.0);
  return at;
}

/// Far below the resonance of one mode H = A/ω₀², so that its relative deviation is that of A and twice that of f.
TEST(FrfBand, IsThatOfAStaticDeflection) {
  const double deviation = 0.01;
  const FrfBand band = frf_band(one_mode(deviation), {0.01});
  EXPECT_NEAR(band.deviation[0](0).real() / band.mean[0](0).real(), deviation * std::sqrt(5.0), 1e-3 * deviation);
}

/// First order and draws agree for small deviations: the standard error of a deviation from 4000 draws is 1.1 %.
TEST(FrfBand, IsTheSameToFirstOrderAndFromDraws) {
  const PosturePrediction at = one_mode(0.002);
  const std::vector<double> hz = {20.0, 48.0, 50.0, 53.0, 90.0};
  const FrfBand first = frf_band(at, hz), drawn = frf_band_from_draws(at, hz, 4000);
  for (std::size_t k = 0; k < hz.size(); ++k) {
    EXPECT_NEAR(drawn.deviation[k](0).real(), first.deviation[k](0).real(), 0.05 * std::abs(first.deviation[k](0)));
    EXPECT_NEAR(drawn.deviation[k](0).imag(), first.deviation[k](0).imag(), 0.05 * std::abs(first.deviation[k](0)));
  }
}

/// The rest that the modes leave out is fixed to the tip here: it turns with it, and its known value is added to the
/// receptance.
TEST(Predictor, AddsWhatTheModesLeaveOut) {
  const TappedArm truth = testing::true_arm();
  auto postures = testing::tapped_postures(truth, testing::spread_places(6, 1));
  const Eigen::MatrixXd fixed = Eigen::Vector4d(4e-9, 1e-9, 2e-9, 1e-9).asDiagonal();
  const auto in_world = [&](const Place& place) -> Eigen::MatrixXd {
    return place.turn.responses.transpose() * fixed * place.turn.references;
  };
  for (std::size_t i = 0; i < 3; ++i) postures[i].rest = in_world(postures[i].place);
  const Place place = testing::place_of(truth, {0.3, 0.1, -0.6});
  const PosturePrediction at = Predictor(postures, plain()).predict(place);
  EXPECT_LT((at.rest - in_world(place)).norm(), 1e-12 * fixed.norm());
  EXPECT_LT(at.rest_deviation.norm(), 1e-9 * fixed.norm());
  PosturePrediction without = at;
  without.rest.resize(0, 0);
  const Eigen::MatrixXcd added = frf_band(at, {30.0}).mean[0] - frf_band(without, {30.0}).mean[0];
  EXPECT_LT((added - in_world(place)).norm(), 1e-9 * fixed.norm());
}

/// Two modes of rank two: apart, each becomes its nearest one of rank one; together, their sum stays as predicted.
TEST(ExpectedModes, KeepTheSumOfResiduesWhereModesOverlap) {
  identification::FittedMode mode;
  mode.damping_ratio = 0.03;
  mode.residue.resize(2, 2);
  mode.residue << std::complex<double>(0.0, -2.0), 0.0, 0.0, std::complex<double>(0.0, -0.5);
  for (const double second : {102.0, 140.0}) {
    PosturePrediction at{2, {}};
    for (const double hz : {100.0, second}) {
      mode.frequency_hz = hz;
      at.modes.push_back({0, targets_of(mode), Eigen::VectorXd::Zero(10)});
    }
    for (const auto& modes : {expected_modes(at), drawn_modes(at, 1).front()}) {
      for (const identification::FittedMode& found : modes) {
        EXPECT_NEAR(std::abs(found.residue(0, 0)), 2.0, 1e-12);
        EXPECT_NEAR(std::abs(found.residue(1, 1)), second < 120.0 ? 0.5 : 0.0, 1e-12);
      }
    }
  }
}

/// Two modes whose errors at every posture were opposite err oppositely in every draw, by half of their deviations
/// where the residuals are halves; 3 % is the standard error of a deviation from 600 draws.
TEST(DrawnModes, ErrAsTheirResidualsDid) {
  PosturePrediction at = one_mode(0.01);
  at.modes.push_back(at.modes.front());
  at.modes[0].residuals = Eigen::MatrixXd::Zero(4, 30);
  for (Eigen::Index i = 0; i < 30; ++i) at.modes[0].residuals(0, i) = i % 2 == 0 ? 0.5 : -0.5;
  at.modes[1].residuals = -at.modes[0].residuals;
  double square = 0.0;
  for (const auto& modes : drawn_modes(at, 600)) {
    const double first = std::log(modes[0].frequency_hz / 50.0), second = std::log(modes[1].frequency_hz / 50.0);
    EXPECT_NEAR(first, -second, 1e-12);
    EXPECT_NEAR(modes[0].damping_ratio, 0.03, 1e-12) << "no posture has shown an error of it";
    square += first * first / 600.0;
  }
  EXPECT_NEAR(std::sqrt(square), 0.5 * 0.01, 3.0 * 0.03 * 0.5 * 0.01);
}

/// The structure of a cut has the receptance of the modes, whatever the rank of their residues, and the rest.
TEST(StructureOf, HasTheReceptanceOfTheModes) {
  std::vector<identification::FittedMode> modes(2);
  for (std::size_t r = 0; r < 2; ++r) {
    modes[r].frequency_hz = 40.0 + 25.0 * static_cast<double>(r);
    modes[r].damping_ratio = 0.03;
    modes[r].residue.resize(2, 2);
    modes[r].residue << std::complex<double>(0.1, -2.0), 0.4, std::complex<double>(-0.3, 0.2), -1.0;
  }
  modes[1].residue.row(1) = modes[1].residue.row(0) * 0.5;
  PostureCut cut;
  cut.responses = cut.references = Eigen::Matrix3d::Identity().leftCols(2);
  const Eigen::Matrix2d rest = Eigen::Vector2d(1e-3, 2e-3).asDiagonal();
  const milling::RelativeStructure structure = structure_of(modes, cut, rest);
  EXPECT_EQ(structure.poles.size(), 3);
  for (const double hz : {10.0, 41.0, 80.0}) {
    const Eigen::Matrix3cd G = milling::receptance(structure, 2.0 * std::numbers::pi * hz);
    const Eigen::MatrixXcd H = receptance(modes, hz) + rest;
    EXPECT_LT((G.topLeftCorner(2, 2) - H).norm(), 1e-12 * H.norm());
    EXPECT_LT(G.row(2).norm() + G.col(2).norm(), 1e-15);
  }
}

PostureCut slot_along_y() {
  PostureCut cut;
  cut.process.cutter = {2, 0.02};
  cut.process.coefficients = {800e6, 200e6};
  cut.process.engagement = {0.0, std::numbers::pi};
  cut.responses = cut.references = Eigen::Vector3d::UnitY();
  cut.spindle_speeds_rpm = {1100.0, 1700.0};
  cut.stability.depth_limit_m = 1.0;
  cut.stability.error_tolerance = 1e-7;
  return cut;
}

/// Depths scale with 1/A at unchanged poles: a deviation of ln A alone is one of ln depth, in both bands.
TEST(DepthBand, ScalesWithTheResidue) {
  PosturePrediction at = one_mode(0.01);
  at.modes[0].deviation.head(2).setZero();
  const PostureCut cut = slot_along_y();
  const DepthBand first = depth_band(at, cut), drawn = depth_band_from_draws(at, cut, 400);
  EXPECT_THROW((void)depth_band_from_draws(at, cut, 39), core::InputError);
  for (Eigen::Index i = 0; i < 2; ++i) {
    EXPECT_NEAR(std::log(first.high(i) / first.depth(i)), 1.96 * 0.01, 1e-4);
    EXPECT_NEAR(std::log(first.depth(i) / first.low(i)), 1.96 * 0.01, 1e-4);
    // The quantile of 400 draws has a standard error of 0.13 deviations.
    EXPECT_NEAR(std::log(drawn.high(i) / drawn.depth(i)), 1.96 * 0.01, 0.005);
    EXPECT_NEAR(std::log(drawn.depth(i) / drawn.low(i)), 1.96 * 0.01, 0.005);
  }
}

/// Measured on one side only, a path on the other side is served best by the candidate that lies on it, and a posture
/// that was measured already brings next to nothing.
TEST(NextPosture, LiesWherePathIsUnknown) {
  std::vector<Eigen::Vector3d> places = testing::spread_places(7, 41);
  for (Eigen::Vector3d& u : places) u.x() = 0.4 * u.x() - 0.6;
  const auto postures = softened_postures(places);
  const Predictor predictor(postures, plain());
  const auto at = [](double x) { return testing::place_of(testing::elbow_arm(), {x, 0.0, 0.0}); };
  const std::vector<Place> path = {at(0.8), at(0.9), at(1.0)};
  const NextPosture next = next_posture(predictor, path, {at(-0.6), postures[2].place, at(0.9), at(0.2)});
  EXPECT_EQ(next.best, 2);
  EXPECT_GT(next.reduction(2), 0.5);
  EXPECT_LE(next.reduction.maxCoeff(), 1.0);
  EXPECT_LT(next.reduction(1), 0.3 * next.reduction(2));
  EXPECT_THROW((void)next_posture(predictor, {}, path), core::InputError);
}

}  // namespace
}  // namespace thinwall::posture::predictor_test
