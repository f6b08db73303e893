#pragma once
// Blocks of hexahedra or wedges as a file could hold them: numbers in random order, with gaps.

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <random>

#include "mesh/solid/labelled_mesh.hpp"

namespace thinwall::mesh {

/// Where a point of the unit cube's grid goes, m.
using PointMap = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

/// nx × ny × nz cells, each a hexahedron of 8, 20 or 27 nodes, or two wedges of 6, 15 or 18. Points at halves of the
/// cells are nodes of order 2. Labels are random, the same for the same seed. The set "LEFT" holds the nodes of cells
/// at x = 0 of the cube, "FIRST" the first cell.
class LabelledGrid {
 public:
  LabelledGrid(const std::array<int, 3>& cells, CellShape shape, std::size_t nodes, PointMap map, unsigned seed = 1)
      : cells_(cells), shape_(shape), nodes_(nodes), random_(seed) {
    const auto [nx, ny, nz] = cells;
    label_.resize(static_cast<std::size_t>((2 * nx + 1) * (2 * ny + 1) * (2 * nz + 1)));
    std::iota(label_.begin(), label_.end(), 1);
    std::shuffle(label_.begin(), label_.end(), random_);
    used_.resize(label_.size(), false);
    mesh.path = "grid";
    mesh.node_sets.push_back({"LEFT", {}});
    for (int k = 0; k < nz; ++k)
      for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) add_cell(i, j, k);
    mesh.cell_sets.push_back({"FIRST", {mesh.cells.front().label}});
    add_nodes(map);
  }

  LabelledMesh mesh;

 private:
  using Point = std::array<int, 3>;  ///< in halves of a cell

  std::size_t index(const Point& p) const {
    return static_cast<std::size_t>(p[0] + (2 * cells_[0] + 1) * (p[1] + (2 * cells_[1] + 1) * p[2]));
  }

  void add_cell(int i, int j, int k) {
    const auto at = [&](int x, int y, int z) { return Point{2 * (i + x), 2 * (j + y), 2 * (k + z)}; };
    const std::vector<Point> hex{at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0),
                                 at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)};
    if (shape_ == CellShape::hexahedron) {
      add(hex);
    } else {
      add({hex[0], hex[1], hex[2], hex[4], hex[5], hex[6]});
      add({hex[0], hex[2], hex[3], hex[4], hex[6], hex[7]});
    }
  }

  static Point mean(const std::vector<Point>& points) {
    Point sum{};
    for (const Point& p : points)
      for (std::size_t a = 0; a < 3; ++a) sum[a] += p[a];
    for (int& x : sum) x /= static_cast<int>(points.size());
    return sum;
  }

  void add(std::vector<Point> points) {
    const CellTopology& cell = topology(shape_);
    const std::vector<Point> corners = points;
    for (const auto& [a, b] : cell.edges) points.push_back(mean({corners[a], corners[b]}));
    for (const auto& face : cell.faces)
      if (face.size() == 4)
        points.push_back(mean({corners[face[0]], corners[face[1]], corners[face[2]], corners[face[3]]}));
    points.push_back(mean(corners));
    points.resize(nodes_);
    mesh.cells.push_back(
        {static_cast<std::int64_t>(1000 - mesh.cells.size()), 0, shape_, mesh.cell_nodes.size(), nodes_});
    for (const Point& p : points) {
      mesh.cell_nodes.push_back(7 * label_[index(p)]);
      used_[index(p)] = true;
      if (p[0] == 0) mesh.node_sets.front().labels.push_back(7 * label_[index(p)]);
    }
  }

  void add_nodes(const PointMap& map) {
    for (int z = 0; z <= 2 * cells_[2]; ++z)
      for (int y = 0; y <= 2 * cells_[1]; ++y)
        for (int x = 0; x <= 2 * cells_[0]; ++x) {
          const std::size_t i = index({x, y, z});
          const Eigen::Vector3d unit(0.5 * x / cells_[0], 0.5 * y / cells_[1], 0.5 * z / cells_[2]);
          if (used_[i]) mesh.nodes.push_back({7 * label_[i], 0, map(unit)});
        }
    std::shuffle(mesh.nodes.begin(), mesh.nodes.end(), random_);
  }

  std::array<int, 3> cells_;
  CellShape shape_;
  std::size_t nodes_;
  std::mt19937 random_;
  std::vector<std::int64_t> label_;
  std::vector<bool> used_;
};

}  // namespace thinwall::mesh
