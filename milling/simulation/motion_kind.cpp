#include "milling/simulation/motion_kind.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace thinwall::milling {

namespace {

constexpr Eigen::Index longest_period = 24;
constexpr double growth_that_counts = 1.5;

/// The largest change from one sample to the next among `count` of them.
double largest_change(const Eigen::MatrixXd& samples, Eigen::Index first, Eigen::Index count) {
  if (count < 2) return 0.0;
  return (samples.middleCols(first + 1, count - 1) - samples.middleCols(first, count - 1)).colwise().norm().maxCoeff();
}

double spread(const Eigen::MatrixXd& samples) {
  return samples.size() == 0 ? 0.0 : (samples.rowwise().maxCoeff() - samples.rowwise().minCoeff()).norm();
}

}  // namespace

std::string name(Motion motion) {
  constexpr std::array<const char*, 5> names{"periodic", "period_n", "quasi_periodic", "growing", "settling"};
  return names[static_cast<std::size_t>(motion)];
}

MotionKind motion_kind(const Eigen::MatrixXd& samples, double size, double tolerance) {
  const Eigen::Index count = samples.cols();
  const Eigen::Index half = count / 2;
  MotionKind kind{Motion::quasi_periodic, 0, std::numeric_limits<double>::infinity()};
  for (Eigen::Index n = 1; n <= std::min(longest_period, count - half - 1); ++n) {
    const auto later = samples.rightCols(count - half - n);
    const auto earlier = samples.middleCols(half, count - half - n);
    const double change = (later - earlier).cwiseAbs().maxCoeff();
    const double difference = size > 0.0 ? change / size : 0.0;
    kind.difference = std::min(kind.difference, difference);
    if (difference > tolerance) continue;
    return {n == 1 ? Motion::periodic : Motion::period_n, static_cast<int>(n), difference};
  }
  const Eigen::Index quarter = count / 4;
  const double before = largest_change(samples, quarter, quarter);
  if (before > 0.0) kind.trend = largest_change(samples, count - quarter, quarter) / before;
  if (spread(samples.rightCols(quarter)) > growth_that_counts * spread(samples.middleCols(quarter, quarter)))
    kind.motion = Motion::growing;
  return kind;
}

MotionKind kind_beside_decay(const MotionKind& kind, double expected_trend) {
  constexpr double lasting = 0.95;  // trends of chatter that lasts are within 5 % of 1 but for rare ones
  const double smaller = std::min(lasting, 0.5 * (1.0 + expected_trend));
  const bool without_period = kind.motion == Motion::quasi_periodic || kind.motion == Motion::growing;
  if (!without_period || !(kind.trend < smaller)) return kind;
  MotionKind settling = kind;
  settling.motion = Motion::settling;
  return settling;
}

}  // namespace thinwall::milling
