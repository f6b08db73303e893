// Surfaces come back from every format to the last bit, and what was damaged on the way is mended.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "io/surface/obj.hpp"
#include "io/surface/off.hpp"
#include "io/surface/ply.hpp"
#include "io/surface/stl.hpp"
#include "io/surface/surface_file.hpp"
#include "mesh/surface/closed_surface.hpp"
#include "mesh/surface/surface_repair.hpp"
#include "mesh/volume/surface_to_volume.hpp"
#include "scratch_folder.hpp"
#include "surface_bytes.hpp"
#include "tests/mesh/solid_shapes.hpp"

namespace thinwall::io::test::surface_formats_test {

namespace {

using mesh::TriangleSoup;
using mesh::TriangleSurface;

/// Coordinates below 1 in multiples of 2^-24, which single precision holds: binary STL is exact.
TriangleSurface in_single_precision(TriangleSurface surface) {
  for (auto& x : surface.vertices)
    for (int k = 0; k < 3; ++k) x(k) = std::nearbyint(x(k) * 0x1p24) * 0x1p-24;
  return surface;
}

std::vector<TriangleSurface> shapes() {
  return {in_single_precision(mesh::block_surface({0.1, 0.1, 0.1}, 0.05)),
          in_single_precision(mesh::torus(0.05, 0.02, 24, 12)), mesh::pocketed_rib()};
}

using Corners = std::array<Eigen::Vector3d, 3>;

std::vector<Corners> corners_of(const TriangleSoup& soup) {
  std::vector<Corners> all;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    all.push_back({corner(soup, t, 0), corner(soup, t, 1), corner(soup, t, 2)});
  return all;
}

class SurfaceFormats : public ScratchFolder {};

TEST_F(SurfaceFormats, ComeBackToTheLastBit) {
  for (const TriangleSurface& shape : shapes()) {
    for (const auto& [extension, bytes] : every_format(mesh::soup(shape))) {
      SCOPED_TRACE(extension + " " + bytes.substr(0, 30));
      const TriangleSoup read = read_surface(write("part" + extension, bytes), "m");
      EXPECT_TRUE(corners_of(read) == corners_of(mesh::soup(shape)));
      EXPECT_EQ(read.points.size(), shape.vertices.size()) << "equal points of STL are one";
    }
  }
}

TEST_F(SurfaceFormats, TakeTheUnitThatIsStated) {
  const TriangleSurface shape = mesh::pocketed_rib();
  for (const auto& [extension, bytes] : every_format(mesh::soup(shape))) {
    SCOPED_TRACE(extension);
    const auto file = write("part" + extension, bytes);
    for (const auto& [unit, metres] : {std::pair{"mm", 1e-3}, {"inch", 0.0254}, {"in", 0.0254}, {"m", 1.0}}) {
      const TriangleSoup read = read_surface(file, unit);
      for (std::size_t t = 0; t < read.triangles.size(); ++t)
        EXPECT_EQ(corner(read, t, 2), metres * corner(mesh::soup(shape), t, 2));
    }
    EXPECT_EQ(mesh::size_text(read_surface(file, "m")), "125 x 62.5 x 15.62 mm");
    EXPECT_EQ(mesh::size_text(read_surface(file, "inch")), "3.175 x 1.587 x 0.3969 mm") << "inches are seen";
  }
}

TEST_F(SurfaceFormats, WriteStlThatReadsBackInItsUnit) {
  const TriangleSoup soup = mesh::soup(mesh::pocketed_rib());
  for (const double metres : {1.0, 0.5, 1.0 / 1024}) {
    write_stl(path("part.stl"), soup, metres);
    EXPECT_TRUE(corners_of(read_stl(path("part.stl"), metres)) == corners_of(soup));
  }
  EXPECT_EQ(core::read_file(path("part.stl")).size(), 84 + 50 * soup.triangles.size());
  TriangleSoup huge = soup;
  huge.points[0](0) = 1e200;
  EXPECT_THROW(write_stl(path("part.stl"), huge, 1.0), core::InputError);
  EXPECT_THROW(write_stl(path("part.stl"), soup, 0.0), core::InputError);
}

/// Some triangles turned over, some twice, all with points of their own.
TriangleSoup damaged(const TriangleSurface& shape, std::mt19937& random) {
  TriangleSoup result;
  const auto add = [&](const std::array<int, 3>& t) {
    const int first = static_cast<int>(result.points.size());
    for (const int p : t) result.points.push_back(shape.vertices[static_cast<std::size_t>(p)]);
    result.triangles.push_back({first, first + 1, first + 2});
    if (random() % 2 == 0) std::swap(result.triangles.back()[0], result.triangles.back()[1]);
  };
  for (const auto& t : shape.triangles)
    for (unsigned int k = 0; k <= (random() % 8 == 0 ? 1U : 0U); ++k) add(t);
  std::shuffle(result.triangles.begin(), result.triangles.end(), random);
  return result;
}

TEST_F(SurfaceFormats, OfDamagedSurfacesAreMendedToTheSameVolume) {
  std::mt19937 random(11);
  for (const TriangleSurface& shape : shapes()) {
    for (const auto& [extension, bytes] : every_format(damaged(shape, random))) {
      SCOPED_TRACE(extension);
      const auto repair = mesh::repaired_surface(read_surface(write("part" + extension, bytes), "m"));
      EXPECT_NO_THROW(mesh::require_closed(repair.surface));
      EXPECT_EQ(repair.surface.vertices.size(), shape.vertices.size());
      EXPECT_EQ(repair.surface.triangles.size(), shape.triangles.size());
      EXPECT_NEAR(repair.volume_m3 / mesh::volume(shape), 1.0, 1e-12);
    }
  }
}

TEST_F(SurfaceFormats, FromADamagedFileToTetrahedraKeepTheVolume) {
  std::mt19937 random(12);
  const TriangleSoup broken = damaged(mesh::pocketed_rib(), random);
  write_stl(path("rib.stl"), broken, 1.0 / 1024);
  const auto repair = mesh::repaired_surface(read_stl(path("rib.stl"), 1.0 / 1024));
  const auto meshed = mesh::mesh_closed_surface(repair.surface);
  EXPECT_NEAR(mesh::volume(meshed.mesh) / mesh::pocketed_rib_volume(), 1.0, 1e-9);
}

// The dialects below are by hand; the volume of the unit cube tells that every facet was understood.
double volume_of(const TriangleSoup& soup) {
  return mesh::repaired_surface(soup).volume_m3;
}

TEST(SurfaceDialects, OfObjHaveQuadsNegativeNumbersAndContinuedLines) {
  const std::string text =
      "mtllib a.mtl\nv 0 0 0 1.0\nv 1 0 0\nv 1 1 0\nv 0 1 \\\n 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\ng side\n"
      "usemtl steel\nf 4 3 2 1\nf -4/1/1 -3/2/1 -2/3/1 -1/4/1\nf 1 2 \\\n6 5\nf 2 3 7 6\nl 1 2\nf 3// 4// 8// 7//\n"
      "f 4 1 5 8\n";
  const TriangleSoup soup = obj_surface(text, "cube.obj", 1.0);
  EXPECT_EQ(soup.triangles.size(), 12U);
  EXPECT_NEAR(volume_of(soup), 1.0, 1e-15);
}

TEST(SurfaceDialects, OfOffHaveHeadingsWithColoursOrNone) {
  const std::string faces = "4 3 2 1 0\n4 4 5 6 7 1.0 0 0\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
  const std::string counts = "8 6 12\n";
  std::string plain, coloured;
  for (const char* x : {"0 0 0", "1 0 0", "1 1 0", "0 1 0", "0 0 1", "1 0 1", "1 1 1", "0 1 1"}) {
    plain += std::string(x) + "  # a corner\r\n";
    coloured += std::string(x) + " 255 0 0 255\n";
  }
  EXPECT_NEAR(volume_of(off_surface("OFF\n" + counts + plain + faces, "cube.off", 1.0)), 1.0, 1e-15);
  EXPECT_NEAR(volume_of(off_surface("OFF " + counts + plain + faces, "cube.off", 1.0)), 1.0, 1e-15);
  EXPECT_NEAR(volume_of(off_surface("COFF\n" + counts + coloured + faces, "cube.off", 1.0)), 1.0, 1e-15);
  EXPECT_NEAR(volume_of(off_surface(counts + plain + faces, "cube.off", 1.0)), 1.0, 1e-15);
}

TEST(SurfaceDialects, OfPlyHaveOtherTypesElementsAndOrders) {
  // Faces first, with flags; vertices of integers with colours between; an element that nobody knows.
  std::string bytes =
      "ply\r\nformat binary_big_endian 1.0\r\nelement face 6\r\nproperty uchar flags\r\nproperty list ushort uchar "
      "vertex_index\r\nproperty list uchar float texcoord\r\nelement material 2\r\nproperty short shine\r\nelement "
      "vertex 8\r\nproperty short z\r\nproperty uchar red\r\nproperty float y\r\nproperty char x\r\nend_header\r\n";
  for (const char* face : {"3210", "4567", "0154", "1265", "2376", "3047"}) {
    bytes += '\7';
    append_value(bytes, std::uint16_t{4}, true);
    for (int k = 0; k < 4; ++k) bytes += static_cast<char>(face[k] - '0');
    bytes += '\1';
    append_value(bytes, 0.5F, true);
  }
  append_value(bytes, std::int16_t{-1}, true);
  append_value(bytes, std::int16_t{-1}, true);
  for (const char* x : {"000", "100", "110", "010", "001", "101", "111", "011"}) {
    append_value(bytes, static_cast<std::int16_t>(x[2] - '0'), true);
    bytes += '\x7f';
    append_value(bytes, static_cast<float>(x[1] - '0'), true);
    bytes += static_cast<char>(x[0] - '0');
  }
  EXPECT_NEAR(volume_of(ply_surface(bytes, "cube.ply", 1.0)), 1.0, 1e-15);
}

TEST(SurfaceDialects, OfStlHaveCapitalsSeveralSolidsAndNormalsThatAreNone) {
  const TriangleSoup cube = mesh::soup(mesh::block_surface({1, 1, 1}, 1));
  std::string text = ascii_stl(cube);
  for (std::size_t at = 0; (at = text.find("normal 0", at)) != std::string::npos;) text.replace(at, 8, "normal nan");
  for (char& c : text)
    if (c >= 'a' && c <= 'z' && c != 'e') c = static_cast<char>(c - 'a' + 'A');
  const TriangleSoup soup = stl_surface(text + text, "cube.stl", 1.0);
  EXPECT_EQ(soup.triangles.size(), 24U);
  EXPECT_NEAR(volume_of(soup), 1.0, 1e-15) << "the second solid doubles the first";
}

TEST(SurfaceDialects, AFacetThatTurnsInwardsIsCutFromTheCornerThatSeesAll) {
  // An L of six corners, extruded: area 3, height 1. Only from the inner corner (1, 1) does a fan fill it.
  std::string text;
  const char* outline[] = {"0 0", "2 0", "2 1", "1 1", "1 2", "0 2"};
  for (const char* z : {" 0", " 1"})
    for (const char* xy : outline) text += "v " + std::string(xy) + z + "\n";
  text += "f 6 5 4 3 2 1\nf 7 8 9 10 11 12\n";
  for (int k = 0; k < 6; ++k) {
    const int a = k + 1;
    const int b = (k + 1) % 6 + 1;
    text += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(b + 6) + " " +
            std::to_string(a + 6) + "\n";
  }
  EXPECT_NEAR(volume_of(obj_surface(text, "l.obj", 1.0)), 3.0, 1e-14);
}

TEST(SurfaceDialects, AFacetOfManyCornersIsCutFromTheOnlyOneThatSeesAll) {
  // Teeth around three quarters of the origin, which is the second of a hundred corners: only every second one is
  // compared. From a tooth the flanks of the others are hidden.
  std::string text, facet = "f";
  double twice_area = 0.0;
  Eigen::Vector2d before = Eigen::Vector2d::Zero();
  for (int k = 0; k < 99; ++k) {
    const double angle = 1.5 * std::numbers::pi * k / 98.0, radius = k % 2 == 0 ? 3.0 : 1.0;
    const Eigen::Vector2d x(radius * std::cos(angle), radius * std::sin(angle));
    text += "v " + core::number_text(x.x()) + " " + core::number_text(x.y()) + " 0\n";
    twice_area += before.x() * x.y() - before.y() * x.x();
    before = x;
  }
  text += "v 0 0 0\n";
  for (int k = 0; k < 100; ++k) facet += " " + std::to_string((k + 98) % 100 + 1);
  const TriangleSoup soup = obj_surface(text + facet + "\n", "teeth.obj", 1.0);
  ASSERT_EQ(soup.triangles.size(), 98U);
  double sum = 0.0;
  for (const auto& [a, b, c] : soup.triangles) {
    const auto& x = soup.points;
    const auto at = [&](int p) { return x[static_cast<std::size_t>(p)]; };
    const double twice = (at(b) - at(a)).cross(at(c) - at(a)).z();
    EXPECT_GT(twice, 0.0);
    sum += twice;
  }
  EXPECT_NEAR(sum, twice_area, 1e-13);
}

}  // namespace

}  // namespace thinwall::io::test::surface_formats_test
