#include "posture/learning_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/median.hpp"
#include "core/progress.hpp"
#include "posture/calibration.hpp"

namespace thinwall::posture {

namespace {

constexpr int first_count = 7;
constexpr std::size_t tested_in_turn = 4;

/// 7, 14, 28 … and all.
std::vector<std::size_t> counts_up_to(std::size_t all) {
  std::vector<std::size_t> counts;
  for (std::size_t n = first_count; n < all; n *= 2) counts.push_back(n);
  counts.push_back(all);
  return counts;
}

void add_frequency_errors(const PosturePrediction& at, const TappedPosture& there, std::vector<double>& errors) {
  for (const PredictedMode& mode : at.modes) {
    const auto same = std::ranges::find(there.label, mode.label);
    if (mode.label < 0 || same == there.label.end()) continue;
    const auto& measured = there.modes[static_cast<std::size_t>(same - there.label.begin())];
    errors.push_back(std::abs(mode.mean(0) - std::log(measured.frequency_hz)));
  }
}

void add_depth_errors(const PosturePrediction& at, const TappedPosture& there, const PostureCut& cut,
                      std::vector<double>& errors) {
  const Eigen::VectorXd measured = limiting_depths(there.modes, cut, there.rest),
                        predicted = limiting_depths(expected_modes(at), cut, at.rest);
  for (Eigen::Index i = 0; i < measured.size(); ++i) errors.push_back(std::abs(predicted(i) / measured(i) - 1.0));
}

LearningPoint point_of(const std::vector<TappedPosture>& some, const PredictorOptions& options,
                       const std::vector<TappedPosture>& tested, const std::optional<PostureCut>& cut) {
  const Predictor predictor(some, options);
  std::vector<double> frequency, depth;
  for (const TappedPosture& there : tested) {
    const PosturePrediction at = predictor.predict(there.place);
    add_frequency_errors(at, there, frequency);
    if (cut && !at.modes.empty()) add_depth_errors(at, there, *cut, depth);
  }
  LearningPoint point{static_cast<int>(some.size()), core::median(std::move(frequency))};
  if (!depth.empty()) point.depth_error = core::median(std::move(depth));
  return point;
}

Eigen::MatrixXd rows_of_places(const std::vector<TappedPosture>& postures) {
  Eigen::MatrixXd places(std::ssize(postures), postures.front().place.at.size());
  for (std::size_t i = 0; i < postures.size(); ++i)
    places.row(static_cast<Eigen::Index>(i)) = postures[i].place.at.transpose();
  return places;
}

}  // namespace

std::vector<std::size_t> spread_order(const Eigen::MatrixXd& places) {
  std::vector<std::size_t> order;
  if (places.rows() == 0) return order;
  Eigen::Index next = 0;
  (places.rowwise() - places.colwise().mean()).rowwise().squaredNorm().minCoeff(&next);
  Eigen::VectorXd distance = Eigen::VectorXd::Constant(places.rows(), std::numeric_limits<double>::infinity());
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    order.push_back(static_cast<std::size_t>(next));
    distance = distance.cwiseMin((places.rowwise() - places.row(next)).rowwise().squaredNorm());
    distance(next) = -1.0;  // taken: below all distances, and cwiseMin() keeps it
    distance.maxCoeff(&next);
  }
  return order;
}

LearningCurves learning_curves(const std::vector<TappedPosture>& postures, PredictorOptions options,
                               const std::optional<TappedArm>& nominal, const std::optional<PostureCut>& cut) {
  LearningCurves curves;
  std::vector<TappedPosture> tested, others;
  // Every fourth of an order that spreads: in that of a list they may all lie in one layer of a grid.
  const std::vector<std::size_t> all = spread_order(rows_of_places(postures));
  for (std::size_t i = 0; i < all.size(); ++i)
    (i % tested_in_turn == tested_in_turn - 1 ? tested : others).push_back(postures[all[i]]);
  if (tested.empty() || others.size() < static_cast<std::size_t>(first_count)) return curves;
  curves.tested = static_cast<int>(tested.size());
  std::vector<TappedPosture> ordered;
  for (const std::size_t i : spread_order(rows_of_places(others))) ordered.push_back(others[i]);
  const std::vector<std::size_t> counts = counts_up_to(ordered.size());
  core::Progress progress("learning curves", counts.size() * (nominal ? 2 : 1));
  for (const std::size_t count : counts) {
    const std::vector<TappedPosture> some(ordered.begin(), ordered.begin() + static_cast<std::ptrdiff_t>(count));
    options.mean.reset();
    curves.plain.push_back(point_of(some, options, tested, cut));
    progress.step();
    if (!nominal) continue;
    options.mean = *nominal;
    options.mean->arm = calibrate(*nominal, some).arm;
    curves.with_arm.push_back(point_of(some, options, tested, cut));
    progress.step();
  }
  return curves;
}

}  // namespace thinwall::posture
