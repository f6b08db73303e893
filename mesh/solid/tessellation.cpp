#include "mesh/solid/tessellation.hpp"

#include <algorithm>
#include <map>

namespace thinwall::mesh {

std::vector<std::array<int, 3>> surface_triangles(const LagrangeNodes& nodes,
                                                  const std::vector<BoundaryTriangle>& boundary) {
  const int p = nodes.order;
  std::map<std::array<int, 4>, Eigen::Index> local;  // lattice point → local node
  for (Eigen::Index a = 0; const auto& alpha : lattice(p)) local[alpha] = a++;
  std::vector<std::array<int, 3>> triangles;
  triangles.reserve(boundary.size() * static_cast<std::size_t>(p * p));
  for (const BoundaryTriangle& face : boundary) {
    std::array<std::size_t, 3>
        corner{};  // of the tetrahedron, in the face's order; its first four nodes are its corners
    for (std::size_t k = 0; k < 3; ++k) {
      while (nodes.elements(face.tet, static_cast<Eigen::Index>(corner[k])) != face.vertices[k]) ++corner[k];
    }
    const auto node = [&](int i, int j) {  // i steps towards the second corner, j towards the third
      std::array<int, 4> alpha{};
      alpha[corner[0]] = p - i - j;
      alpha[corner[1]] = i;
      alpha[corner[2]] = j;
      return nodes.elements(face.tet, local.at(alpha));
    };
    for (int i = 0; i < p; ++i) {
      for (int j = 0; j < p - i; ++j) {
        triangles.push_back({node(i, j), node(i + 1, j), node(i, j + 1)});
        if (i + j + 1 < p) triangles.push_back({node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
      }
    }
  }
  return triangles;
}

}  // namespace thinwall::mesh
