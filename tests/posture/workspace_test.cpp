// Postures that are held out, numbers learned together, maps over the workspace, and the envelope of low and high
// modes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "posture/band_envelope.hpp"
#include "posture/held_out.hpp"
#include "posture/mode_targets.hpp"
#include "posture/shared_tasks.hpp"
#include "posture/workspace_map.hpp"

namespace thinwall::posture::workspace_test {
namespace {

double normal(std::mt19937& random) {
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) sum += static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
  return sum;
}

/// Numbers of a mode at a place in the plane; the function of the second is that of the first, mirrored, plus a share
/// of its own.
struct Functions {
  double own = 0.0, noise_f = 0.0, noise_damping = 0.0;

  [[nodiscard]] Eigen::Vector4d at(const Eigen::Vector2d& u, double hz) const {
    const double f = 0.1 * std::sin(1.2 * u.x() + 0.4 * u.y()) + 0.05 * u.y();
    return {std::log(hz) + f, std::log(0.03) - 2.0 * f + own * std::cos(7.0 * u.x()) * std::cos(6.0 * u.y()),
            0.02 * (1.0 + 0.2 * u.x()), 1e-4 * u.y()};
  }
};

std::vector<Eigen::Vector2d> places_in_plane(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Eigen::Vector2d> places(static_cast<std::size_t>(count));
  for (Eigen::Vector2d& u : places)
    for (double& v : u) v = 2.0 * static_cast<double>(random()) / static_cast<double>(std::mt19937::max()) - 1.0;
  return places;
}

/// Postures with two modes at one point along one direction, the higher one first.
std::vector<TappedPosture> postures_with(const Functions& functions, int count) {
  std::mt19937 random(5);
  std::vector<TappedPosture> postures;
  for (const Eigen::Vector2d& u : places_in_plane(count, 2)) {
    TappedPosture posture{{u, {}, {}}, {}, {0, 1}, {}};
    for (const double hz : {170.0, 50.0}) {
      Eigen::Vector4d numbers = functions.at(u, hz);
      numbers(0) += functions.noise_f * normal(random);
      numbers(1) += functions.noise_damping * normal(random);
      posture.modes.push_back(mode_of(numbers, 1));
    }
    postures.push_back(posture);
  }
  return postures;
}

PredictorOptions quick() {
  PredictorOptions options;
  options.averaging.samples = 16;
  return options;
}

PostureCut slot_along_y(std::vector<double> speeds_rpm) {
  PostureCut cut;
  cut.process.cutter = {2, 0.02};
  cut.process.coefficients = {800e6, 200e6};
  cut.process.engagement = {0.0, std::numbers::pi};
  cut.responses = cut.references = Eigen::Vector3d::UnitY();
  cut.spindle_speeds_rpm = std::move(speeds_rpm);
  cut.stability.depth_limit_m = 1.0;
  cut.stability.error_tolerance = 1e-5;
  return cut;
}

TEST(HeldOut, IsThePredictionOfThoseThatDoNotKnowThePosture) {
  const auto postures = postures_with({0.0, 1e-3, 1e-2}, 12);
  const std::vector<int> fold = folds_in_turn(postures.size(), 3);
  const PostureCut cut = slot_along_y({1700.0});
  const HeldOut found = held_out(postures, quick(), fold, cut, 40);
  ASSERT_EQ(found.modes.size(), 24U);
  ASSERT_EQ(found.depths.size(), 12U);
  std::vector<TappedPosture> others;
  for (std::size_t i = 0; i < postures.size(); ++i) {
    if (fold[i] != 1) others.push_back(postures[i]);
  }
  const Predictor predictor(others, quick());
  for (const std::size_t i : {std::size_t{1}, std::size_t{4}}) {
    const PosturePrediction at = predictor.predict(postures[i].place);
    for (const HeldOutMode& mode : found.modes) {
      if (mode.posture != i) continue;
      const auto& expected = at.modes[static_cast<std::size_t>(mode.label)];
      EXPECT_EQ(mode.predicted, expected.mean);
      EXPECT_EQ(mode.measured, targets_of(postures[i].modes[static_cast<std::size_t>(mode.label)]));
      EXPECT_TRUE((mode.deviation.array() > expected.deviation.array()).all());
    }
    EXPECT_EQ(found.depths[i].measured, limiting_depths(postures[i].modes, cut));
    EXPECT_EQ(found.depths[i].predicted, limiting_depths(expected_modes(at), cut));
  }
}

/// The intervals of what a test would give hold as many tests as they say: of 80 with noise of 1 % and 5 % the standard
/// error of a share of 95 % is 2.4 %.
TEST(HeldOut, CoversWhatTestsGive) {
  const auto postures = postures_with({0.0, 0.01, 0.05}, 40);
  const HeldOut found = held_out(postures, quick(), folds_in_turn(postures.size(), 5));
  for (const Eigen::Index number : {0, 1}) {
    EXPECT_GE(covered(found.modes, number), 0.88) << number;
    std::vector<double> deviations;
    for (const HeldOutMode& mode : found.modes) deviations.push_back(mode.deviation(number));
    std::ranges::sort(deviations);
    const double noise = number == 0 ? 0.01 : 0.05;
    EXPECT_NEAR(deviations[deviations.size() / 2], noise, 0.4 * noise) << number;  // mostly the noise
  }
  EXPECT_TRUE(std::isnan(covered(std::vector<HeldOutDepths>{})));
}

TEST(HeldOut, RefusesFoldsThatLeaveNothingOut) {
  const auto postures = postures_with({}, 6);
  EXPECT_THROW((void)held_out(postures, quick(), {0, 0, 0, 0, 0, 0}), core::InputError);
  EXPECT_THROW((void)held_out(postures, quick(), {0, 1}), core::InputError);
  EXPECT_THROW((void)alone_and_together(postures, {0, 1}), core::InputError);
}

/// A damping with much noise that follows the frequency is told better together where postures are few; a number that
/// stands alone in its group is the same in both ways.
TEST(AloneAndTogether, GainsWhereANoisyNumberFollowsAnother) {
  const auto postures = postures_with({0.0, 1e-3, 0.1}, 16);
  const auto tasks = alone_and_together(postures, folds_in_turn(postures.size(), 5));
  ASSERT_EQ(tasks.size(), 6U);
  for (const SharedTasks& group : tasks) {
    if (group.group == NumberGroup::frequency_and_damping) {
      EXPECT_EQ(group.sharing(), Sharing::gains) << group.R2_alone.transpose() << ", " << group.R2_together.transpose();
      EXPECT_GT(group.R2_together(1), group.R2_alone(1));
      EXPECT_GT(group.ln_p_together, group.ln_p_alone);
    } else {
      EXPECT_EQ(group.sharing(), Sharing::none);
      EXPECT_NEAR(group.ln_p_together, group.ln_p_alone, 1e-6 * std::abs(group.ln_p_alone));
    }
    EXPECT_EQ(group.measured.rows(), 16);
    EXPECT_TRUE((group.left_out_deviation.array() > 0.0).all());
  }
}

/// The damping varies over a seventh of the frequency's length: one set of lengths for both cannot gain.
TEST(AloneAndTogether, DoesNotGainWhereNothingIsShared) {
  Functions functions{0.5, 1e-3, 1e-2};
  const auto postures = postures_with(functions, 30);
  for (const SharedTasks& group : alone_and_together(postures, folds_in_turn(postures.size(), 5))) {
    EXPECT_NE(group.sharing(), Sharing::gains);
  }
}

/// A mode that eight postures have seen, seven of which are in one fold: beside that fold there is one alone, from
/// which nothing can be learned.
TEST(AloneAndTogether, LeavesOutAModeThatOneFoldHasAlmostAlone) {
  auto postures = postures_with({0.0, 1e-3, 1e-2}, 20);
  std::vector<int> fold(postures.size(), 0);
  for (std::size_t i = 10; i < postures.size(); ++i) fold[i] = 1;
  for (std::size_t i = 0; i < postures.size(); ++i) {
    if (i < 7 || i == 10) continue;
    postures[i].modes.pop_back();
    postures[i].label.pop_back();
  }
  const auto tasks = alone_and_together(postures, fold);
  EXPECT_EQ(tasks.size(), 3U);
  for (const SharedTasks& group : tasks) EXPECT_EQ(group.label, 0);
}

TEST(GridWithinHull, EndsWhenItIsInterrupted) {
  core::request_interrupt();
  EXPECT_THROW((void)grid_within_hull(Eigen::Vector2d(0.0, 1.0), 5), core::Interrupted);
  core::clear_interrupt();
}

TEST(GridWithinHull, HasThePlacesOfATriangle) {
  Eigen::MatrixXd triangle(3, 2);
  triangle << 0, 10, 2, 10, 0, 30;
  const Eigen::MatrixXd grid = grid_within_hull(triangle, 5);
  EXPECT_EQ(grid.rows(), 15);
  EXPECT_EQ(Eigen::RowVector2d(grid.row(1)), Eigen::RowVector2d(0.0, 15.0));
  for (const auto& row : grid.rowwise()) EXPECT_LE(row(0) / 2.0 + (row(1) - 10.0) / 20.0, 1.0 + 1e-9);
  EXPECT_THROW((void)grid_within_hull(triangle, 1), core::InputError);
  EXPECT_THROW((void)grid_within_hull(triangle, 2000), core::InputError);
}

/// The first mode is the lowest one, whatever its label; its interval is that of its logarithm; the depth is that of
/// the best speed.
TEST(WorkspaceMap, HasTheLowestModeAndTheBestSpeed) {
  const Functions functions{0.0, 1e-3, 1e-2};
  const Predictor predictor(postures_with(functions, 12), quick());
  const Place place{Eigen::Vector2d(0.2, -0.1), {}, {}};
  const PostureCut cut = slot_along_y({1100.0, 1400.0, 1700.0});
  const MappedPlace at = workspace_map(predictor, {place}, cut, 40).front();
  const PosturePrediction expected = predictor.predict(place);
  EXPECT_EQ(at.first_hz.value, std::exp(expected.modes[1].mean(0)));
  EXPECT_NEAR(at.first_hz.value, std::exp(functions.at(place.at, 50.0)(0)), 0.01 * 50.0);
  EXPECT_NEAR(at.first_hz.high * at.first_hz.low, at.first_hz.value * at.first_hz.value, 1e-9 * 2500.0);
  ASSERT_TRUE(at.depth);
  const Eigen::VectorXd depths = limiting_depths(expected_modes(expected), cut);
  EXPECT_EQ(at.depth->depth_m.value, depths.maxCoeff());
  EXPECT_LT(at.depth->depth_m.low, at.depth->depth_m.value);
  EXPECT_GT(at.depth->depth_m.high, at.depth->depth_m.value);
  EXPECT_FALSE(map_place(predictor, place, std::nullopt).depth);
}

/// Modes with frequencies and the size of their residues.
std::vector<identification::FittedMode> modes_at(const std::vector<std::pair<double, double>>& modes) {
  std::vector<identification::FittedMode> result;
  for (const auto& [hz, size] : modes) result.push_back(mode_of(Eigen::Vector4d(std::log(hz), -3.5, size, 0.0), 1));
  return result;
}

/// The high modes here are a million times stiffer, so that all modes together are as the low ones, and so is the
/// envelope.
TEST(BandEnvelope, IsThatOfTheModesThatYield) {
  const PostureCut cut = slot_along_y({1100.0, 1400.0, 1700.0});
  const auto modes = modes_at({{50.0, 0.02}, {64.0, 0.01}, {900.0, 1e-6}});
  const double split = widest_gap_hz(split_among_hz(modes, cut));
  EXPECT_NEAR(split, std::sqrt(64.0 * 900.0), 1e-9);
  const BandEnvelope at = band_envelope(modes, cut, split);
  for (Eigen::Index i = 0; i < 3; ++i) {
    EXPECT_NEAR(at.lower(i), at.together(i), 1e-3 * at.together(i));
    EXPECT_EQ(at.lower(i), std::min(at.low(i), at.high(i)));
  }
  EXPECT_EQ(band_envelope(modes, cut, 1e4).high(0), std::numeric_limits<double>::infinity());
  EXPECT_THROW((void)widest_gap_hz({50.0}), core::InputError);
}

/// A tool beside the robot counts to the high modes: the low ones are as without it, and without a high mode the tool
/// alone limits the depth.
TEST(BandEnvelope, CountsTheToolToTheHighModes) {
  const auto low = modes_at({{50.0, 0.02}, {64.0, 0.01}}), high = modes_at({{150.0, 0.05}}),
             tool = modes_at({{180.0, 0.1}});
  PostureCut cut = slot_along_y({1700.0});
  const Eigen::VectorXd robot_alone = limiting_depths(low, cut), tool_alone = limiting_depths(tool, cut);
  ASSERT_LT(tool_alone.maxCoeff(), cut.stability.depth_limit_m);
  cut.beside = structure_of(tool, cut);
  const BandEnvelope no_high = band_envelope(low, cut, 100.0), no_low = band_envelope(high, cut, 100.0);
  EXPECT_EQ(no_high.low, robot_alone);
  EXPECT_LT((no_high.high - tool_alone).cwiseAbs().maxCoeff(), 1e-4 * tool_alone.minCoeff());
  EXPECT_EQ(no_high.together, limiting_depths(low, cut));
  EXPECT_EQ(no_low.low.minCoeff(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(no_low.high, limiting_depths(high, cut));
}

/// A structure that stands for the modes is what the depths and the envelope are of; its poles are split.
TEST(BandEnvelope, SplitsThePolesOfAStructureThatStandsForTheModes) {
  const PostureCut cut = slot_along_y({1100.0, 1400.0, 1700.0});
  const auto modes = modes_at({{50.0, 0.02}, {64.0, 0.01}, {900.0, 1e-6}}), others = modes_at({{40.0, 0.05}});
  PostureCut stood_for = cut;
  stood_for.structure_by = [&](const std::vector<identification::FittedMode>&) { return structure_of(modes, cut); };
  EXPECT_EQ(limiting_depths(others, stood_for), limiting_depths(modes, cut));
  EXPECT_NEAR(widest_gap_hz(split_among_hz(others, stood_for)), std::sqrt(64.0 * 900.0), 1e-9);
  const BandEnvelope direct = band_envelope(modes, cut, 200.0), by_poles = band_envelope(others, stood_for, 200.0);
  EXPECT_EQ(by_poles.low, direct.low);
  EXPECT_EQ(by_poles.high, direct.high);
  EXPECT_EQ(by_poles.lower, direct.lower);
  EXPECT_EQ(by_poles.together, direct.together);
  EXPECT_EQ(band_envelope(others, stood_for, 1e4).high(0), std::numeric_limits<double>::infinity());
}

/// Cross terms are left out of what the cut feels; the direct receptances stay, and so do those of the rest.
TEST(StructureOf, LeavesOutCrossTerms) {
  identification::FittedMode mode;
  mode.frequency_hz = 40.0;
  mode.damping_ratio = 0.03;
  mode.right = Eigen::Vector2cd(std::complex<double>(0.02, 0.001), std::complex<double>(0.01, -0.002));
  mode.left = Eigen::Vector2cd(std::complex<double>(0.0, -1.0), std::complex<double>(0.2, -0.7));
  mode.residue = mode.right * mode.left.transpose();
  Eigen::Matrix2d rest;
  rest << 2e-8, 1e-8, 3e-8, 4e-8;
  PostureCut cut;
  cut.responses = Eigen::Matrix3d::Identity().leftCols(2);
  cut.references = cut.responses;
  const double omega = 2.0 * std::numbers::pi * 39.0;
  const Eigen::Matrix3cd all = milling::receptance(structure_of({mode}, cut, rest), omega);
  cut.cross_terms = false;
  const Eigen::Matrix3cd direct = milling::receptance(structure_of({mode}, cut, rest), omega);
  EXPECT_GT(std::abs(all(0, 1)), 0.1 * std::abs(all(0, 0)));
  EXPECT_LT((direct - Eigen::Matrix3cd(all.diagonal().asDiagonal())).norm(), 1e-12 * all.norm());
}

}  // namespace
}  // namespace thinwall::posture::workspace_test
