#include "regression/cross_validation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "core/error.hpp"

namespace thinwall::regression {

double coefficient_of_determination(const Eigen::VectorXd& y, const Eigen::VectorXd& predicted) {
  double count = 0.0, mean = 0.0, residual = 0.0, total = 0.0;
  for (const double v : y) {
    if (std::isnan(v)) continue;
    count += 1.0;
    mean += v;
  }
  mean /= count;
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    if (std::isnan(y(i))) continue;
    residual += (y(i) - predicted(i)) * (y(i) - predicted(i));
    total += (y(i) - mean) * (y(i) - mean);
  }
  return 1.0 - residual / total;
}

CrossValidation cross_validate(const TaskData& data, const std::vector<int>& fold, const SearchOptions& options) {
  const std::set<int> folds(fold.begin(), fold.end());
  if (static_cast<Eigen::Index>(fold.size()) != data.places() || folds.size() < 2) {
    throw core::InputError("cross-validation: " + std::to_string(fold.size()) + " numbers of folds, " +
                           std::to_string(folds.size()) + " different ones, for " + std::to_string(data.places()) +
                           " places; must be one a place, and at least 2 different");
  }
  CrossValidation result;
  result.mean.setConstant(data.places(), data.tasks(), std::numeric_limits<double>::quiet_NaN());
  result.deviation = result.mean;
  for (const int left_out : folds) {
    std::vector<Eigen::Index> seen, unseen;
    for (std::size_t i = 0; i < fold.size(); ++i)
      (fold[i] == left_out ? unseen : seen).push_back(static_cast<Eigen::Index>(i));
    const GaussianProcess process(TaskData{data.inputs(seen, Eigen::all), data.targets(seen, Eigen::all)}, options);
    const Prediction at = process.predict(data.inputs(unseen, Eigen::all));
    const Eigen::VectorXd noise = process.noise_sd();
    for (std::size_t k = 0; k < unseen.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      for (Eigen::Index t = 0; t < data.tasks(); ++t) {
        const Eigen::Index i = row * data.tasks() + t;
        result.mean(unseen[k], t) = at.mean(row, t);
        result.deviation(unseen[k], t) = std::sqrt(at.covariance(i, i) + noise(t) * noise(t));
      }
    }
  }
  result.R2.resize(data.tasks());
  result.covered.resize(data.tasks());
  for (Eigen::Index t = 0; t < data.tasks(); ++t) {
    result.R2(t) = coefficient_of_determination(data.targets.col(t), result.mean.col(t));
    double within = 0.0, count = 0.0;
    for (Eigen::Index i = 0; i < data.places(); ++i) {
      if (std::isnan(data.targets(i, t))) continue;
      count += 1.0;
      within += std::abs(data.targets(i, t) - result.mean(i, t)) <= 1.96 * result.deviation(i, t) ? 1.0 : 0.0;
    }
    result.covered(t) = within / count;
  }
  return result;
}

}  // namespace thinwall::regression
