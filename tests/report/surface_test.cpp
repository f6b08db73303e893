#include "report/page/surface.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/mesh/solid_shapes.hpp"

namespace thinwall::report::surface_test {
namespace {

double area(const mesh::TriangleSurface& surface) {
  double sum = 0.0;
  for (const auto& t : surface.triangles) {
    const auto v = [&](std::size_t k) { return surface.vertices[static_cast<std::size_t>(t[k])]; };
    sum += 0.5 * (v(1) - v(0)).cross(v(2) - v(0)).norm();
  }
  return sum;
}

TEST(Thinned, ASurfaceThatIsSmallStaysAsItIs) {
  const mesh::TriangleSurface torus = mesh::torus(1.0, 0.2, 40, 20);
  const Thinned all = thinned(torus, torus.vertices.size());
  EXPECT_EQ(all.vertices.size(), torus.vertices.size());
  EXPECT_EQ(all.triangles, torus.triangles);
}

TEST(Thinned, KeepsTheShapeWithFewerVertices) {
  const mesh::TriangleSurface torus = mesh::torus(1.0, 0.2, 400, 120);
  for (const std::size_t most : {20000U, 4000U}) {
    const Thinned thin = thinned(torus, most);
    EXPECT_LE(thin.vertices.size(), most);
    EXPECT_GT(thin.vertices.size(), most / 3) << "no fewer than needed by far";
    mesh::TriangleSurface left{{}, thin.triangles};
    for (const int v : thin.vertices) left.vertices.push_back(torus.vertices[static_cast<std::size_t>(v)]);
    EXPECT_NEAR(area(left) / area(torus), 1.0, 0.1);
    EXPECT_EQ(thin.of_triangle.size(), thin.triangles.size());
  }
}

TEST(Quantised, IsOffByHalfAStepAtMost) {
  Eigen::MatrixXd values = Eigen::MatrixXd::Random(50, 3);
  values.col(1).array() += 10.0;
  for (const bool centred : {true, false}) {
    const Quantised grid = quantised(values, 2000, centred);
    for (Eigen::Index i = 0; i < 50; ++i) {
      for (Eigen::Index j = 0; j < 3; ++j) {
        const int n = grid.numbers[static_cast<std::size_t>(3 * i + j)];
        EXPECT_LE(std::abs(n), 2000);
        EXPECT_NEAR(grid.origin(j) + grid.step * n, values(i, j), 0.5000001 * grid.step);
      }
    }
    EXPECT_LT(grid.step, centred ? 1.0 / 1900 : 11.0 / 1900);
  }
  EXPECT_EQ(quantised(Eigen::MatrixXd::Zero(2, 3), 2000, false).numbers, std::vector<std::int16_t>(6, 0));
}

}  // namespace
}  // namespace thinwall::report::surface_test
