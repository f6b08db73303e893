#include "milling/simulation/motion_kind.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace thinwall::milling {

namespace {

constexpr Eigen::Index longest_period = 24;
constexpr double growth_that_counts = 1.5;

double spread(const Eigen::MatrixXd& samples) {
  return samples.size() == 0 ? 0.0 : (samples.rowwise().maxCoeff() - samples.rowwise().minCoeff()).norm();
}

}  // namespace

std::string name(Motion motion) {
  constexpr std::array<const char*, 4> names{"periodic", "period_n", "quasi_periodic", "growing"};
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
  if (spread(samples.rightCols(quarter)) > growth_that_counts * spread(samples.middleCols(quarter, quarter)))
    kind.motion = Motion::growing;
  return kind;
}

}  // namespace thinwall::milling
