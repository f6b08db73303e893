#pragma once
// Any closed surface to a coarse, graded mesh of tetrahedra, one through the wall.

#include <functional>
#include <string>
#include <vector>

#include "mesh/confined.hpp"
#include "mesh/faceted_surface.hpp"
#include "mesh/surface/size_space.hpp"
#include "mesh/tet_mesh.hpp"

namespace thinwall::mesh {

/// Of mesh_closed_surface().
struct SurfaceMeshOptions {
  SurfaceSize size;                ///< wanted edges on the surface
  double volume_tolerance = 1e-3;  ///< bound on |mesh volume / surface volume − 1|, 1e-6 to 0.1
  /// Bound on V/L³ of every tetrahedron (L its longest edge), 0 to 1e-3. Layers are flat by intent (three of them on a
  /// 1 mm wall with 40 mm elements: 2e-7); what lies below is a sliver, with stiffness entries that drown the rest.
  double smallest_shape = 1e-7;
  ProcessLimits limits;  ///< of each attempt of a mesher
};

/// The mesh and how it lies to the surface.
struct SurfaceMeshed {
  TetMesh mesh;
  std::string mesher;                  ///< "TetGen" or "CGAL"
  double volume_error_relative = 0.0;  ///< mesh volume / surface volume − 1
  double surface_distance_m = 0.0;     ///< two-sided sampled Hausdorff distance of boundary and surface
  double smallest_shape = 0.0;         ///< least V/L³; 0.118 for the regular tetrahedron, 3e-5 is flat but serves
  std::vector<std::string> failures;   ///< a line for each attempt that failed before
};

/// A way from a closed surface to tetrahedra, with the name that the result carries. Throws NumericalError if it fails.
struct VolumeMesher {
  std::string name;
  std::function<TetMesh(const TriangleSurface&)> run;
};

/// The surface remeshed (mesh::remesh; with a smaller turn until the volume is kept) and filled by TetGen as it is,
/// then, if that fails, with edges 0.8 and 0.64 times as long that turn 0.7 and 0.5 times as far; at last isotropic
/// elements by CGAL Mesh_3, 1.5 walls large.
[[nodiscard]] std::vector<VolumeMesher> volume_meshers(const TriangleSurface& surface,
                                                       const SurfaceMeshOptions& options);

/// Checks the surface (mesh::require_closed), then takes the first mesher whose mesh keeps the volume and has no
/// degenerate tetrahedron. Throws InputError for a bad surface or option; NumericalError, one line with what each
/// mesher said, if all fail; Interrupted. Interruptible.
[[nodiscard]] SurfaceMeshed mesh_closed_surface(const FacetedSurface& surface, const SurfaceMeshOptions& options = {});
/// Meshes a surface of triangles; otherwise as the function above.
[[nodiscard]] SurfaceMeshed mesh_closed_surface(const TriangleSurface& surface, const SurfaceMeshOptions& options = {});

/// Meshes a surface with meshers of one's own, tried in order.
[[nodiscard]] SurfaceMeshed mesh_closed_surface(const TriangleSurface& surface, const SurfaceMeshOptions& options,
                                                const std::vector<VolumeMesher>& meshers);

/// Least V/L³ over the tetrahedra, L the longest edge of each.
[[nodiscard]] double smallest_shape(const TetMesh& mesh);

}  // namespace thinwall::mesh
