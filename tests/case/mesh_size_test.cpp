// The size of a mesh as it is estimated before it is made.

#include "case/checks/mesh_size.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <variant>

#include "case/reader.hpp"
#include "tests/case/case_text.hpp"

namespace thinwall::tests::mesh_size_test {

using namespace setup;
using namespace cases;

namespace {

TEST(MeshSize, IsTheIntegralOfTheGradedSizeAroundAPoint) {
  Case c = parse_case(plate_case(), ".");
  auto& box = std::get<BoxShape>(c.part->shape);
  box.length = box.height = box.thickness = 1.0;
  c.part->mesh.element_size = 0.1;
  const double uniform = estimate_size(c).elements;
  c.points.resize(1);
  c.points[0].at = Eigen::Vector3d(0.5, 0.5, 0.5);
  c.part->mesh.point_element_size = 0.01;
  // ∫ 4πr² (1/s³ − 1/s_far³) dr to where s = a + r/2 reaches s_far (b = s_far/a): with u = s/a the first part is
  // 4π·8 [ln u + 2/u − 1/(2u²)] from 1 to b, the second 4π/3 · (2(b − 1)/b)³.
  const double b = 10.0, pi = 3.14159265358979;
  const double near = 32.0 * pi * (std::log(b) + 2.0 / b - 0.5 / (b * b) - 1.5);
  const double left_out = 4.0 * pi / 3.0 * std::pow(2.0 * (b - 1.0) / b, 3);
  const double expected = uniform + 8.485281374 * (near - left_out);
  // A cell's size varies by up to 1.5, so its share of the sum by up to 1.5³ at worst, and far less on average.
  EXPECT_NEAR(estimate_size(c).elements / expected, 1.0, 0.2);
  c.part->mesh.grading = 1.0;
  EXPECT_NEAR(estimate_size(c).elements / (uniform * 1000.0), 1.0, 1e-12);
}

TEST(MeshSize, GrowsWithTheCubeOfTheFinenessAndWithTheNodesOfTheOrder) {
  Case c = parse_case(plate_case(), ".");
  c.part->mesh.element_size = 0.002;
  c.part->mesh.order = 1;
  const PartSize coarse = estimate_size(c);
  // V · 6√2 / a³ for regular tetrahedra of edge a.
  EXPECT_NEAR(coarse.elements, 0.392 * 0.1 * 0.006 * 8.485281374 / 8e-9, 1.0);
  c.part->mesh.element_size = 0.001;
  EXPECT_NEAR(estimate_size(c).elements / coarse.elements, 8.0, 1e-12);
  c.part->mesh.order = 2;
  // A quadratic mesh has its vertices and its edges as nodes.
  EXPECT_GT(estimate_size(c).dofs, 8 * coarse.dofs * 4);
}

}  // namespace
}  // namespace thinwall::tests::mesh_size_test
