// Errors at postures where nothing was tapped, over the number of tapped ones, with a calibrated arm as the mean; and
// how often the truth lies within the bands. With THINWALL_SLOW=1 in the environment, for they take minutes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "case/reader.hpp"
#include "posture/bands.hpp"
#include "posture/calibration.hpp"
#include "posture/predictor.hpp"
#include "setup/identified/identify.hpp"
#include "setup/identified/learned_modes.hpp"
#include "setup/identified/posture_tables.hpp"
#include "tests/case/milling_robot.hpp"

namespace thinwall::cases::learning_curves_test {
namespace {

using posture::PosturePrediction;
using tests::milling_robot::FewPostures;
using tests::milling_robot::mean_at;
using tests::milling_robot::test_postures;
using tests::milling_robot::TestPosture;

bool slow() {
  return std::getenv("THINWALL_SLOW") != nullptr;
}

/// The predictor that a case learns from the first `count` postures, with or without the arm.
class Learned {
 public:
  Learned(int count, bool with_mean) : Learned(robot_of(count, with_mean)) {}

  [[nodiscard]] PosturePrediction at(const TestPosture& there) const {
    setup::TabledRobot asked = robot_;
    asked.postures->at = there.at;
    posture::Place place{setup::scaled_places(asked).at, {}, {}};
    if (learning_.options.mean) {
      place.q = joints_of(there);
      if (learning_.asked.turn.responses.size() > 0) place.turn = posture::tip_turn(*learning_.options.mean, place.q);
    }
    return predictor_.predict(place);
  }

 private:
  explicit Learned(setup::TabledRobot robot)
      : robot_(std::move(robot)),
        learning_(setup::posture_learning(robot_, joints_of(test_postures().front()))),
        predictor_(learning_.postures, learning_.options) {}

  static setup::TabledRobot robot_of(int count, bool with_mean) {
    const FewPostures postures(count);
    const TestPosture& there = test_postures().front();
    const Case source = parse_case(postures.text(there, with_mean ? mean_at(there) : ""), postures.folder.path);
    return std::get<setup::TabledRobot>(source.robot->model);
  }
  /// The coordinates of the foot, which stands still, and of the six joints.
  static Eigen::VectorXd joints_of(const TestPosture& there) {
    Eigen::VectorXd q = Eigen::VectorXd::Zero(8);
    q.tail(6) = Eigen::Map<const Eigen::VectorXd>(there.joints_rad.data(), 6);
    return q;
  }

