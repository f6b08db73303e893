#include "mesh/tet_mesh.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <set>

#include "core/error.hpp"
#include "mesh/box.hpp"
#include "mesh/lagrange_nodes.hpp"
#include "mesh/volume/tetgen.hpp"
#include "tests/mesh/kuhn_box.hpp"

namespace thinwall::mesh::tet_mesh_test {
namespace {

const Eigen::Vector3d size(0.3, 0.2, 0.1);

const Eigen::Vector3d& at(const TetMesh& mesh, int vertex) {
  return mesh.vertices[static_cast<std::size_t>(vertex)];
}

Eigen::Vector3d area_vector(const TetMesh& mesh, const BoundaryTriangle& triangle) {
  const auto& v = triangle.vertices;
  return 0.5 * (at(mesh, v[1]) - at(mesh, v[0])).cross(at(mesh, v[2]) - at(mesh, v[0]));
}

TetMesh tetgen_block() {
  TetgenOptions options;
  options.element_size_m = 0.06;
  return tetrahedralise(surface(Box{size}), options);
}

TEST(TetMesh, VolumeIsTheBlocksAndEveryTetCountsPositive) {
  const TetMesh mesh = kuhn_box(size, {3, 2, 2});
  for (int tet = 0; tet < static_cast<int>(mesh.tets.size()); ++tet)
    EXPECT_NEAR(volume(mesh, tet), size.prod() / 72, 1e-18);
  EXPECT_NEAR(volume(mesh), size.prod(), 1e-16);
}

TEST(TetMesh, BoundaryIsClosedFacesOutwardsAndEnclosesTheVolume) {
  const TetMesh mesh = kuhn_box(size, {3, 2, 2});
  const auto triangles = boundary(mesh);
  EXPECT_EQ(triangles.size(), 4U * (3 * 2 + 3 * 2 + 2 * 2));
  Eigen::Vector3d closed = Eigen::Vector3d::Zero();
  double enclosed = 0.0;
  double area = 0.0;
  for (const auto& triangle : triangles) {
    const Eigen::Vector3d a = area_vector(mesh, triangle);
    closed += a;
    area += a.norm();
    enclosed += a.dot(at(mesh, triangle.vertices[0])) / 3.0;
    EXPECT_GT(a.dot(at(mesh, triangle.vertices[0]) - 0.5 * size), 0.0) << "outwards, of a convex block";
  }
  EXPECT_LT(closed.norm(), 1e-16);
  EXPECT_NEAR(area, 2 * (0.06 + 0.03 + 0.02), 1e-15);
  EXPECT_NEAR(enclosed, size.prod(), 1e-16);
}

TEST(TetMesh, MeanRatioIsOneForTheRegularAndNoughtForTheFlatTet) {
  TetMesh mesh;
  mesh.vertices = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.tets = {{0, 2, 1, 3}, {4, 5, 6, 7}};
  if (volume(mesh, 0) < 0) std::swap(mesh.tets[0][2], mesh.tets[0][3]);
  EXPECT_NEAR(mean_ratio(mesh, 0), 1.0, 1e-14);
  EXPECT_EQ(mean_ratio(mesh, 1), 0.0);
  // Kuhn's tet of the unit cube: V = 1/6, Σ l² = 3·1 + 2·2 + 3.
  EXPECT_NEAR(mean_ratio(kuhn_box({1, 1, 1}, {1, 1, 1}), 0), 12.0 * std::pow(0.5, 2.0 / 3.0) / 10.0, 1e-14);
}

/// V + E (p−1) + F (p−1)(p−2)/2 + T (p−1)(p−2)(p−3)/6: nodes on vertices, inside edges, faces, tetrahedra.
Eigen::Index conforming_count(const TetMesh& mesh, int p) {
  std::set<std::set<int>> edges;
  std::set<std::set<int>> faces;
  for (const auto& t : mesh.tets) {
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) {
        edges.insert({t[i], t[j]});
        for (std::size_t k = j + 1; k < 4; ++k) faces.insert({t[i], t[j], t[k]});
      }
    }
  }
  const auto count = [](std::size_t n, int each) { return static_cast<Eigen::Index>(n) * each; };
  return count(mesh.vertices.size(), 1) + count(edges.size(), p - 1) + count(faces.size(), (p - 1) * (p - 2) / 2) +
         count(mesh.tets.size(), (p - 1) * (p - 2) * (p - 3) / 6);
}

TEST(LagrangeNodes, AreAsManyAsAConformingMeshHas) {
  const TetMesh unstructured = tetgen_block();
  const TetMesh structured = kuhn_box(size, {3, 2, 2});
  for (int p = 1; p <= 6; ++p) {
    EXPECT_EQ(lagrange_nodes(unstructured, p).positions.rows(), conforming_count(unstructured, p)) << "order " << p;
    EXPECT_EQ(lagrange_nodes(structured, p).positions.rows(), (3 * p + 1) * (2 * p + 1) * (2 * p + 1)) << "order " << p;
  }
}

TEST(LagrangeNodes, LieWhereTheirWeightsSayInEveryElementThatSharesThem) {
  const TetMesh mesh = tetgen_block();
  for (int p = 1; p <= 6; ++p) {
    const LagrangeNodes nodes = lagrange_nodes(mesh, p);
    const auto alphas = lattice(p);
    ASSERT_EQ(static_cast<int>(alphas.size()), (p + 1) * (p + 2) * (p + 3) / 6);
    double worst = 0.0;
    for (Eigen::Index e = 0; e < nodes.elements.rows(); ++e) {
      for (std::size_t a = 0; a < alphas.size(); ++a) {
        Eigen::Vector3d x = Eigen::Vector3d::Zero();
        for (std::size_t k = 0; k < 4; ++k) x += alphas[a][k] * at(mesh, mesh.tets[static_cast<std::size_t>(e)][k]) / p;
        const auto node = nodes.elements(e, static_cast<Eigen::Index>(a));
        worst = std::max(worst, (nodes.positions.row(node).transpose() - x).norm());
      }
    }
    EXPECT_LT(worst, 1e-15) << "order " << p;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      ASSERT_EQ(nodes.positions.row(static_cast<Eigen::Index>(v)).transpose(), mesh.vertices[v])
          << "vertices come first";
    }
  }
}

TEST(LagrangeNodes, OrdersOutsideOneToSixAreRefused) {
  EXPECT_THROW((void)lagrange_nodes(kuhn_box(size, {1, 1, 1}), 0), core::InputError);
  EXPECT_THROW((void)lagrange_nodes(kuhn_box(size, {1, 1, 1}), 7), core::InputError);
}

}  // namespace
}  // namespace thinwall::mesh::tet_mesh_test
