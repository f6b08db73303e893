#pragma once
// Where a point lies in a mesh, and the sample points of a contact patch.

#include <Eigen/Core>
#include <vector>

#include "mesh/tet_mesh.hpp"

namespace thinwall::mesh {

/// A tetrahedron and barycentric coordinates in it.
struct Location {
  int tet = 0;
  Eigen::Vector4d lambda = Eigen::Vector4d::Zero();
};

/// The tetrahedron that contains x (m), or the one that misses it least. `distance_m` says by how much x was moved to
/// lie in it, 0 inside. Cost O(tets).
struct Located {
  Location location;
  double distance_m = 0.0;
};
[[nodiscard]] Located locate(const TetMesh& mesh, const Eigen::Vector3d& x);

/// A sample of a patch and its share of the patch's area; shares sum to one.
struct PatchSample {
  Location location;
  double weight = 0.0;
};

/// The disc of radius r (m) about x on the part's surface, cut where it leaves the surface, as weighted samples of
/// equal area, for the area-weighted average ∫ u dA / ∫ dA. The disc lies in the plane of the boundary triangle nearest
/// to x. 8 rings × 24 sectors, midpoint in area: the average of a quadratic field is right to 1 % of its variation over
/// the disc. r = 0 gives the one sample x. Throws InputError if x lies more than 1e-6 of the part's diagonal off the
/// part, or (r > 0) off its surface.
[[nodiscard]] std::vector<PatchSample> patch_samples(const TetMesh& mesh, const std::vector<BoundaryTriangle>& boundary,
                                                     const Eigen::Vector3d& x, double radius_m);

}  // namespace thinwall::mesh
