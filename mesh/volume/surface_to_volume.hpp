#pragma once
// Coarse, graded meshes of tetrahedra inside closed surfaces, with one element through the wall.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mesh/confined.hpp"
#include "mesh/faceted_surface.hpp"
#include "mesh/surface/size_space.hpp"
#include "mesh/tet_mesh.hpp"

namespace thinwall::mesh {

/// Options of mesh_closed_surface().
struct SurfaceMeshOptions {
  SurfaceSize size;                ///< wanted edges on the surface
  double volume_tolerance = 1e-3;  ///< bound on |mesh volume / surface volume − 1|, 1e-6 to 0.1
  /// Bound on V/L³ of every tetrahedron (L its longest edge), 0 to 1e-3. Layers are flat by intent (three of them on a
  /// 1 mm wall with 40 mm elements: 2e-7); a tetrahedron below the bound is a sliver, whose stiffness entries are so
  /// large that the others are lost in their round-off.
  double smallest_shape = 1e-7;
  /// Bound on circumradius over shortest edge of the tetrahedra of a body that is not thin, whose walls are thicker
  /// than its triangles are long: TetGen adds points within it. 0: none, as in thin walls, where there would be
  /// thousands.
  double radius_edge_ratio = 0.0;
  ProcessLimits limits;  ///< of each attempt of a mesher
};

/// The mesh and its fit to the surface.
struct SurfaceMeshed {
  TetMesh mesh;
  std::string mesher;                  ///< "TetGen" or "CGAL"
  double volume_error_relative = 0.0;  ///< mesh volume / surface volume − 1
  double surface_distance_m = 0.0;     ///< two-sided sampled Hausdorff distance of boundary and surface
  double smallest_shape = 0.0;         ///< least V/L³; 0.118 for the regular tetrahedron, 3e-5 is flat but usable
  std::vector<std::string> failures;   ///< a line for each attempt that failed before
};

/// The features and walls of a closed surface, for several attempts at it.
struct AnalysedSurface {
  SurfaceFeatures features;
  std::vector<double> thickness;  ///< m, of the wall beneath each triangle
  double median = 0.0;            ///< m, of the wall beneath half of the surface
};

/// The features of a surface at edges sharper than `sharp_angle_rad`, and its walls. Throws NumericalError where no ray
/// from a triangle meets another one. Cost O(n log n).
[[nodiscard]] std::shared_ptr<const AnalysedSurface> analysed_surface(const TriangleSurface& surface,
                                                                      double sharp_angle_rad);

/// A method to fill a closed surface with tetrahedra, and its name for the result. It throws NumericalError if it
/// fails.
struct VolumeMesher {
  std::string name;
  std::function<TetMesh(const TriangleSurface&)> run;
};

/// The methods that mesh_closed_surface() tries in turn: the surface remeshed (mesh::remesh(), with a smaller turn
/// until the volume is kept), without layers with equal triangles on both sides of plane walls (matched_walls()), and
/// filled by TetGen in a quarter of limits.time_s; then, if that fails, remeshed with edges 0.8 and 0.64 times as long
/// that turn 0.7 and 0.5 times as far; and at last isotropic elements of 1.5 wall thicknesses by CGAL Mesh_3.
/// `analysed`: analysed_surface() of the surface at options.size.sharp_angle_rad, or empty.
[[nodiscard]] std::vector<VolumeMesher> volume_meshers(const TriangleSurface& surface,
                                                       const SurfaceMeshOptions& options,
                                                       std::shared_ptr<const AnalysedSurface> analysed = {});

/// The mesh of a closed surface by the first method whose mesh keeps the volume and has no degenerate tetrahedron.
/// Throws InputError for a surface that is not closed (mesh::require_closed()) or an option out of range;
/// NumericalError, in one line with the message of each method, if all fail; Interrupted.
[[nodiscard]] SurfaceMeshed mesh_closed_surface(const FacetedSurface& surface, const SurfaceMeshOptions& options = {});
/// The mesh of a closed surface of triangles.
[[nodiscard]] SurfaceMeshed mesh_closed_surface(const TriangleSurface& surface, const SurfaceMeshOptions& options = {});

/// The mesh of a closed surface by the given methods, which are tried in order. The surface must not cross itself,
/// which is not searched for again (mesh::require_closed_shell()).
[[nodiscard]] SurfaceMeshed mesh_closed_surface(const TriangleSurface& surface, const SurfaceMeshOptions& options,
                                                const std::vector<VolumeMesher>& meshers);

/// Least V/L³ over the tetrahedra, L the longest edge of each.
[[nodiscard]] double smallest_shape(const TetMesh& mesh);

}  // namespace thinwall::mesh
