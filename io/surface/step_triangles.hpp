#pragma once
// The triangles of a shape of Open CASCADE, joined along its edges. Built only with Open CASCADE.

#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <optional>

#include "mesh/triangle_soup.hpp"

namespace thinwall::io {

/// The first face that BRepMesh_IncrementalMesh has left without triangles, if there is one.
[[nodiscard]] std::optional<TopoDS_Face> face_without_triangles(const TopoDS_Shape& shape);

/// All triangles of a meshed shape, oriented outwards as its faces are, in the shape's unit. Each face has points of
/// its own in Open CASCADE; they are merged along common edges and in common vertices by the topology of the shape, not
/// by distance, so that a solid's surface closes whatever its tolerances. Triangles that lose a side in this way (poles
/// of spheres, tips of cones) are left out. Cost O(triangles).
[[nodiscard]] mesh::TriangleSoup triangles_of(const TopoDS_Shape& shape);

}  // namespace thinwall::io
