#pragma once
// Supports: faces of the part that cannot move.

#include <string>
#include <vector>

#include "fem/model.hpp"
#include "mesh/selection.hpp"

namespace thinwall::fem {

/// Zero displacement on a region of the surface, in the given axes (0…2).
struct Support {
  std::string name;  ///< what the user called the region
  mesh::Region region;
  std::vector<int> axes{0, 1, 2};
};

/// Rows 3·node + axis that the supports hold. Throws InputError for a region without faces (mesh::select).
[[nodiscard]] std::vector<int> fixed_rows(const mesh::TetMesh& mesh, const mesh::LagrangeNodes& nodes,
                                          const std::vector<Support>& supports);

/// Builds the constrained model of order 1…6 on a mesh.
[[nodiscard]] Model supported_model(mesh::TetMesh mesh, int order, const Material& material,
                                    const std::vector<Support>& supports);

}  // namespace thinwall::fem