  setup::TabledRobot robot_;
  setup::PostureLearning learning_;
  posture::Predictor predictor_;
};

/// A slot with two teeth.
posture::PostureCut slot() {
  posture::PostureCut cut;
  cut.process.cutter = {2, 0.005};
  cut.process.coefficients = {880e6, 52e6};
  cut.process.engagement = {0.0, std::numbers::pi};
  cut.responses = cut.references = Eigen::Matrix3d::Identity().leftCols(2);
  cut.spindle_speeds_rpm = tests::milling_robot::speeds_rpm;
  cut.stability.depth_limit_m = 0.05;
  cut.stability.error_tolerance = 1e-3;
  return cut;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// The median over 64 postures and eight lines of ‖H − H_true‖/‖H_true‖ at the tip, in the band of the arm's modes.
double receptance_error(const Learned& learned) {
  std::vector<double> errors;
  for (const TestPosture& there : test_postures()) {
    const PosturePrediction at = learned.at(there);
    const auto modes = posture::expected_modes(at);
    for (const double hz : {6.0, 9.0, 12.0, 18.0, 25.0, 40.0, 95.0, 170.0}) {
      const Eigen::MatrixXcd truth = posture::receptance(there.modes, hz) + there.rest;
      errors.push_back((posture::receptance(modes, hz) - truth).norm() / truth.norm());
    }
  }
  return median(errors);
}

/// The median over eight postures and seven speeds of the relative error of the limiting depth.
double depth_error(const Learned& learned) {
  std::vector<double> errors;
  for (const TestPosture& there : test_postures()) {
    if (there.depth_mm.empty()) continue;
    const PosturePrediction at = learned.at(there);
    const Eigen::VectorXd depth = posture::limiting_depths(posture::expected_modes(at), slot(), at.rest);
    for (std::size_t i = 0; i < there.depth_mm.size(); ++i)
      errors.push_back(std::abs(1e3 * depth(static_cast<Eigen::Index>(i)) / there.depth_mm[i] - 1.0));
  }
  return median(errors);
}

/// The depths of the truth's modes by this program are those that the robot has.
TEST(LearningCurves, StandOnTheTruth) {
  const TestPosture& there = test_postures().front();
  const Eigen::VectorXd depth = posture::limiting_depths(there.modes, slot(), there.rest);
  for (std::size_t i = 0; i < there.depth_mm.size(); ++i)
    EXPECT_NEAR(1e3 * depth(static_cast<Eigen::Index>(i)), there.depth_mm[i], 2e-3 * there.depth_mm[i]);
}

/// Postures, and the errors that a calibrated arm as the mean has reached elsewhere with them: another program's
/// processes with the likeliest hyper-parameters, on the same data.
struct Bar {
  int postures;
  double receptance, depth;
};

TEST(LearningCurves, ReachThoseOfAnotherProgram) {
  if (!slow()) GTEST_SKIP() << "some minutes: set THINWALL_SLOW=1";
  for (const Bar& bar : {Bar{7, 0.077, 0.069}, Bar{14, 0.058, 0.038}, Bar{28, 0.055, 0.035}}) {
    const Learned learned(bar.postures, true);
    const double receptance = receptance_error(learned), depth = depth_error(learned);
    EXPECT_LE(receptance, bar.receptance) << bar.postures << " postures";
    EXPECT_LE(depth, bar.depth) << bar.postures << " postures";
    std::printf("%d postures: receptance %.3f, depth %.1f %%\n", bar.postures, receptance, 100.0 * depth);
  }
}

/// A count of the true values that lie within their intervals of 95 %.
struct Coverage {
  int inside = 0, all = 0;
  void count(bool is_inside) {
    inside += is_inside ? 1 : 0;
    ++all;
  }
  [[nodiscard]] double share() const { return static_cast<double>(inside) / all; }
};

/// Counts the eleven modes, paired with those that are predicted by shape and frequency.
void count_frequencies(const PosturePrediction& at, const TestPosture& there, Coverage& coverage) {
  std::vector<identification::FittedMode> known;
  for (std::size_t k = 0; k < there.modes.size(); ++k) {
    if (there.label[k] > 0) known.push_back(there.modes[k]);
  }
  const std::vector<int> pair = posture::paired(known, posture::expected_modes(at));
  for (std::size_t k = 0; k < known.size(); ++k) {
    if (pair[k] < 0) continue;
    const posture::PredictedMode& mode = at.modes[static_cast<std::size_t>(pair[k])];
    coverage.count(std::abs(mode.mean(0) - std::log(known[k].frequency_hz)) <= 1.96 * mode.deviation(0));
  }
}

void count_depths(const PosturePrediction& at, const TestPosture& there, Coverage& coverage) {
  const Eigen::VectorXd truth = posture::limiting_depths(there.modes, slot(), there.rest);
  const posture::DepthBand band = posture::depth_band_from_draws(at, slot(), 100);
  for (Eigen::Index i = 0; i < truth.size(); ++i) coverage.count(band.low(i) <= truth(i) && truth(i) <= band.high(i));
}

/// Bands of 95 % hold 90 to 99 % of the true frequencies of 64 postures, and of their limiting depths at seven speeds,
/// with an arm as the mean and without.
TEST(LearningCurves, HaveBandsThatHoldTheTruth) {
  if (!slow()) GTEST_SKIP() << "some minutes: set THINWALL_SLOW=1";
  for (const bool with_mean : {false, true}) {
    const Learned learned(28, with_mean);
    Coverage frequencies, depths;
    for (const TestPosture& there : test_postures()) {
      const PosturePrediction at = learned.at(there);
      count_frequencies(at, there, frequencies);
      count_depths(at, there, depths);
    }
    EXPECT_GE(frequencies.share(), 0.90);
    EXPECT_LE(frequencies.share(), 0.99);
    EXPECT_GE(depths.share(), 0.90);
    EXPECT_LE(depths.share(), 0.99);
    std::printf("28 postures, %s: %d of %d frequencies, %d of %d depths\n", with_mean ? "with an arm" : "plain",
                frequencies.inside, frequencies.all, depths.inside, depths.all);
  }
}

}  // namespace
}  // namespace thinwall::cases::learning_curves_test
