#pragma once
// Thin-walled parts given by formulas, as closed triangulated surfaces for tests and timings.

#include <functional>
#include <vector>

#include "mesh/faceted_surface.hpp"

namespace thinwall::mesh {

/// Lines of a rectangular grid, ascending, m.
struct GridLines {
  std::vector<double> x, y, z;
};

/// The outward surface of all cells (i, j, k) of a grid for which `filled` holds, with two triangles for each cell
/// face. The surface is not a manifold if cells touch in an edge or a corner only, which the shapes below avoid.
[[nodiscard]] TriangleSurface grid_surface(const GridLines& lines, const std::function<bool(int, int, int)>& filled);

/// The n + 1 ends of n equal cells from a to b.
[[nodiscard]] std::vector<double> divided(double a, double b, int n);

/// The surface of the block [0, lx] × [0, ly] × [0, lz] with triangles of about `edge_m`, one cell through anything
/// thinner.
[[nodiscard]] TriangleSurface block_surface(const Eigen::Vector3d& size_m, double edge_m);

/// A wall bent over an angle about the z axis: inner_radius ≤ r ≤ inner_radius + thickness, 0 ≤ φ ≤ angle (below 2π),
/// 0 ≤ z ≤ height. The true volume is angle/2 (r_o² − r_i²) height; the triangulated one with n cells over the angle is
/// sin(δ)/δ of it, δ = angle/n.
struct CylinderSector {
  double inner_radius_m = 0.1;
  double thickness_m = 0.003;
  double angle_rad = 1.5707963267948966;
  double height_m = 0.08;
};
/// The surface of a cylinder sector, with edges of about `edge_m`.
[[nodiscard]] TriangleSurface surface(const CylinderSector& sector, double edge_m);
/// The volume of a cylinder sector in closed form, m³.
[[nodiscard]] double volume(const CylinderSector& sector);

/// A wall that stands on z = 0 with a rectangular section chord × thickness(z), thickness linear in z, turned about the
/// z axis by twist · z / span. Every section keeps its area, so the true volume is chord · span · (root + tip) / 2.
struct Blade {
  double chord_m = 0.06;
  double span_m = 0.12;
  double root_thickness_m = 0.006;
  double tip_thickness_m = 0.003;
  double twist_rad = 0.5235987755982988;
};
/// The surface of a blade, with edges of about `edge_m`.
[[nodiscard]] TriangleSurface surface(const Blade& blade, double edge_m);
/// The volume of a blade, m³.
[[nodiscard]] double volume(const Blade& blade);

/// A corner of a pocket: a floor 0 ≤ z ≤ floor and two walls, x ≤ wall and y ≤ wall, on 0 ≤ x ≤ length, 0 ≤ y ≤ width,
/// 0 ≤ z ≤ height. Its faces are planar, so that the triangulated surface is exact.
struct LPocket {
  double length_m = 0.12;
  double width_m = 0.1;
  double height_m = 0.05;
  double wall_m = 0.003;
  double floor_m = 0.004;
};
/// The surface of a pocket, with edges of about `edge_m`.
[[nodiscard]] TriangleSurface surface(const LPocket& pocket, double edge_m);
/// The volume of a pocket in closed form, m³.
[[nodiscard]] double volume(const LPocket& pocket);

}  // namespace thinwall::mesh
