#include "mesh/curve_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <vector>

#include "mesh/pieces.hpp"
#include "tests/mesh/kuhn_box.hpp"

namespace thinwall::mesh::curve_order_test {
namespace {

using Corners = std::array<std::array<double, 3>, 4>;

/// Each tetrahedron by the coordinates of its vertices, in their order.
std::multiset<Corners> as_points(const TetMesh& mesh) {
  std::multiset<Corners> all;
  for (const auto& tet : mesh.tets) {
    Corners corners{};
    for (std::size_t k = 0; k < 4; ++k) {
      const Eigen::Vector3d& v = mesh.vertices[static_cast<std::size_t>(tet[k])];
      corners[k] = {v.x(), v.y(), v.z()};
    }
    all.insert(corners);
  }
  return all;
}

/// Sum over the tetrahedra of the span of their vertex numbers.
long spread(const TetMesh& mesh) {
  long sum = 0;
  for (const auto& tet : mesh.tets) {
    const auto [low, high] = std::minmax_element(tet.begin(), tet.end());
    sum += *high - *low;
  }
  return sum;
}

TEST(OrderAlongCurve, KeepsTheTetrahedraDropsLoneVerticesAndBringsNeighboursTogether) {
  TetMesh mesh = kuhn_box({2.0, 1.0, 1.0}, {12, 6, 6});
  std::mt19937 random(7);
  std::shuffle(mesh.tets.begin(), mesh.tets.end(), random);
  std::vector<int> number(mesh.vertices.size());
  for (std::size_t v = 0; v < number.size(); ++v) number[v] = static_cast<int>(v);
  std::shuffle(number.begin(), number.end(), random);
  std::vector<Eigen::Vector3d> moved(mesh.vertices.size());
  for (std::size_t v = 0; v < number.size(); ++v) moved[static_cast<std::size_t>(number[v])] = mesh.vertices[v];
  for (auto& tet : mesh.tets) {
    for (int& v : tet) v = number[static_cast<std::size_t>(v)];
  }
  mesh.vertices = moved;
  mesh.vertices.emplace_back(9.0, 9.0, 9.0);
  TetMesh ordered = mesh;
  order_along_curve(ordered);
  EXPECT_EQ(ordered.vertices.size(), mesh.vertices.size() - 1);
  EXPECT_EQ(as_points(ordered), as_points(mesh)) << "with their orientation";
  EXPECT_LT(4 * spread(ordered), spread(mesh));
  TetMesh again = mesh;
  order_along_curve(again);
  EXPECT_EQ(again.tets, ordered.tets) << "the same every time";
}

TEST(Pieces, AreNamedByTheirLowestVertexWhateverTheOrderOfTheCells) {
  const std::vector<std::array<int, 2>> chain{{6, 5}, {4, 5}, {3, 4}, {8, 1}};
  EXPECT_EQ(pieces(9, chain), (std::vector<int>{0, 1, 2, 3, 3, 3, 3, 7, 1}));
  EXPECT_EQ(pieces(2, std::vector<std::array<int, 3>>{}), (std::vector<int>{0, 1}));
}

}  // namespace
}  // namespace thinwall::mesh::curve_order_test
