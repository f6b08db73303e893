#pragma once
// The smooth patches of a surface and the sharp lines between them, as places to which points are moved.

#include <array>
#include <map>
#include <vector>

#include "mesh/polyline.hpp"
#include "mesh/surface/surface_features.hpp"
#include "mesh/surface/triangle_tree.hpp"
#include "mesh/tet_mesh.hpp"

namespace thinwall::mesh {

/// True if the triangles have one normal, to 1e-6 rad.
[[nodiscard]] bool is_planar(const TriangleSurface& surface, const std::vector<int>& triangles);

/// A patch of a closed surface.
struct SmoothPatch {
  TriangleTree tree;    ///< of its triangles
  bool planar = false;  ///< is_planar()
};

/// The patches and lines of a closed surface, numbered as surface_features() numbers them.
struct SmoothPatches {
  TriangleSurface surface;
  SurfaceFeatures features;
  TriangleTree whole;                                         ///< of all triangles of the surface
  std::vector<SmoothPatch> patches;                           ///< by number
  std::map<std::array<int, 2>, std::vector<Polyline>> lines;  ///< by the two patches beside them, ascending
};

/// The patches of a closed surface between edges at which it turns by more than `sharp_angle_rad`. Throws InputError
/// for a surface without triangles. Cost O(n log n).
[[nodiscard]] SmoothPatches smooth_patches(const TriangleSurface& surface, double sharp_angle_rad);

/// True if every patch is planar: straight elements follow the surface exactly.
[[nodiscard]] bool all_planar(const SmoothPatches& of);

/// The patch that a face of a mesh's boundary represents: that of the surface's triangle nearest to its centroid, if
/// the normals of both differ by less than 60°; −1 otherwise.
[[nodiscard]] int patch_beneath(const SmoothPatches& of, const TetMesh& mesh, const BoundaryTriangle& face);

/// The point nearest to x (m) of the lines between two patches, or of the patch where both are one; x where the two
/// have no line between them.
[[nodiscard]] Eigen::Vector3d nearest_between(const SmoothPatches& of, int patch, int other, const Eigen::Vector3d& x);

}  // namespace thinwall::mesh
