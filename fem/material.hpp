#pragma once
// Isotropic linear elastic materials, and their assignment to the elements of a part.

#include <cstddef>
#include <vector>

namespace thinwall::fem {

/// An isotropic material: Young's modulus (Pa), Poisson's ratio, density (kg/m³).
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

/// The Lamé constants of a material. Throws InputError unless E > 0, 0 ≤ ν < 0.5 and ρ > 0.
[[nodiscard]] Lame lame(const Material& material);

/// The materials of a part and their assignment to its tetrahedra.
struct Materials {
  std::vector<Material> list;
  std::vector<int> of_tet;  ///< index into the list for each tetrahedron; if empty, all have the first
};

/// Throws InputError, which names the place, unless there is at least one material, lame() accepts each of them, and
/// every one of the `tets` tetrahedra has an index into the list (or none has one). Cost O(tets).
void validate(const Materials& materials, std::size_t tets);

}  // namespace thinwall::fem
