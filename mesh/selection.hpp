#pragma once
// Faces chosen by their place.

#include <Eigen/Core>
#include <string>
#include <variant>
#include <vector>

#include "mesh/box.hpp"
#include "mesh/lagrange_nodes.hpp"
#include "mesh/tet_mesh.hpp"

namespace thinwall::mesh {

/// All boundary faces in the plane through `point` (m) with the given normal.
struct PlaneRegion {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
};

/// All boundary faces inside the axis-parallel block from `min` to `max` (m).
struct BoxRegion {
  Eigen::Vector3d min = Eigen::Vector3d::Zero();
  Eigen::Vector3d max = Eigen::Vector3d::Zero();
};

/// All boundary faces inside the ball (m).
struct SphereRegion {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0.0;
};

/// The region that selects faces of a part.
using Region = std::variant<PlaneRegion, BoxRegion, SphereRegion>;

/// The plane of a box's face by its name ("y_min"). Throws InputError, which proposes the nearest name, for another
/// name.
[[nodiscard]] Region face_of(const Box& box, const std::string& name);

/// The boundary triangles with all three corners in the region, within 1e-6 of the part's diagonal. Throws InputError
/// for a region that contains no face, or every face, with the part's extents and the distance of the nearest face;
/// `name` is the name that the user gave the region.
[[nodiscard]] std::vector<BoundaryTriangle> select(const TetMesh& mesh, const std::vector<BoundaryTriangle>& boundary,
                                                   const Region& region, const std::string& name);

/// The nodes (ascending) on the selected triangles.
[[nodiscard]] std::vector<int> nodes_on(const LagrangeNodes& nodes, const TetMesh& mesh,
                                        const std::vector<BoundaryTriangle>& triangles);

}  // namespace thinwall::mesh
