#pragma once
// The place of a point in a mesh, and the sample points of a contact patch.

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
/// See above; x in part axes, m.
[[nodiscard]] Located locate(const TetMesh& mesh, const Eigen::Vector3d& x);

/// The disc about a point on the part's surface.
struct DiscFace {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();  ///< the surface's point nearest to the point
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();    ///< of the triangle there, outwards
  double depth_m = 0.0;                                ///< how far from its plane the face still belongs to the disc
  /// Boundary triangles in reach whose normals turn from that by less than 60° (so none of the wall's other side); the
  /// one about the centre is the first.
  std::vector<BoundaryTriangle> triangles;
};

/// `off_m` says how far the mesh, which follows a curved surface by chords, may lie off the surface that x (m) was
/// taken from. The face belongs to the disc as far as 1e-6 of the part's diagonal from its plane, and, where off_m > 0,
/// off_m and a quarter of the radius more: what a sphere of twice the radius falls by. Throws InputError if x lies more
/// than 1e-6 of the diagonal and off_m off the part's surface. Cost O(boundary triangles).
[[nodiscard]] DiscFace disc_face(const TetMesh& mesh, const std::vector<BoundaryTriangle>& boundary,
                                 const Eigen::Vector3d& x, double radius_m, double off_m);

/// A sample of a patch and its share of the patch's area; shares sum to one.
struct PatchSample {
  Location location;
  double weight = 0.0;
};

/// The disc of radius r (m) about x on the part's surface, cut where it leaves the surface, as weighted samples of
/// equal area, for the area-weighted average ∫ u dA / ∫ dA. The disc lies in the plane of the boundary triangle nearest
/// to x. 8 rings × 24 sectors, midpoint in area: the average of a quadratic field is right to 1 % of its variation over
/// the disc. r = 0 gives the one sample x.
///
/// With `off_m` (see disc_face) x is moved to the mesh, and samples fall onto the face of the disc, aside by no more
/// than down. Throws InputError if x lies more than 1e-6 of the part's diagonal and off_m off the part, or (r > 0) off
/// its surface. Cost O(tets + samples × triangles of the face).
[[nodiscard]] std::vector<PatchSample> patch_samples(const TetMesh& mesh, const std::vector<BoundaryTriangle>& boundary,
                                                     const Eigen::Vector3d& x, double radius_m, double off_m = 0.0);

}  // namespace thinwall::mesh
