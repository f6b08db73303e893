#pragma once
// Structures of a few modes, for the tests of this folder.

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "dynamics/modal_model.hpp"

namespace thinwall::milling::testing {

struct Mode {
  double frequency_hz;
  double damping_ratio;
  double mass_kg;
  Eigen::Vector3d direction;
};

/// H = Σ d dᵀ / (m (ω₀² − ω² + 2iζω₀ω)) at "P", as the pole pairs of dynamics::ModalModel with a = 2 i ω_d m.
inline dynamics::ModalModel modal_model(const std::vector<Mode>& modes) {
  const auto poles = static_cast<Eigen::Index>(2 * modes.size());
  dynamics::ModalModel model;
  model.dofs = dynamics::translations("P");
  model.poles.resize(poles);
  model.scaling.resize(poles);
  model.right.resize(3, poles);
  Eigen::Index k = 0;
  for (const Mode& mode : modes) {
    const double omega = 2.0 * std::numbers::pi * mode.frequency_hz;
    const double damped = omega * std::sqrt(1.0 - mode.damping_ratio * mode.damping_ratio);
    for (const double sign : {1.0, -1.0}) {
      model.poles(k) = {-mode.damping_ratio * omega, sign * damped};
      model.scaling(k) = {0.0, sign * 2.0 * damped * mode.mass_kg};
      model.right.col(k++) = mode.direction.cast<std::complex<double>>();
    }
  }
  model.left = model.right;
  return model;
}

}  // namespace thinwall::milling::testing
