#pragma once
// Triangulations of the two plane sides of thin walls, made equal to each other.

#include "mesh/surface/remesh.hpp"

namespace thinwall::mesh {

/// The remeshed surface with equal triangles on both sides of each thin plane wall. Elements between them are then
/// prisms cut into three tetrahedra, with faces that are perpendicular to the wall. Between sides that are divided
/// differently the faces are inclined, and because the deflection of a thin wall does not change through its thickness,
/// it must be one and the same polynomial on both sides of an inclined face: the wall is much too stiff, the more so
/// the thinner it is.
///
/// Two plane faces are the sides of a wall if they are parallel with material between them and their distance is at
/// most a third of their triangles' edges. Vertices on edges, straight or round, slide along them to the nearby
/// vertices of the other side; then the borders of both sides are drawn on each other and their common region is
/// triangulated once (constrained Delaunay, CGAL), with the interior vertices of one side. Edges that gain vertices are
/// divided on all faces. A wall whose borders would come closer to each other than a fifth of its thickness without
/// touching keeps its triangles. `remeshed`: isotropic away from borders (without layers). Cost O(n²) for n vertices on
/// the borders of a wall.
[[nodiscard]] Remeshed matched_walls(Remeshed remeshed);

}  // namespace thinwall::mesh
