#include "mesh/surface/closed_surface.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "core/error.hpp"
#include "mesh/surface/shapes.hpp"

namespace thinwall::mesh::closed_surface_test {
namespace {

std::string message(const TriangleSurface& surface) {
  try {
    require_closed(surface);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "no error";
}

void expect_named(const TriangleSurface& surface, const std::string& what, const std::string& where) {
  const std::string text = message(surface);
  EXPECT_NE(text.find(what), std::string::npos) << text;
  EXPECT_NE(text.find(where), std::string::npos) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos) << "one line";
}

TriangleSurface block() {
  return block_surface({0.1, 0.1, 0.1}, 0.1);
}

/// Both surfaces in one, the second moved.
TriangleSurface joined(TriangleSurface a, const TriangleSurface& b, const Eigen::Vector3d& by) {
  const int offset = static_cast<int>(a.vertices.size());
  for (const auto& x : b.vertices) a.vertices.emplace_back(x + by);
  for (const auto& t : b.triangles) a.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  return a;
}

TEST(ClosedSurface, AMissingTriangleIsAnOpenSurfaceAtItsEdges) {
  TriangleSurface open = block_surface({0.1, 0.1, 0.1}, 0.05);
  const int removed = static_cast<int>(open.triangles.size()) - 1;
  const Eigen::Vector3d middle = centroid(open, removed);
  EXPECT_NEAR(middle(2), 0.1, 1e-15) << "the triangle removed lies on the top";
  open.triangles.pop_back();
  expect_named(open, "open", "100) mm");
}

TEST(ClosedSurface, ATriangleTheOtherWayRoundIsNamed) {
  TriangleSurface turned = block();
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  expect_named(turned, "changes its orientation", "(0, ");
}

TEST(ClosedSurface, InsideOutIsNamedWithItsVolume) {
  TriangleSurface inside_out = block();
  for (auto& t : inside_out.triangles) std::swap(t[0], t[1]);
  expect_named(inside_out, "inside out", "-1000000.0");
}

TEST(ClosedSurface, TwoBodiesAreNamedWithAPointOfEach) {
  expect_named(joined(block(), block(), {1.0, 0.0, 0.0}), "several separate pieces", "(1000, 0, 0) mm");
}

TEST(ClosedSurface, AWallWithoutThicknessIsNamed) {
  TriangleSurface sheet;
  sheet.vertices = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0.1, 0.1, 0}};
  sheet.triangles = {{0, 1, 2}, {1, 3, 2}, {0, 2, 1}, {1, 2, 3}};
  const std::string text = message(sheet);
  EXPECT_NE(text.find("mm"), std::string::npos) << text;
  EXPECT_NE(text, "no error");
  // A block pressed flat keeps its side faces as triangles without area.
  expect_named(block_surface({0.1, 0.1, 0.0}, 0.1), "without area", ", 0) mm");
  // A wall of a millionth of a millimetre.
  expect_named(block_surface({0.1, 0.1, 1e-12}, 0.1), "without thickness", "mm³");
}

TEST(ClosedSurface, SelfIntersectionIsNamedWithBothTriangles) {
  // One corner of a block pushed through the opposite face.
  TriangleSurface crossed = block_surface({0.1, 0.1, 0.02}, 0.02);
  for (auto& x : crossed.vertices)
    if ((x - Eigen::Vector3d(0.04, 0.04, 0.02)).norm() < 1e-9) x(2) = -0.01;
  expect_named(crossed, "intersects itself", ") mm and (");
}

TEST(ClosedSurface, VerticesThatAreNotNumbersAreNamed) {
  TriangleSurface bad = block();
  bad.vertices[3](1) = std::numeric_limits<double>::quiet_NaN();
  expect_named(bad, "not finite", "mm");
  expect_named({}, "no triangles", "closed");
}

}  // namespace
}  // namespace thinwall::mesh::closed_surface_test
