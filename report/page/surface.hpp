#pragma once
// A surface made light: fewer vertices, whole numbers.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "mesh/faceted_surface.hpp"

namespace thinwall::report {

/// Which vertices and triangles of a surface are left.
struct Thinned {
  std::vector<int> vertices;                  ///< ascending numbers of those that stay
  std::vector<std::array<int, 3>> triangles;  ///< of numbers among those
  std::vector<int> of_triangle;               ///< for each the triangle that it was
};

/// Vertices in one cell of a grid that look into the same eighth of space become one, the first of them, with the
/// finest grid that leaves at most `most` (Rossignac & Borrel 1993); triangles that collapse are left out. All stay if
/// there are no more than that. Cost O(vertices + triangles) a grid, some ten grids.
[[nodiscard]] Thinned thinned(const mesh::TriangleSurface& surface, std::size_t most);

/// Whole numbers n with value ≈ origin + step n, |n| ≤ `largest`; rows × columns, row-major.
struct Quantised {
  std::vector<std::int16_t> numbers;
  Eigen::RowVectorXd origin;
  double step = 1.0;
};

/// Off by half a step, which is the widest column over 2 `largest`. `centred`: origin is the middle of each column,
/// else 0.
[[nodiscard]] Quantised quantised(const Eigen::Ref<const Eigen::MatrixXd>& values, int largest, bool centred);

}  // namespace thinwall::report
