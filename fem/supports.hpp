#pragma once
// Supports: faces of the part that cannot move.

#include <functional>
#include <string>
#include <vector>

#include "fem/model.hpp"
#include "mesh/selection.hpp"

namespace thinwall::fem {

/// Zero displacement on a region of the surface, in the given axes (0…2).
struct Support {
  std::string name;  ///< name given by the user, for messages
  mesh::Region region;
  std::vector<int> axes{0, 1, 2};
};

/// The rows 3·node + axis that the supports hold. Throws InputError for a region without faces (mesh::select).
[[nodiscard]] std::vector<int> fixed_rows(const mesh::TetMesh& mesh, const mesh::LagrangeNodes& nodes,
                                          const std::vector<Support>& supports);

/// A function that moves the nodes of the straight mesh, in place, onto the surface of a curved part.
using Shaping = std::function<void(mesh::LagrangeNodes&)>;

/// Builds the constrained model of order 1…6 on a mesh. Supports are looked up on the straight mesh before `shape` (if
/// it is set) moves its nodes, attachments on the straight mesh too; the normals and lever arms of attachments are
/// those of the moved nodes. Throws what fixed_rows() and build_model() throw.
[[nodiscard]] Model supported_model(mesh::TetMesh mesh, int order, const Materials& materials,
                                    const std::vector<Support>& supports, const Shaping& shape = {},
                                    const Attachments& attachments = {});

/// Builds the constrained model of a part of one material.
[[nodiscard]] Model supported_model(mesh::TetMesh mesh, int order, const Material& material,
                                    const std::vector<Support>& supports, const Shaping& shape = {},
                                    const Attachments& attachments = {});

}  // namespace thinwall::fem
