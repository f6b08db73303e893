#pragma once
// Tetrahedra inside a closed surface by TetGen, in a process of its own.

#include <Eigen/Core>
#include <functional>

#include "mesh/confined.hpp"
#include "mesh/faceted_surface.hpp"
#include "mesh/tet_mesh.hpp"

namespace thinwall::mesh {

/// Options of TetGen's refinement, and the resources that its process may use.
struct TetgenOptions {
  /// Wanted edge of the tetrahedra; the bound on their volume is that of the regular one. TetGen's last flips, which
  /// improve angles, may exceed the bounds in a few tetrahedra (observed: 26 % in volume, 3 % in the ratio).
  double element_size_m = 0.0;
  double radius_edge_ratio = 1.4;  ///< bound on circumradius / shortest edge (Shewchuk 1998); 1.1 to 5, lower is better
  double time_limit_s = 120.0;     ///< the process is killed after this
  double memory_limit_bytes = 4e9;  ///< address space the process may take beyond what it starts with
  /// Wanted size (m) at a point; if empty, element_size_m everywhere. The first mesh is refined until it is met.
  std::function<double(const Eigen::Vector3d&)> size_at;
};

/// Volume of the regular tetrahedron with edge h, h³ / (6√2).
[[nodiscard]] double regular_volume(double edge_m);

/// A mesh of the inside of `surface` by constrained Delaunay tetrahedralisation with quality refinement (TetGen 1.5, Si
/// 2015). TetGen aborts, throws, crashes or hangs on some input, so that it runs in a forked process with a limit on
/// time and memory. Throws NumericalError, with a remedy in the message, if that process fails in any way, if it
/// returns no tetrahedra, or if the volume of the mesh differs from the surface's by more than 1e-9 relative;
/// Interrupted.
[[nodiscard]] TetMesh tetrahedralise(const FacetedSurface& surface, const TetgenOptions& options);

/// A mesh of the inside of `surface` in which each facet is kept as it is (switches p and Y), so that the mesh is as
/// coarse and as flat as the surface's triangles. Without `radius_edge_ratio` (0) no point is added; with it points are
/// added within the body until the ratio of circumradius to shortest edge is below it, where the facets allow it. The
/// facets should be triangles: facets with isolated points on them make TetGen 1.5.0 throw. Process, checks and errors
/// are those of tetrahedralise().
[[nodiscard]] TetMesh tetrahedralise_as_given(const FacetedSurface& surface, const ProcessLimits& limits = {},
                                              double radius_edge_ratio = 0.0);

}  // namespace thinwall::mesh
