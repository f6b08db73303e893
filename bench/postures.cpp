// Learning curves over postures of a robot whose truth is known: errors of frequencies, receptances and limiting depths
// where nothing was measured, with plain processes and with the calibrated model as the mean, and how often the truth
// lies within the 95 % intervals. THINWALL_POSTURES names the folder with the files; words name numbers of postures.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <string>
#include <vector>

#include "bench/posture_files.hpp"
#include "posture/bands.hpp"
#include "posture/calibration.hpp"
#include "posture/predictor.hpp"

namespace thinwall::posture {

namespace {

const std::vector<double> lines_hz = {6.0, 9.0, 12.0, 18.0, 25.0, 40.0, 95.0, 170.0};
constexpr std::size_t postures_with_depths = 8;

/// All that is known of the robot.
struct Robot {
  TappedArm arm;
  std::vector<TappedPosture> tapped;  ///< in the order of the design
  std::vector<TappedPosture> truth;
  std::vector<Eigen::MatrixXcd> rest;   ///< of each posture of the truth, m/N
  std::vector<Eigen::VectorXd> depths;  ///< of some of them, m
  std::vector<double> speeds_rpm;
};

std::vector<TappedPosture> in_order(const std::vector<TappedPosture>& postures, const Columns& table) {
  std::vector<TappedPosture> result(postures.size());
  for (std::size_t i = 0; i < postures.size(); ++i)
    result[static_cast<std::size_t>(table.at(i, "order"))] = postures[i];
  return result;
}

/// The compliance above the modes, at the postures whose fit was kept: the constant of the low band less the high
/// modes.
void read_rests(const std::string& file, std::vector<TappedPosture>& postures) {
  std::ifstream in(file);
  if (!in) return;
  const nlohmann::json json = nlohmann::json::parse(in);
  for (const auto& [number, kept] : json["postures"].items()) {
    TappedPosture& posture = postures[static_cast<std::size_t>(std::stoul(number))];
    const auto constant = kept["low"]["fit"]["residual_terms"][0].get<std::vector<double>>();
    Eigen::MatrixXcd rest = Eigen::Map<const Eigen::MatrixXd>(constant.data(), 4, 4).transpose().topLeftCorner(2, 2);
    std::vector<identification::FittedMode> high;
    for (const identification::FittedMode& mode : posture.modes) {
      if (mode.frequency_hz > 300.0) high.push_back(mode);
    }
    rest -= receptance(high, 0.0).topLeftCorner(2, 2);
    posture.rest = rest.real();
  }
}

Robot read_robot(const std::string& folder, const std::string& name) {
  const std::string end = "_" + name;
  Robot robot{read_arm(folder + "/arm" + end + ".json", 0.0334),
              read_postures(folder + "/postures" + end + ".csv"),
              read_postures(folder + "/test_postures" + end + ".csv"),
              {},
              {},
              {}};
  read_modes(folder + "/modes_identified" + end + ".csv", "continuation", {"1X", "1Y", "aX", "aY"}, robot.tapped);
  read_modes(folder + "/modes_test" + end + ".csv", "label", {"1X", "1Y"}, robot.truth);
  read_rests(folder + "/identification" + end + ".json", robot.tapped);
  TappedArm tip = robot.arm;
  tip.responses = tip.references = robot.arm.responses.topRows(2);
  for (std::vector<TappedPosture>* postures : {&robot.tapped, &robot.truth}) {
    for (TappedPosture& posture : *postures) posture.place.turn = tip_turn(tip, posture.place.q);
  }
  robot.tapped = in_order(robot.tapped, read_columns(folder + "/postures" + end + ".csv"));
  const Columns rest = read_columns(folder + "/rest_test" + end + ".csv");
  for (std::size_t i = 0; i < rest.rows.size(); ++i) {
    Eigen::MatrixXcd of_high(2, 2);
    of_high << rest.at(i, "XX"), rest.at(i, "XY"), rest.at(i, "YX"), rest.at(i, "YY");
    robot.rest.push_back(of_high);
  }
  const nlohmann::json truth = nlohmann::json::parse(std::ifstream(folder + "/truth_test" + end + ".json"));
  robot.speeds_rpm = truth["speeds_rpm"].get<std::vector<double>>();
  for (const auto& posture : truth["postures"]) {
    const auto mm = posture["depth_mm"].get<std::vector<double>>();
    robot.depths.emplace_back(1e-3 * Eigen::Map<const Eigen::VectorXd>(mm.data(), std::ssize(mm)));
  }
  return robot;
}

/// A slot with two teeth, feed along x, the tool's axis upwards.
PostureCut slot(const std::vector<double>& speeds_rpm) {
  PostureCut cut;
  cut.process.cutter = {2, 0.02};
  cut.process.coefficients = {880e6, 52e6};
  cut.process.engagement = {0.0, std::numbers::pi};
  cut.responses = cut.references = Eigen::Matrix3d::Identity().leftCols(2);
  cut.spindle_speeds_rpm = speeds_rpm;
  cut.stability.depth_limit_m = 0.05;
  cut.stability.error_tolerance = 1e-3;
  return cut;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::nan("");
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

struct Errors {
  std::vector<double> frequency, frf, depth;
  std::vector<bool> frequency_covered, frf_covered, depth_covered;
};

double share(const std::vector<bool>& covered) {
  return covered.empty() ? std::nan("")
                         : static_cast<double>(std::ranges::count(covered, true)) / static_cast<double>(covered.size());
}

void compare_modes(const PosturePrediction& at, const TappedPosture& truth, Errors& errors) {
  for (const PredictedMode& mode : at.modes) {
    if (mode.label < 0 || mode.label > 6) continue;
    for (std::size_t k = 0; k < truth.modes.size(); ++k) {
      if (truth.label[k] != mode.label) continue;
      const double error = std::abs(mode.mean(0) - std::log(truth.modes[k].frequency_hz));
      errors.frequency.push_back(error);
      errors.frequency_covered.push_back(error <= 1.96 * mode.deviation(0));
    }
  }
}

void compare_receptances(const PosturePrediction& at, const TappedPosture& truth, const Eigen::MatrixXcd& rest,
                         Errors& errors) {
  const FrfBand band = frf_band(at, lines_hz);
  for (std::size_t k = 0; k < lines_hz.size(); ++k) {
    const Eigen::MatrixXcd H = receptance(truth.modes, lines_hz[k]) + rest;
    const Eigen::MatrixXcd difference = band.mean[k] - H;
    errors.frf.push_back(difference.norm() / H.norm());
    for (Eigen::Index e = 0; e < H.size(); ++e) {
      errors.frf_covered.push_back(std::abs(difference(e).real()) <= 1.96 * band.deviation[k](e).real());
      errors.frf_covered.push_back(std::abs(difference(e).imag()) <= 1.96 * band.deviation[k](e).imag());
    }
  }
}

void compare_depths(const PosturePrediction& at, const Eigen::VectorXd& truth, const PostureCut& cut, int draws,
                    Errors& errors) {
  const Eigen::VectorXd depth = limiting_depths(expected_modes(at), cut, at.rest);
  for (Eigen::Index i = 0; i < depth.size(); ++i) errors.depth.push_back(std::abs(depth(i) / truth(i) - 1.0));
  if (draws == 0) return;
  const DepthBand band = depth_band_from_draws(at, cut, draws);
  for (Eigen::Index i = 0; i < depth.size(); ++i)
    errors.depth_covered.push_back(band.low(i) <= truth(i) && truth(i) <= band.high(i));
}

/// Only the tip is learned: the second point served to know modes by.
std::vector<TappedPosture> at_the_tip(std::vector<TappedPosture> postures) {
  for (TappedPosture& posture : postures) {
    for (identification::FittedMode& mode : posture.modes) {
      mode.left = mode.left.head(2).eval();
      mode.right = mode.right.head(2).eval();
      mode.residue = mode.right * mode.left.transpose();
    }
  }
  return postures;
}

Predictor learned(const Robot& robot, const std::vector<TappedPosture>& some, bool with_model) {
  PredictorOptions options;
  if (with_model) {
    options.mean =
        TappedArm{calibrate(robot.arm, some).arm, robot.arm.responses.topRows(2), robot.arm.references.topRows(2)};
  }
  return {at_the_tip(some), options};
}

void row(const Robot& robot, std::size_t postures, bool with_model, int draws) {
  const std::vector<TappedPosture> some(robot.tapped.begin(),
                                        robot.tapped.begin() + static_cast<std::ptrdiff_t>(postures));
  const Predictor predictor = learned(robot, some, with_model);
  const PostureCut cut = slot(robot.speeds_rpm);
  Errors errors;
  for (std::size_t i = 0; i < robot.truth.size(); ++i) {
    const PosturePrediction at = predictor.predict(robot.truth[i].place);
    compare_modes(at, robot.truth[i], errors);
    compare_receptances(at, robot.truth[i], robot.rest[i], errors);
    if (i < std::min(postures_with_depths, robot.depths.size()))
      compare_depths(at, robot.depths[i], cut, draws, errors);
  }
  std::printf("%8zu  %-10s  %6.2f %%  %6.3f (%.3f)  %6.1f %% (%.0f %%)   %.2f  %.2f  %.2f\n", postures,
              with_model ? "calibrated" : "plain", 100.0 * quantile(errors.frequency, 0.5), quantile(errors.frf, 0.5),
              quantile(errors.frf, 0.9), 100.0 * quantile(errors.depth, 0.5), 100.0 * quantile(errors.depth, 0.9),
              share(errors.frequency_covered), share(errors.frf_covered), share(errors.depth_covered));
  std::fflush(stdout);
}

}  // namespace

}  // namespace thinwall::posture

int main(int count, char** words) {
  using namespace thinwall::posture;
  const char* folder = std::getenv("THINWALL_POSTURES");
  const char* name = std::getenv("THINWALL_ROBOT");
  const char* draws = std::getenv("THINWALL_DRAWS");
  if (folder == nullptr) {
    std::printf("THINWALL_POSTURES is not set: it names the folder with a robot's postures, modes and truth\n");
    return 0;
  }
  std::vector<std::size_t> numbers;
  for (int i = 1; i < count; ++i) numbers.push_back(static_cast<std::size_t>(std::stoul(words[i])));
  if (numbers.empty()) numbers = {7, 14, 28};
  const Robot robot = read_robot(folder, name == nullptr ? "A" : name);
  std::printf("postures  mean        median f  FRF (90 %%)      depth (90 %%)      in the 95 %% band: f  FRF  depth\n");
  for (const std::size_t n : numbers) {
    for (const bool with_model : {false, true}) row(robot, n, with_model, draws == nullptr ? 100 : std::atoi(draws));
  }
}
