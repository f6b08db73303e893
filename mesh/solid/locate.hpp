#pragma once
// The place of a point in a mesh, and the faces under a disc on its surface.

#include <Eigen/Core>
#include <vector>

#include "mesh/tet_mesh.hpp"

namespace thinwall::mesh {

/// A tetrahedron and barycentric coordinates in it.
struct Location {
  int tet = 0;
  Eigen::Vector4d lambda = Eigen::Vector4d::Zero();
};

/// The tetrahedron that contains a point, or else the one nearest to it, and the distance by which the point was moved
/// to lie in it (0 inside).
struct Located {
  Location location;
  double distance_m = 0.0;
};
/// The place of x (part axes, m) in the mesh. Cost O(tets).
[[nodiscard]] Located locate(const TetMesh& mesh, const Eigen::Vector3d& x);

/// A disc about a point on the surface of a part, cut off where it leaves the surface; with radius 0 it is the point
/// itself.
struct Disc {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double radius_m = 0.0;
  double off_m =
      0.0;  ///< allowed distance of the mesh, which follows a curved surface by chords, from the true surface
  /// Unit vectors that choose between the faces that meet in the centre, at an edge or a corner of the part: the disc
  /// lies on the face whose normal is most nearly parallel to the first; between equals the next decides, and after the
  /// last x, y, z.
  std::vector<Eigen::Vector3d> facing{};
};

/// The face of the surface on which a disc lies.
struct DiscFace {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();  ///< the surface's point nearest to the disc's centre
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();    ///< outward normal of the triangle there
  double depth_m = 0.0;                                ///< distance from its plane within which faces belong to it
  /// Boundary triangles within reach whose normals differ from `normal` by less than 60°, which excludes the other side
  /// of a wall. The triangle with the centre is the first.
  std::vector<BoundaryTriangle> triangles;
  std::vector<Eigen::Vector3d>
      others;  ///< outward normals of the faces that meet here at 30° or more and were not taken
};

/// The face under a disc. Faces within 1e-6 of the part's diagonal from the disc's plane belong to it; if off_m > 0,
/// the depth is larger by off_m and a quarter of the radius, by which a sphere of twice the radius curves away at the
/// disc's edge. Throws InputError if the centre lies more than 1e-6 of the diagonal and off_m off the part's surface.
/// Cost O(boundary triangles).
[[nodiscard]] DiscFace disc_face(const TetMesh& mesh, const std::vector<BoundaryTriangle>& boundary, const Disc& disc);

/// The place of the centre of a disc of no radius: itself, anywhere in the part, or else, within off_m, the surface's
/// point nearest to it. Throws InputError if it lies more than 1e-6 of the part's diagonal and off_m off the part. Cost
/// O(tets).
[[nodiscard]] Location locate_on(const TetMesh& mesh, const std::vector<BoundaryTriangle>& boundary, const Disc& disc);

}  // namespace thinwall::mesh
