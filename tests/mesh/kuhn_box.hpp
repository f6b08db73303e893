#pragma once
// A structured mesh of a block, the same cell everywhere, so that refinement is uniform and halves fit together.

#include <array>

#include "mesh/tet_mesh.hpp"

namespace thinwall::mesh {

/// The block 0…size (m) cut into cells, each into the six tetrahedra around its diagonal (Kuhn 1960): a tetrahedron for
/// each order in which a path along the edges can take the three axes. Translated cells conform.
inline TetMesh kuhn_box(const Eigen::Vector3d& size, const std::array<int, 3>& cells) {
  TetMesh mesh;
  const auto [nx, ny, nz] = cells;
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) {
        mesh.vertices.emplace_back(size.x() * i / nx, size.y() * j / ny, size.z() * k / nz);
      }
    }
  }
  const std::array<int, 3> step{1, nx + 1, (nx + 1) * (ny + 1)};
  // Even permutations first; an odd one turns the tetrahedron inside out, which swapping its last two vertices mends.
  constexpr std::array<std::array<std::size_t, 3>, 6> paths{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        const int a = i * step[0] + j * step[1] + k * step[2];
        for (std::size_t p = 0; p < paths.size(); ++p) {
          const int b = a + step[paths[p][0]];
          const int c = b + step[paths[p][1]];
          const int d = c + step[paths[p][2]];
          mesh.tets.push_back(p < 3 ? std::array{a, b, c, d} : std::array{a, b, d, c});
        }
      }
    }
  }
  return mesh;
}

}  // namespace thinwall::mesh
