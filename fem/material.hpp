#pragma once
// Isotropic linear elasticity, of one material or of several.

#include <cstddef>
#include <vector>

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

/// The materials of a part and which of them each tetrahedron is of.
struct Materials {
  std::vector<Material> list;
  std::vector<int> of_tet;  ///< index into the list for each tetrahedron; empty: the first everywhere
};

/// Throws InputError, with the place, unless there is a material, each is what lame() takes, and every one of `tets`
/// tetrahedra has an index into the list (or none has one). Cost O(tets).
void validate(const Materials& materials, std::size_t tets);

}  // namespace thinwall::fem
