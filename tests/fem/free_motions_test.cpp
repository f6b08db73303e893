// Free motions are described in ordinary words, wherever the part lies.

#include "fem/free_motions.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "fem/rigid_body.hpp"
#include "fem/supports.hpp"
#include "tests/mesh/kuhn_box.hpp"

namespace thinwall::fem::free_motions_test {
namespace {

using Words = std::vector<std::string>;

const mesh::TetMesh block = mesh::kuhn_box({0.3, 0.2, 0.1}, {2, 2, 2});

Support plane(int axis, double at, std::vector<int> axes) {
  return {"face", mesh::PlaneRegion{at * Eigen::Vector3d::Unit(axis), Eigen::Vector3d::Unit(axis)}, std::move(axes)};
}

Words left_by(const std::vector<Support>& supports) {
  const auto nodes = mesh::lagrange_nodes(block, 2);
  return free_motions(nodes, fixed_rows(block, nodes, supports));
}

int node_at(const mesh::LagrangeNodes& nodes, const Eigen::Vector3d& x) {
  Eigen::Index node = 0;
  (nodes.positions.rowwise() - x.transpose()).rowwise().norm().minCoeff(&node);
  return static_cast<int>(node);
}

TEST(FreeMotions, OfSupportedFacesAreNamedByTheAxes) {
  EXPECT_EQ(left_by({}), (Words{"translation along x", "translation along y", "translation along z", "rotation about x",
                                "rotation about y", "rotation about z"}));
  EXPECT_EQ(left_by({plane(0, 0.0, {0, 1, 2})}), Words{});
  EXPECT_EQ(left_by({plane(2, 0.0, {2})}), (Words{"translation along x", "translation along y", "rotation about z"}));
  EXPECT_EQ(left_by({plane(0, 0.0, {0}), plane(1, 0.0, {1})}), Words{"translation along z"});
  EXPECT_EQ(left_by({plane(0, 0.0, {0}), plane(1, 0.0, {1}), plane(2, 0.0, {2})}), Words{});
}

TEST(FreeMotions, OfHeldPointsAreTurnsThroughThem) {
  const auto nodes = mesh::lagrange_nodes(block, 2);
  const int a = node_at(nodes, {0.3, 0, 0.1});
  const int b = node_at(nodes, {0.3, 0.2, 0.1});
  const Words ball = free_motions(nodes, rows_of({a}, {0, 1, 2}));
  // Each axis by its point nearest to the part's centre (0.15, 0.1, 0.05).
  EXPECT_EQ(ball, (Words{"rotation about x through (0.15, 0, 0.1)", "rotation about y through (0.3, 0.1, 0.1)",
                         "rotation about z through (0.3, 0, 0.05)"}));
  EXPECT_EQ(free_motions(nodes, rows_of({a, b}, {0, 1, 2})), Words{"rotation about y through (0.3, 0.1, 0.1)"});
  EXPECT_EQ(free_motions(nodes, rows_of({a, b}, {0, 2})),
            (Words{"translation along y", "rotation about y through (0.3, 0.1, 0.1)"}));
}

TEST(FreeMotions, OfAPartThatIsTurnedHaveItsDirections) {
  auto nodes = mesh::lagrange_nodes(block, 2);
  const std::vector<int> hinge = rows_of(
      {node_at(nodes, {0.3, 0, 0.1}), node_at(nodes, {0.3, 0.2, 0.1}), node_at(nodes, {0.3, 0.1, 0.1})}, {0, 1, 2});
  // A rotation that turns the y axis to (−0.6, 0.8, 0).
  Eigen::Matrix3d Q;
  Q << 0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1;
  nodes.positions = (nodes.positions * Q.transpose()).eval();
  nodes.positions.rowwise() += Eigen::RowVector3d(5, 0, 0);
  EXPECT_EQ(free_motions(nodes, hinge), Words{"rotation about (-0.6, 0.8, 0) through (5.18, 0.26, 0.1)"});
}

// Rows that five generic constraints hold leave one screw.
TEST(FreeMotions, ThatAdvanceAsTheyTurnAreScrews) {
  const auto nodes = mesh::lagrange_nodes(block, 1);
  const int o = node_at(nodes, {0, 0, 0});
  const int x = node_at(nodes, {0.3, 0, 0});
  const int y = node_at(nodes, {0, 0.2, 0});
  const int z = node_at(nodes, {0, 0, 0.1});
  const Words words = free_motions(nodes, {3 * y, 3 * x + 1, 3 * y + 2, 3 * o + 2, 3 * z});
  ASSERT_EQ(words.size(), 1U);
  // ω_x = 0, ω_y = −2 ω_z by hand, and ω·t = 0.6 ω_z².
  EXPECT_EQ(words[0].substr(0, 31), "screw about (0, 0.894, -0.447) ") << words[0];
}

TEST(FreeMotions, OfPiecesThatShareNoVertexSayWhichPiece) {
  mesh::TetMesh two = block;
  for (const auto& v : block.vertices) two.vertices.emplace_back(v + Eigen::Vector3d(1, 0, 0));
  for (auto tet : block.tets) {
    for (int& v : tet) v += static_cast<int>(block.vertices.size());
    two.tets.push_back(tet);
  }
  two.vertices.emplace_back(9, 9, 9);  // a vertex of no element is no piece
  const auto nodes = mesh::lagrange_nodes(two, 2);
  const auto words = free_motions(nodes, fixed_rows(two, nodes, {plane(0, 0.0, {0, 1, 2}), plane(2, 0.0, {2})}));
  EXPECT_EQ(words, (Words{"translation along x of the piece around (1.15, 0.1, 0.05)",
                          "translation along y of the piece around (1.15, 0.1, 0.05)",
                          "rotation about z of the piece around (1.15, 0.1, 0.05)"}));
  EXPECT_EQ(free_motions(nodes, std::vector<int>{}).size(), 12U);
}

TEST(FreeMotions, AreListedWithCommas) {
  EXPECT_EQ(listed({"translation along x", "rotation about z"}), "translation along x, rotation about z");
  EXPECT_EQ(listed({}), "");
}

}  // namespace
}  // namespace thinwall::fem::free_motions_test
