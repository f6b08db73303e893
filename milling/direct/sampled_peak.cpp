#include "milling/direct/sampled_peak.hpp"

#include <algorithm>
#include <cmath>

namespace thinwall::milling {

double sampled_peak(const Eigen::Ref<const Eigen::VectorXd>& value) {
  Eigen::Index at = 0;
  const double largest = value.maxCoeff(&at);
  const Eigen::Index middle = std::clamp<Eigen::Index>(at, 1, value.size() - 2);
  const double before = value(middle - 1);
  const double after = value(middle + 1);
  const double bend = before - 2.0 * value(middle) + after;
  if (!(bend < 0.0)) return largest;
  const double offset = 0.5 * (before - after) / bend;
  if (std::abs(offset) > 1.0) return largest;
  return std::max(largest, value(middle) - 0.25 * (before - after) * offset);
}

}  // namespace thinwall::milling
