#pragma once
// From the triangles of a file to the closed surface of one body: what is safe is mended, the rest is refused with
// places.

#include <string>
#include <vector>

#include "mesh/confined.hpp"
#include "mesh/faceted_surface.hpp"
#include "mesh/surface/surface_finding.hpp"
#include "mesh/triangle_soup.hpp"

namespace thinwall::mesh {

/// Repairs that are allowed, and their bounds.
struct SurfaceRepairOptions {
  double merge_tolerance_m = 0.0;  ///< points within this become one, 0: only equal ones; closes cracks of exporters
  int largest_hole_edges = 0;      ///< holes with at most so many edges are filled, 0 to 100; 0: none
  double largest_movement =
      1e-4;                      ///< a repair that moves a point by more than this of the diagonal is refused, 0 to 0.1
  double thinnest_wall_m = 0.0;  ///< walls below are refused (mesh::thin_walls); 0: not measured
  double far_diagonals = 100.0;  ///< farther from the origin than so many diagonals: moved to the centre, 1 to 1e8
  ProcessLimits limits;          ///< of the search for crossings and of filling holes, each
};

/// A surface that mesh::require_closed accepts, and what it took.
struct SurfaceRepair {
  TriangleSurface surface;
  std::vector<SurfaceFinding> mended;  ///< places in the frame of the file
  Eigen::Vector3d moved_by =
      Eigen::Vector3d::Zero();      ///< added to all coordinates of the file, m; zero unless far away
  double largest_movement_m = 0.0;  ///< of a point that was merged; nothing else moves the surface
  double volume_m3 = 0.0;
  double thinnest_wall_m = 0.0;  ///< if options.thinnest_wall_m > 0; infinite if no two faces lie opposite
};

/// Merges points, drops collapsed and double facets, splits neighbours of facets without area, fills small holes if
/// asked, turns facets outwards. Nothing is guessed: throws InputError, one line with everything that was found at that
/// stage, counts and first places in mm, for open edges, edges of more than two triangles, walls without thickness
/// (coincident opposite facets), points in which parts touch, a one-sided surface, several bodies, cavities, triangles
/// that cross or cover each other, walls below the tolerance, a movement above the bound, coordinates too far away for
/// a double, bad options. NumericalError if a search does not end within the limits. Cost O(n log n).
[[nodiscard]] SurfaceRepair repaired_surface(const TriangleSoup& soup, const SurfaceRepairOptions& options = {});

/// The repairs in one line; "nothing to mend" if nothing was.
[[nodiscard]] std::string text(const SurfaceRepair& repair);

}  // namespace thinwall::mesh
