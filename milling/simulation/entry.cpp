#include "milling/simulation/entry.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/error.hpp"

namespace thinwall::milling {

namespace {

/// Means over tooth periods.
Eigen::VectorXd tooth_means(const Trace& trace, int direction, double tooth_period_s) {
  constexpr Eigen::Index least_periods = 20;
  const double samples = tooth_period_s / trace.step_s;
  const auto whole = static_cast<Eigen::Index>(std::llround(samples));
  if (whole < 1 || std::abs(samples - static_cast<double>(whole)) > 1e-6 * samples) {
    std::ostringstream text;
    text << "approach: " << samples << " samples a tooth period, must be a whole number; take another number a turn";
    throw core::InputError(text.str());
  }
  const Eigen::Index periods = trace.displacement_m.cols() / whole;
  if (periods < least_periods) {
    std::ostringstream text;
    text << "approach: a trace of " << periods << " tooth periods, must be at least " << least_periods
         << "; trace more turns";
    throw core::InputError(text.str());
  }
  Eigen::VectorXd means(periods);
  for (Eigen::Index i = 0; i < periods; ++i)
    means(i) = trace.displacement_m.row(direction).segment(i * whole, whole).mean();
  return means;
}

/// The end of the last period that is a share off, s.
double settling_s(const Eigen::VectorXd& ratio, double share, double tooth_period_s) {
  for (Eigen::Index i = ratio.size(); i > 0; --i) {
    if (std::abs(ratio(i - 1) - 1.0) >= share) return static_cast<double>(i) * tooth_period_s;
  }
  return 0.0;
}

}  // namespace

Approach approach_of(const Trace& trace, int direction, double tooth_period_s) {
  const Eigen::VectorXd means = tooth_means(trace, direction, tooth_period_s);
  Approach result;
  result.final_m = means.tail(std::max<Eigen::Index>(1, means.size() / 10)).mean();
  if (result.final_m == 0.0) return result;  // along an axis on which nothing moves
  const Eigen::VectorXd ratio = means / result.final_m;
  Eigen::Index peak = 0;
  result.overshoot = std::max(0.0, ratio.maxCoeff(&peak) - 1.0);
  result.peak_s = (static_cast<double>(peak) + 0.5) * tooth_period_s;
  result.settling_2_s = settling_s(ratio, 0.02, tooth_period_s);
  result.settling_5_s = settling_s(ratio, 0.05, tooth_period_s);
  return result;
}

}  // namespace thinwall::milling
