#pragma once
// The triangles of a shape of Open CASCADE, joined along its edges. Built only with Open CASCADE.

#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <optional>

#include "mesh/triangle_soup.hpp"

namespace thinwall::io {

/// The first face that BRepMesh_IncrementalMesh left without triangles; none if it left none.
[[nodiscard]] std::optional<TopoDS_Face> face_without_triangles(const TopoDS_Shape& shape);

/// All triangles of a meshed shape, outwards as its faces are. Each face has points of its own in Open CASCADE; they
/// are made one along common edges and in common vertices by what the shape says of its edges, not by distance, so that
/// a solid's surface closes whatever its tolerances. Triangles that lose a side that way (poles of spheres, tips of
/// cones) are left out. Unit: the shape's. Cost O(triangles).
[[nodiscard]] mesh::TriangleSoup triangles_of(const TopoDS_Shape& shape);

}  // namespace thinwall::io
