#pragma once
// The closed surface of one body from the triangles of a file: safe repairs are made, everything else is refused, with
// its place.

#include <string>
#include <vector>

#include "mesh/confined.hpp"
#include "mesh/faceted_surface.hpp"
#include "mesh/surface/surface_finding.hpp"
#include "mesh/triangle_soup.hpp"

namespace thinwall::mesh {

/// Repairs that are allowed, and their bounds.
struct SurfaceRepairOptions {
  double merge_tolerance_m = 0.0;  ///< points within this become one; closes cracks of exporters. 0: equal points only
  int largest_hole_edges = 0;      ///< holes with at most so many edges are filled, 0 to 100; 0: none
  double largest_movement =
      1e-4;                      ///< a repair that moves a point by more than this of the diagonal is refused, 0 to 0.1
  double thinnest_wall_m = 0.0;  ///< thinner walls are refused (mesh::thin_walls()); 0: not measured
  double far_diagonals = 100.0;  ///< a part further from the origin, in its diagonals, is moved there, 1 to 1e8
  ProcessLimits limits;          ///< of the search for crossings and of filling holes, each
  double longest_union_s = 20.0;  ///< processor time in which bodies are united; beyond it they stay apart
};

/// A surface that mesh::require_closed() accepts, and the repairs that it needed.
struct SurfaceRepair {
  TriangleSurface surface;
  std::vector<SurfaceFinding> mended;  ///< places in the frame of the file
  Eigen::Vector3d moved_by =
      Eigen::Vector3d::Zero();      ///< added to all coordinates of the file, m; zero unless far away
  double largest_movement_m = 0.0;  ///< of a point that was merged; no other repair moves the surface
  double volume_m3 = 0.0;
  double solid_volume_m3 = 0.0;  ///< TriangleSoup::solid_volume_m3; 0 where it differs by a tenth from that of the
                                 ///< triangles, which is no loss of chords
  double thinnest_wall_m = 0.0;  ///< if options.thinnest_wall_m > 0; infinite if no two faces lie opposite
};

/// The repaired surface: points are merged, several closed bodies that touch or overlap united (united()), collapsed
/// and repeated facets dropped, neighbours of facets without area split, small holes filled if asked for, and facets
/// turned outwards. Anything that would need a guess is refused: throws InputError, in one line with counts and first
/// places in mm of everything found at that stage, for open edges, edges of more than two triangles, walls without
/// thickness (coincident opposite facets), points in which parts touch, a one-sided surface, several bodies, cavities,
/// triangles that cross or cover each other, walls below the tolerance, a movement above the bound, coordinates too far
/// away for double precision, a diagonal beyond 1000 km or below 1 nm, and options out of range. If the union of bodies
/// failed, the refusal says why. Throws NumericalError
/// if a search does not end within the limits. Cost O(n log n).
[[nodiscard]] SurfaceRepair repaired_surface(const TriangleSoup& soup, const SurfaceRepairOptions& options = {});

/// The repairs in one line, or "nothing to mend".
[[nodiscard]] std::string text(const SurfaceRepair& repair);

}  // namespace thinwall::mesh
