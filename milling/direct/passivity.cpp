#include "milling/direct/passivity.hpp"

#include "dynamics/frf_checks.hpp"

namespace thinwall::milling {

namespace {

/// One driving point of the receptance as a matrix of its own.
dynamics::ResponseModel driving_point(const SampledReceptance& receptance, int direction) {
  const dynamics::Dof along{"P", Eigen::Vector3d::Unit(direction), dynamics::DofKind::translation};
  dynamics::ResponseModel point{{receptance.frequency_hz}, {along}, {along}, {}};
  point.H.reserve(receptance.H.size());
  for (const Eigen::Matrix3cd& H : receptance.H)
    point.H.emplace_back(Eigen::MatrixXcd::Constant(1, 1, H(direction, direction)));
  return point;
}

}  // namespace

std::optional<GivesEnergy> energy_given(const SampledReceptance& receptance) {
  std::optional<GivesEnergy> worst;
  for (int direction = 0; direction < 3; ++direction) {
    const auto check = dynamics::passivity(driving_point(receptance, direction));
    if (!check || check->holds || (worst && check->figure <= worst->share)) continue;
    worst = {direction, check->frequency_hz, check->figure};
  }
  return worst;
}

}  // namespace thinwall::milling
