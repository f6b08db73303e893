#pragma once
// A fit with what was measured and what is to be said of it.

#include <Eigen/Core>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "identification/fit_response.hpp"

namespace thinwall::report {

/// Places of the points of a test, m, and lines between them, by the points' names.
struct TestGeometry {
  std::map<std::string, Eigen::Vector3d> position;
  std::vector<std::pair<std::string, std::string>> lines;
};

/// The fit and what belongs to it. Only `measured` and `fit` are needed.
struct FitReport {
  dynamics::ResponseModel measured;
  identification::ResponseFit fit;
  std::vector<std::string> doubts{};  ///< warnings
  std::vector<std::string> notes{};
  std::vector<Eigen::MatrixXd> coherence{};           ///< of each line of `measured`; empty unless all entries have one
  std::vector<identification::OrderPoles> diagram{};  ///< also where poles were named
  TestGeometry geometry{};
  std::vector<std::string> sources{};  ///< files that were read
  std::vector<std::string> command{};  ///< the words that made the fit, without --poles
};

/// An interval of 95 %.
struct Interval {
  double low = 0.0, high = 0.0;
};

/// Bounds of a normal distribution that leave 2.5 % on each side, in deviations.
inline constexpr double two_sided = 1.959964;

/// The interval of a number whose logarithm is normal.
[[nodiscard]] inline Interval interval(double value, double sd_ln) {
  return {value * std::exp(-two_sided * sd_ln), value * std::exp(two_sided * sd_ln)};
}

}  // namespace thinwall::report
