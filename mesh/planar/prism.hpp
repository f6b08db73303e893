#pragma once
// Prismatic parts: an outline in the x-y plane, holes, and a height from bottom to top that zones replace piecewise.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "mesh/polygon.hpp"

namespace thinwall::mesh {

/// The heights between which there is material, along z, m.
struct Extent {
  double bottom = 0.0;
  double top = 0.0;
  bool operator==(const Extent&) const = default;
};

/// A region whose extent replaces the part's: a pocket (lower top), a rib (higher top).
struct Zone {
  Polygon outline;
  double bottom = 0.0;
  double top = 0.0;
};

/// A part of piecewise constant height, in m. If zones overlap, the later one counts; holes go before all zones.
struct Prism {
  Polygon outline;
  std::vector<Polygon> holes;
  double bottom = 0.0;
  double top = 0.0;
  std::vector<Zone> zones;
};

/// Diagonal of the block around the part, m.
[[nodiscard]] double diagonal(const Prism& prism);

/// The part's extent above the point p, or nothing where there is no material.
[[nodiscard]] std::optional<Extent> extent_at(const Prism& prism, const Eigen::Vector2d& p);

/// The prism with coordinates that differ by less than 1e-9 of the diagonal made equal, axis by axis, so that the
/// numbers 0.1 + 0.2 and 0.3, for instance, give the same line.
[[nodiscard]] Prism cleaned(const Prism& prism);

/// Everything that keeps the prism from being a part, one line each, in the order of outline, holes, zones: too few or
/// repeated points, a polygon that crosses itself, no area, no thickness, a hole that touches the border or another
/// hole or lies outside, a zone that reaches outside, borders that nearly touch (within 1e-6 of the diagonal), regions
/// that share no height with their neighbours. Cost O(edges²).
[[nodiscard]] std::vector<std::string> violations(const Prism& prism);

/// Throws InputError with all violations in one line.
void validate(const Prism& prism);

/// True if an edge of the part turns inwards: a step between heights, or a corner of the outline or of a hole whose
/// angle inside the material exceeds 210°. Stresses at such an edge are singular, and unless the elements are graded
/// towards the edge from all sides the error falls with the order p as p^−4λ, λ = 0.544 at 270°, 0.5 at 360° (Williams
/// 1952).
[[nodiscard]] bool has_reentrant_edge(const Prism& prism);

/// The volume ∫ (top − bottom) dA of a valid prism, m³, over the trapezoids between its borders; exact but for
/// round-off.
[[nodiscard]] double volume(const Prism& prism);

}  // namespace thinwall::mesh
