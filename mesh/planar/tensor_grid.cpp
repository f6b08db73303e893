#include <algorithm>
#include <cmath>
#include <map>

#include "mesh/planar/edge_layers.hpp"
#include "mesh/planar/planar_mesh.hpp"

namespace thinwall::mesh {

namespace {

/// Widths of the outermost layers on the two sides of a grid line; 0: none.
struct LineLayers {
  double below = 0.0;
  double above = 0.0;
};

/// The grid lines across an axis, by coordinate, one for each border along the other axis. A line that several borders
/// share gets the narrowest of their layers.
std::map<double, LineLayers> border_lines(const BorderGraph& graph, const std::vector<BorderSide>& sides, int axis) {
  std::map<double, LineLayers> lines;
  const auto least = [](double a, double b) { return a == 0.0 ? b : (b == 0.0 ? a : std::min(a, b)); };
  for (const auto& side : sides) {
    const Eigen::Vector2d inside = inward(graph, side);
    if (std::abs(inside[axis]) < 0.5) continue;
    LineLayers& line = lines[graph.points[static_cast<std::size_t>(side.from)][axis]];
    double& width = inside[axis] > 0.0 ? line.above : line.below;
    width = least(width, side.width);
  }
  return lines;
}

/// Adds the lines of the layers in the gap between two border lines. A gap narrower than a layer gets none, because it
/// is itself a layer; in a wider one all layers of either side take at most a third.
void add_layers(double from, double to, double above, double below, const std::vector<double>& unit,
                std::vector<double>& lines) {
  if (unit.empty()) return;
  const double gap = to - from;
  const auto fitted = [&](double width) {
    return gap < 0.999 * width ? 0.0 : std::min(width, gap / (3.0 * unit.back()));
  };
  for (const double distance : unit) {
    if (fitted(above) > 0.0) lines.push_back(from + fitted(above) * distance);
    if (fitted(below) > 0.0) lines.push_back(to - fitted(below) * distance);
  }
}

/// Adds lines at both ends of a spot, unless another line is near.
void add_spots(const std::vector<Spot>& spots, int axis, std::vector<double>& lines) {
  const auto [low, high] = std::minmax_element(lines.begin(), lines.end());
  const double least = *low;
  const double most = *high;
  for (const auto& spot : spots) {
    for (const double line : {spot.at[axis] - spot.radius_m, spot.at[axis] + spot.radius_m}) {
      const bool near = std::any_of(lines.begin(), lines.end(),
                                    [&](double other) { return std::abs(other - line) < 0.5 * spot.radius_m; });
      if (!near && line > least && line < most) lines.push_back(line);
    }
  }
}

/// The wanted size of a cell at a coordinate along one axis; the other coordinate is taken to be that of the spots.
double wanted_size_across(const PrismMeshOptions& options, int axis, double coordinate) {
  double size = options.size_m;
  for (const auto& spot : options.spots)
    size = std::min(size, std::max(spot.radius_m, options.spot_growth * std::abs(coordinate - spot.at[axis])));
  return size;
}

/// All grid lines across an axis, ascending: those of borders, layers and spots, and the divisions between them.
std::vector<double> grid_lines(const BorderGraph& graph, const std::vector<BorderSide>& sides,
                               const PrismMeshOptions& options, int axis) {
  const auto borders = border_lines(graph, sides, axis);
  const auto unit = layer_distances(options.layers, options.layer_factor);
  std::vector<double> lines;
  for (auto line = borders.begin(); line != borders.end(); ++line) {
    lines.push_back(line->first);
    const auto next = std::next(line);
    if (next != borders.end())
      add_layers(line->first, next->first, line->second.above, next->second.below, unit, lines);
  }
  add_spots(options.spots, axis, lines);
  std::sort(lines.begin(), lines.end());
  std::vector<double> all{lines.front()};
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    const double a = lines[i];
    const double b = lines[i + 1];
    const auto cuts = divide(b - a, [&](double t) { return wanted_size_across(options, axis, (1.0 - t) * a + t * b); });
    for (std::size_t k = 1; k + 1 < cuts.size(); ++k) all.push_back((1.0 - cuts[k]) * a + cuts[k] * b);
    all.push_back(b);
  }
  return all;
}

/// The cells of a grid and the extents of the material in them.
struct Grid {
  std::vector<double> x;
  std::vector<double> y;
  std::vector<std::optional<Extent>> extents;  ///< x runs fastest

