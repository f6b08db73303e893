#pragma once
// Rows of narrow elements beside the sharp edges of thin walls.

#include <cstddef>

#include "mesh/tet_mesh.hpp"

namespace thinwall::mesh {

/// The width of the rows of with_rows_at_edges(), in wall thicknesses.
inline constexpr double width_of_rows = 0.6;

/// A mesh with rows of elements at its sharp edges.
struct EdgeRows {
  TetMesh mesh;
  std::size_t divided = 0;  ///< edges of tetrahedra at which a row ends
  std::size_t whole = 0;    ///< those at which two rows should end, and none does
};

/// The mesh with a row of elements beside each sharp edge of its boundary, where it turns by more than
/// `sharp_angle_rad`: stresses are singular at a re-entrant edge and change within a wall thickness of a free one,
/// which long elements follow only at a high order. Each edge of a tetrahedron that leads from a sharp edge, or from
/// the place across the wall, by more than three wall thicknesses is divided 0.6 of them off (of several sharp edges,
/// off the one that it leaves at the smallest angle), so that both sides of a wall are divided alike. One that leads
/// away from two sharp edges at its two ends is divided at the re-entrant one; where both or neither are re-entrant it
/// is left whole and counted, for both rows would take several times as many elements. The wall is the thinner one of
/// the two beneath the faces at the sharp edge (wall_thickness()), and no thicker than that edge of a face is long. A
/// body that is nowhere thin stays as it is. Vertices keep their numbers; volume and boundary are kept. Throws as
/// wall_thickness(). Cost: O(vertices · sharp edges).
[[nodiscard]] EdgeRows with_rows_at_edges(const TetMesh& mesh, double sharp_angle_rad);

}  // namespace thinwall::mesh
