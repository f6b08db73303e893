#pragma once
// A rectangular block: its faces by name, its surface, its mass properties.

#include <Eigen/Core>
#include <array>
#include <string>

#include "mesh/faceted_surface.hpp"

namespace thinwall::mesh {

/// The block 0 ≤ x ≤ size.x, 0 ≤ y ≤ size.y, 0 ≤ z ≤ size.z, in m.
struct Box {
  Eigen::Vector3d size = Eigen::Vector3d::Zero();
};

/// The eight corners and six faces of the box.
[[nodiscard]] FacetedSurface surface(const Box& box);

/// Volume, m³.
[[nodiscard]] double volume(const Box& box);

/// The names of the six faces, "x_min", "x_max", "y_min", "y_max", "z_min", "z_max".
[[nodiscard]] const std::array<std::string, 6>& face_names();

}  // namespace thinwall::mesh
