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

void validate(const Materials& materials, std::size_t tets) {
  if (materials.list.empty()) throw core::InputError("a part needs a material, and none is given");
  for (std::size_t i = 0; i < materials.list.size(); ++i) {
    try {
      (void)lame(materials.list[i]);
    } catch (const core::InputError& error) {
      if (materials.list.size() == 1) throw;
      throw core::InputError("material " + std::to_string(i) + ": " + error.what());
    }
  }
  if (materials.of_tet.empty()) return;
  if (materials.of_tet.size() != tets) {
    throw core::InputError("materials are given for " + std::to_string(materials.of_tet.size()) +
                           " tetrahedra, and the mesh has " + std::to_string(tets) + ": give one index for each");
  }
  for (std::size_t tet = 0; tet < tets; ++tet) {
    const int index = materials.of_tet[tet];
    if (index >= 0 && static_cast<std::size_t>(index) < materials.list.size()) continue;
    throw core::InputError("tetrahedron " + std::to_string(tet) + " is of material " + std::to_string(index) +
                           ", and there are materials 0 to " + std::to_string(materials.list.size() - 1));
  }
}

}  // namespace thinwall::fem
