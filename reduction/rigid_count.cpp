#include "reduction/rigid_count.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace thinwall::reduction {

int rigid_count(const Eigen::VectorXd& lambda, double round_off) {
  for (Eigen::Index k = std::min<Eigen::Index>(most_rigid_modes, lambda.size()); k > 0; --k) {
    const double next = k < lambda.size() ? lambda(k) : 0.0;
    if (std::abs(lambda(k - 1)) < std::max(1e-6 * next, round_off)) return static_cast<int>(k);
  }
  return 0;
}

ModesWithoutEnergy without_energy(const Eigen::VectorXd& lambda, double round_off) {
  const int count = rigid_count(lambda, round_off);
  if (count == 0) return {};
  return {count, std::sqrt(lambda.head(count).cwiseAbs().maxCoeff()) / (2.0 * std::numbers::pi)};
}

}  // namespace thinwall::reduction
