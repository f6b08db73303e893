#pragma once
// Isotropic linear elasticity.

namespace thinwall::fem {

/// Young's modulus (Pa), Poisson's ratio, density (kg/m³).
struct Material {
  double youngs_modulus_Pa = 0.0;
  double poisson_ratio = 0.0;
  double density_kg_m3 = 0.0;
};

/// Lamé's constants λ = Eν/((1+ν)(1−2ν)), μ = E/(2(1+ν)), Pa.
struct Lame {
  double lambda = 0.0;
  double mu = 0.0;
};

/// Throws InputError unless E > 0, 0 ≤ ν < 0.5 and ρ > 0.
[[nodiscard]] Lame lame(const Material& material);

}  // namespace thinwall::fem
