#include "mesh/surface/shapes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

namespace thinwall::mesh {

namespace {

/// Number of cells of about `edge` in a length; 1 for anything shorter.
int cells(double length, double edge) {
  return std::max(1, static_cast<int>(std::lround(length / edge)));
}

/// Indices of a corner of the grid.
using Corner = std::array<int, 3>;
/// The corners of a cell's face, given by its axis and side, counter-clockwise seen from outside.
std::array<Corner, 4> face_corners(const Corner& cell, int axis, int side) {
  const auto u = static_cast<std::size_t>((axis + 1) % 3);
  const auto v = static_cast<std::size_t>((axis + 2) % 3);
  Corner base = cell;
  base[static_cast<std::size_t>(axis)] += side;
  std::array<Corner, 4> corners{base, base, base, base};
  ++corners[1][u];
  ++corners[2][u];
  ++corners[2][v];
  ++corners[3][v];
  if (side == 0) std::swap(corners[1], corners[3]);
  return corners;
}

/// The surface with every vertex moved by a map of the grid's coordinates that keeps its orientation.
template <class Map>
TriangleSurface mapped(TriangleSurface surface, const Map& map) {
  for (auto& x : surface.vertices) x = map(x);
  return surface;
}

}  // namespace

TriangleSurface grid_surface(const GridLines& lines, const std::function<bool(int, int, int)>& filled) {
  const std::array<const std::vector<double>*, 3> axes{&lines.x, &lines.y, &lines.z};
  const auto is_filled = [&](const Corner& c) {
    for (std::size_t k = 0; k < 3; ++k)
      if (c[k] < 0 || c[k] + 1 >= static_cast<int>(axes[k]->size())) return false;
    return filled(c[0], c[1], c[2]);
  };
  TriangleSurface result;
  std::map<Corner, int> numbers;
  const auto number = [&](const Corner& c) {
    const auto [entry, is_new] = numbers.try_emplace(c, static_cast<int>(numbers.size()));
    if (is_new) {
      result.vertices.emplace_back(lines.x[static_cast<std::size_t>(c[0])], lines.y[static_cast<std::size_t>(c[1])],
                                   lines.z[static_cast<std::size_t>(c[2])]);
    }
    return entry->second;
  };
  const auto add_faces = [&](const Corner& cell) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int side = 0; side < 2; ++side) {
        Corner next = cell;
        next[static_cast<std::size_t>(axis)] += side == 0 ? -1 : 1;
        if (is_filled(next)) continue;
        const auto c = face_corners(cell, axis, side);
        const std::array<int, 4> v{number(c[0]), number(c[1]), number(c[2]), number(c[3])};
        result.triangles.push_back({v[0], v[1], v[2]});
        result.triangles.push_back({v[0], v[2], v[3]});
      }
    }
  };
  for (int i = 0; i + 1 < static_cast<int>(lines.x.size()); ++i)
    for (int j = 0; j + 1 < static_cast<int>(lines.y.size()); ++j)
      for (int k = 0; k + 1 < static_cast<int>(lines.z.size()); ++k)
        if (filled(i, j, k)) add_faces({i, j, k});
  return result;
}

std::vector<double> divided(double a, double b, int n) {
  std::vector<double> result;
  for (int i = 0; i <= n; ++i) result.push_back(i == n ? b : a + (b - a) * i / n);
  return result;
}

TriangleSurface block_surface(const Eigen::Vector3d& size_m, double edge_m) {
  const auto lines = [&](int axis) { return divided(0.0, size_m(axis), cells(size_m(axis), edge_m)); };
  return grid_surface({lines(0), lines(1), lines(2)}, [](int, int, int) { return true; });
}

TriangleSurface surface(const CylinderSector& sector, double edge_m) {
  const double outer = sector.inner_radius_m + sector.thickness_m;
  const GridLines lines{divided(sector.inner_radius_m, outer, cells(sector.thickness_m, edge_m)),
                        divided(0.0, sector.angle_rad, cells(sector.angle_rad * outer, edge_m)),
                        divided(0.0, sector.height_m, cells(sector.height_m, edge_m))};
  return mapped(grid_surface(lines, [](int, int, int) { return true; }), [](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(x(0) * std::cos(x(1)), x(0) * std::sin(x(1)), x(2));
  });
}

double volume(const CylinderSector& sector) {
  const double mean_radius = sector.inner_radius_m + 0.5 * sector.thickness_m;
  return sector.angle_rad * mean_radius * sector.thickness_m * sector.height_m;
}

TriangleSurface surface(const Blade& blade, double edge_m) {
  // The thickness coordinate runs over −½ … ½ of the local thickness.
  const GridLines lines{divided(-0.5, 0.5, cells(blade.root_thickness_m, edge_m)),
                        divided(-0.5 * blade.chord_m, 0.5 * blade.chord_m, cells(blade.chord_m, edge_m)),
                        divided(0.0, blade.span_m, cells(blade.span_m, edge_m))};
  return mapped(grid_surface(lines, [](int, int, int) { return true; }), [&](const Eigen::Vector3d& x) {
    const double s = x(2) / blade.span_m;
    const double thickness = blade.root_thickness_m + s * (blade.tip_thickness_m - blade.root_thickness_m);
    const Eigen::AngleAxisd turn(blade.twist_rad * s, Eigen::Vector3d::UnitZ());
    return Eigen::Vector3d(turn * Eigen::Vector3d(x(0) * thickness, x(1), x(2)));
  });
}

double volume(const Blade& blade) {
  return blade.chord_m * blade.span_m * 0.5 * (blade.root_thickness_m + blade.tip_thickness_m);
}

TriangleSurface surface(const LPocket& pocket, double edge_m) {
  const auto beyond = [&](double thickness, double length) {
    const int through = cells(thickness, edge_m);
    std::vector<double> lines = divided(0.0, thickness, through);
    const auto rest = divided(thickness, length, cells(length - thickness, edge_m));
    lines.insert(lines.end(), rest.begin() + 1, rest.end());
    return lines;
  };
  const GridLines lines{beyond(pocket.wall_m, pocket.length_m), beyond(pocket.wall_m, pocket.width_m),
                        beyond(pocket.floor_m, pocket.height_m)};
  const int wall = cells(pocket.wall_m, edge_m);
  const int floor = cells(pocket.floor_m, edge_m);
  return grid_surface(lines, [&](int i, int j, int k) { return i < wall || j < wall || k < floor; });
}

double volume(const LPocket& pocket) {
  const double open = (pocket.length_m - pocket.wall_m) * (pocket.width_m - pocket.wall_m);
  return pocket.length_m * pocket.width_m * pocket.height_m - open * (pocket.height_m - pocket.floor_m);
}

}  // namespace thinwall::mesh
