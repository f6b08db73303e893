#include "posture/next_posture.hpp"

#include <algorithm>
#include <string>

#include "core/error.hpp"

namespace thinwall::posture {

namespace {

/// S_p of each label's numbers at one place of the path, labels × numbers.
Eigen::MatrixXd wanted_variance(const PosturePrediction& at, const std::vector<int>& labels, Eigen::Index numbers,
                                const std::optional<PostureCut>& cut) {
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(std::ssize(labels), numbers);
  const Eigen::VectorXd of_depth =
      cut ? Eigen::VectorXd(depth_slopes(at, *cut).colwise().squaredNorm()) : Eigen::VectorXd();
  Eigen::Index column = 0;
  for (const PredictedMode& mode : at.modes) {
    const auto row = std::ranges::find(labels, mode.label) - labels.begin();
    const Eigen::Index first = column;
    column += mode.mean.size();
    if (row == std::ssize(labels)) continue;
    if (cut) {
      S.row(row) = of_depth.segment(first, mode.mean.size());
    } else {
      S(row, 0) = mode.deviation(0) * mode.deviation(0);
    }
  }
  return S;
}

Eigen::MatrixXd places_in_rows(const std::vector<Place>& path, const std::vector<Place>& candidates) {
  Eigen::MatrixXd places(std::ssize(path) + std::ssize(candidates), path.front().at.size());
  Eigen::Index row = 0;
  for (const std::vector<Place>* some : {&path, &candidates}) {
    for (const Place& place : *some) places.row(row++) = place.at;
  }
  return places;
}

/// The share of S at the p-th place of the path that measuring each candidate takes.
Eigen::VectorXd taken(const Eigen::MatrixXd& C, double noise_variance, Eigen::Index p, Eigen::Index path) {
  const Eigen::Index candidates = C.cols() - path;
  const Eigen::ArrayXd of_candidates = C.diagonal().tail(candidates).array() + noise_variance;
  const Eigen::ArrayXd between = C.row(p).tail(candidates).transpose();
  return (between.square() / (std::max(C(p, p), 1e-300) * of_candidates.max(1e-300))).min(1.0);
}

}  // namespace

NextPosture next_posture(const Predictor& predictor, const std::vector<Place>& path,
                         const std::vector<Place>& candidates, const std::optional<PostureCut>& cut) {
  if (path.empty() || candidates.empty())
    throw core::InputError("the next posture for " + std::to_string(path.size()) + " places of a path out of " +
                           std::to_string(candidates.size()) + " candidates, must be at least one of each");
  const Predictor::Covariances covariances = predictor.covariances(places_in_rows(path, candidates));
  const std::vector<int> labels = predictor.labels();
  NextPosture result{0, Eigen::VectorXd::Zero(std::ssize(candidates))};
  double all = 0.0;
  for (std::size_t p = 0; p < path.size(); ++p) {
    const auto numbers = covariances.of.empty() ? 0 : std::ssize(covariances.of.front());
    const Eigen::MatrixXd S = wanted_variance(predictor.predict(path[p]), labels, numbers, cut);
    all += S.sum();
    for (std::size_t l = 0; l < labels.size(); ++l) {
      for (std::size_t t = 0; t < covariances.of[l].size(); ++t) {
        result.reduction +=
            S(static_cast<Eigen::Index>(l), static_cast<Eigen::Index>(t)) *
            taken(covariances.of[l][t], covariances.noise[l][t], static_cast<Eigen::Index>(p), std::ssize(path));
      }
    }
  }
  if (all > 0.0) result.reduction /= all;
  result.reduction.maxCoeff(&result.best);
  return result;
}

}  // namespace thinwall::posture
