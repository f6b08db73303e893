#include "fem/material.hpp"

#include <string>

#include "core/error.hpp"

namespace thinwall::fem {

Lame lame(const Material& material) {
  const double E = material.youngs_modulus_Pa;
  const double nu = material.poisson_ratio;
  if (!(E > 0.0)) throw core::InputError("Young's modulus is " + std::to_string(E) + " Pa; it must be positive");
  if (!(nu >= 0.0 && nu < 0.5))
    throw core::InputError("Poisson's ratio is " + std::to_string(nu) + "; it must lie in 0 ≤ ν < 0.5");
  if (!(material.density_kg_m3 > 0.0)) throw core::InputError("the density must be positive");
  return {E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), E / (2.0 * (1.0 + nu))};
}

}  // namespace thinwall::fem
