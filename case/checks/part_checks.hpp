#pragma once
// Checks of the part's geometry, mesh, supports and points.

#include "case/checks/findings.hpp"
#include "case/machining_case.hpp"

namespace thinwall::cases {

/// Reports every problem of the part that shows between its keys.
void check_part(const Case& source, Findings& findings);

/// Names of the points that the part has: those of [points], or those that its measured FRFs name.
[[nodiscard]] std::vector<std::string> part_points(const Case& source);

/// "(…) lies outside the part, which reaches from …" for a position (m) off the block around the part (before it is
/// bent), more than 1e-4 of the diagonal outside a file's surface or, with a patch (radius, m; 0: none), off it; or ""
/// if it lies within or the part is not known well enough. Cost O(triangles of the surface).
[[nodiscard]] std::string outside_part(const setup::Part& part, const Eigen::Vector3d& p, double patch_radius);

/// Name of the support that holds the point in the direction, or "" if it is free to move (or not known well enough).
[[nodiscard]] std::string clamped_by(const setup::PartSetup& source, const std::string& point,
                                     const Eigen::Vector3d& direction);

/// True if at most three directions are given and none follows from the others.
[[nodiscard]] bool independent(const std::vector<Eigen::Vector3d>& directions);

/// Directions in which the point can be loaded and watched: those of [points], or those that measured FRFs name there.
[[nodiscard]] std::vector<Eigen::Vector3d> directions_at(const Case& source, const std::string& point);

/// True if `direction` is a combination of `directions`.
[[nodiscard]] bool spanned(const std::vector<Eigen::Vector3d>& directions, const Eigen::Vector3d& direction);

/// Direction of "P.x"; none if the name has none that can be read.
[[nodiscard]] std::optional<Eigen::Vector3d> direction_of(const std::string& dof);

}  // namespace thinwall::cases