  [[nodiscard]] std::size_t columns() const { return x.size() - 1; }
  [[nodiscard]] std::size_t rows() const { return y.size() - 1; }
  [[nodiscard]] const std::optional<Extent>& cell(std::size_t i, std::size_t j) const {
    return extents[j * columns() + i];
  }
};

Grid grid(const Prism& prism, std::vector<double> x, std::vector<double> y) {
  Grid result{std::move(x), std::move(y), {}};
  for (std::size_t j = 0; j < result.rows(); ++j) {
    for (std::size_t i = 0; i < result.columns(); ++i) {
      const Eigen::Vector2d middle(0.5 * (result.x[i] + result.x[i + 1]), 0.5 * (result.y[j] + result.y[j + 1]));
      result.extents.push_back(extent_at(prism, middle));
    }
  }
  return result;
}

/// True if the cell's diagonal should rise from its lower left corner. The diagonal is taken that cuts off fewer
/// corners at which two borders meet; the directions alternate if both cut off equally many.
bool rising_diagonal(const Grid& grid, std::size_t i, std::size_t j) {
  const auto& own = grid.cell(i, j);
  const bool left = i == 0 || grid.cell(i - 1, j) != own;
  const bool right = i + 1 == grid.columns() || grid.cell(i + 1, j) != own;
  const bool low = j == 0 || grid.cell(i, j - 1) != own;
  const bool high = j + 1 == grid.rows() || grid.cell(i, j + 1) != own;
  const int rising = static_cast<int>(low && right) + static_cast<int>(high && left);
  const int falling = static_cast<int>(low && left) + static_cast<int>(high && right);
  return rising != falling ? rising < falling : (i + j) % 2 == 0;
}

}  // namespace

bool rectilinear(const BorderGraph& graph) {
  return std::all_of(graph.borders.begin(), graph.borders.end(), [&](const Border& border) {
    const auto [a, b] = segment(graph, border);
    return a.x() == b.x() || a.y() == b.y();
  });
}

PlanarMesh tensor_grid(const Prism& prism, const BorderGraph& graph, const PrismMeshOptions& options) {
  const BorderGraph pieces = divided(graph, [&](const Eigen::Vector2d&) { return options.size_m; });
  auto sides = border_sides(pieces);
  set_layer_widths(sides, pieces, options, 1e-6 * diagonal(prism));
  const Grid cells = grid(prism, grid_lines(pieces, sides, options, 0), grid_lines(pieces, sides, options, 1));
  PlanarMesh mesh;
  std::vector<int> number(cells.x.size() * cells.y.size(), -1);
  const auto vertex = [&](std::size_t i, std::size_t j) {
    int& index = number[j * cells.x.size() + i];
    if (index < 0) {
      index = static_cast<int>(mesh.vertices.size());
      mesh.vertices.emplace_back(cells.x[i], cells.y[j]);
    }
    return index;
  };
  for (std::size_t j = 0; j < cells.rows(); ++j) {
    for (std::size_t i = 0; i < cells.columns(); ++i) {
      const auto& extent = cells.cell(i, j);
      if (!extent) continue;
      const std::array corner{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)};
      const std::size_t first = rising_diagonal(cells, i, j) ? 0 : 1;
      mesh.triangles.push_back({corner[first], corner[first + 1], corner[(first + 2) % 4]});
      mesh.triangles.push_back({corner[first], corner[(first + 2) % 4], corner[(first + 3) % 4]});
      mesh.extents.insert(mesh.extents.end(), 2, *extent);
    }
  }
  return mesh;
}

}  // namespace thinwall::mesh
