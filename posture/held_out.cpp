#include "posture/held_out.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "core/error.hpp"
#include "core/progress.hpp"
#include "posture/mode_targets.hpp"

namespace thinwall::posture {

namespace {

void require_folds(std::size_t postures, const std::vector<int>& fold, const std::set<int>& folds) {
  if (fold.size() == postures && folds.size() >= 2) return;
  throw core::InputError("postures left out: " + std::to_string(fold.size()) + " numbers of folds, " +
                         std::to_string(folds.size()) + " different ones, for " + std::to_string(postures) +
                         " postures; must be one a posture, and at least 2 different");
}

/// The variance of the noise of each number of a label.
Eigen::VectorXd noise_of(const Predictor::Covariances& covariances, const std::vector<int>& labels, int label) {
  const auto row = static_cast<std::size_t>(std::ranges::find(labels, label) - labels.begin());
  return Eigen::Map<const Eigen::VectorXd>(covariances.noise[row].data(), std::ssize(covariances.noise[row]));
}

/// The expected modes, of those that the posture has.
void predict_modes(const Predictor& predictor, const PosturePrediction& at, const TappedPosture& posture,
                   std::size_t number, std::vector<HeldOutMode>& modes) {
  const Predictor::Covariances covariances = predictor.covariances(posture.place.at.transpose());
  const std::vector<int> labels = predictor.labels();
  for (const PredictedMode& mode : at.modes) {
    const auto same = std::ranges::find(posture.label, mode.label);
    if (mode.label < 0 || same == posture.label.end()) continue;
    const auto& measured = posture.modes[static_cast<std::size_t>(same - posture.label.begin())];
    const Eigen::VectorXd noise = noise_of(covariances, labels, mode.label);
    modes.push_back({number, mode.label, targets_of(turned(measured, mode.turn)), mode.mean,
                     (mode.deviation.cwiseAbs2() + noise).cwiseSqrt()});
  }
}

HeldOutDepths predict_depths(const PosturePrediction& at, const TappedPosture& posture, std::size_t number,
                             const PostureCut& cut, int draws) {
  const DepthBand band = depth_band_from_draws(at, cut, draws);
  return {number, limiting_depths(posture.modes, cut, posture.rest), band.depth, band.low, band.high};
}

double share(std::size_t within, std::size_t all) {
  return all == 0 ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(within) / static_cast<double>(all);
}

}  // namespace

std::vector<int> folds_in_turn(std::size_t postures, int folds) {
  std::vector<int> fold(postures);
  for (std::size_t i = 0; i < postures; ++i) fold[i] = static_cast<int>(i) % std::max(1, folds);
  return fold;
}

HeldOut held_out(const std::vector<TappedPosture>& postures, const PredictorOptions& options,
                 const std::vector<int>& fold, const std::optional<PostureCut>& cut, int draws) {
  const std::set<int> folds(fold.begin(), fold.end());
  require_folds(postures.size(), fold, folds);
  HeldOut result;
  core::Progress progress("postures left out", postures.size());
  for (const int left_out : folds) {
    std::vector<TappedPosture> others;
    for (std::size_t i = 0; i < postures.size(); ++i)
      if (fold[i] != left_out) others.push_back(postures[i]);
    const Predictor predictor(std::move(others), options);
    for (std::size_t i = 0; i < postures.size(); ++i) {
      if (fold[i] != left_out) continue;
      const PosturePrediction at = predictor.predict(postures[i].place);
      predict_modes(predictor, at, postures[i], i, result.modes);
      if (cut && !at.modes.empty()) result.depths.push_back(predict_depths(at, postures[i], i, *cut, draws));
      progress.step();
    }
  }
  std::ranges::stable_sort(result.modes, {}, &HeldOutMode::posture);
  std::ranges::stable_sort(result.depths, {}, &HeldOutDepths::posture);
  return result;
}

double covered(const std::vector<HeldOutMode>& modes, Eigen::Index t) {
  const auto within = std::ranges::count_if(modes, [t](const HeldOutMode& mode) {
    return std::abs(mode.measured(t) - mode.predicted(t)) <= 1.96 * mode.deviation(t);
  });
  return share(static_cast<std::size_t>(within), modes.size());
}

double covered(const std::vector<HeldOutDepths>& depths) {
  std::size_t within = 0, all = 0;
  for (const HeldOutDepths& at : depths) {
    for (Eigen::Index i = 0; i < at.measured.size(); ++i, ++all)
      within += at.low(i) <= at.measured(i) && at.measured(i) <= at.high(i) ? 1 : 0;
  }
  return share(within, all);
}

}  // namespace thinwall::posture
