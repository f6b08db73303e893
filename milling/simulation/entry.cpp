#include "milling/simulation/entry.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/error.hpp"

namespace thinwall::milling {

namespace {

/// The end of the last period that is a share off, s; none within the last tenth.
std::optional<double> settling_s(const Eigen::VectorXd& ratio, double share, double period_s) {
  for (Eigen::Index i = ratio.size(); i > 0; --i) {
    if (std::abs(ratio(i - 1) - 1.0) < share) continue;
    if (10 * i > 9 * ratio.size()) return std::nullopt;
    return static_cast<double>(i) * period_s;
  }
  return 0.0;
}

}  // namespace

Approach approach_of(const Eigen::VectorXd& means_m, double period_s) {
  constexpr Eigen::Index least_periods = 20;
  if (means_m.size() < least_periods || !means_m.allFinite()) {
    std::ostringstream text;
    text << "approach: " << means_m.size() << " means over tooth periods, must be at least " << least_periods
         << " and finite; record more turns";
    throw core::InputError(text.str());
  }
  Approach result;
  result.final_m = means_m.tail(means_m.size() / 10).mean();
  if (result.final_m == 0.0) return result;  // along an axis on which nothing moves
  const Eigen::VectorXd ratio = means_m / result.final_m;
  Eigen::Index peak = 0;
  result.overshoot = std::max(0.0, ratio.maxCoeff(&peak) - 1.0);
  result.peak_s = (static_cast<double>(peak) + 0.5) * period_s;
  result.settling_2_s = settling_s(ratio, 0.02, period_s);
  result.settling_5_s = settling_s(ratio, 0.05, period_s);
  return result;
}

}  // namespace thinwall::milling
