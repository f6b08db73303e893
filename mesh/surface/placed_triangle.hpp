#pragma once
// A vertex of a new surface mesh in the space of wanted edges, and what triangles of such vertices are worth.

#include <Eigen/Core>

#include "mesh/surface/size_space.hpp"

namespace thinwall::mesh {

/// A vertex as a point of one of its patches.
struct Place {
  int patch = -1;
  Eigen::Vector3d x = Eigen::Vector3d::Zero();       ///< m
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< of the patch there, unit length
  Eigen::VectorXd wanted;                            ///< SizeSpace::at()
};

/// The place of x, m, on a patch. Cost: that of SizeSpace::at().
[[nodiscard]] Place make_place(const SizeSpace& space, int patch, const Eigen::Vector3d& x);

/// Number of wanted edges between two places. It is measured in two halves, because the middle of an edge from border
/// to border lies outside the layers, while its ends have equal coordinates in them.
[[nodiscard]] double length(const SizeSpace& space, const Place& a, const Place& b);

/// The quality of a triangle in wanted edges: 1 if all three are equal, 0 for a triangle without area (4√3 A / Σ l²; A
/// by Heron's formula).
[[nodiscard]] double quality(const SizeSpace& space, const Place& a, const Place& b, const Place& c);

/// True if the triangle has an area and turns no more than 45° from the surface's normals at its corners.
[[nodiscard]] bool faces_outwards(const Place& a, const Place& b, const Place& c);

/// True if the triangle represents its piece of the patch: its orientation fits, and its centre and the middles of its
/// edges lie near the patch.
[[nodiscard]] bool is_faithful(const SizeSpace& space, const Place& a, const Place& b, const Place& c);

}  // namespace thinwall::mesh
