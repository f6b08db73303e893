// 3MF files, made by hand from the specifications of the format and of ZIP.

#include "io/surface/three_mf.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <string>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/surface/surface_file.hpp"
#include "scratch_folder.hpp"
#include "zip_bytes.hpp"

namespace thinwall::io::three_mf_test {
namespace {

using test::zip_of;

const std::string tetrahedron =
    "<mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"3\" y=\"0\" z=\"0\"/><vertex x=\"0\" y=\"2\" "
    "z=\"0\"/><vertex x=\"0\" y=\"0\" z=\"1.0e+1\"/></vertices><triangles><triangle v1=\"0\" v2=\"2\" "
    "v3=\"1\"/><triangle "
    "v1=\"0\" v2=\"1\" v3=\"3\"/><triangle v1=\"1\" v2=\"2\" v3=\"3\"/><triangle v1=\"2\" v2=\"0\" "
    "v3=\"3\"/></triangles></mesh>";

std::string model(const std::string& unit, const std::string& objects, const std::string& items) {
  return "<?xml version=\"1.0\"?>\n<model " + unit +
         " xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\"><resources>" + objects +
         "</resources><build>" + items + "</build></model>";
}

std::string object(const std::string& id, const std::string& content, const std::string& more = "") {
  return "<object id=\"" + id + "\" " + more + ">" + content + "</object>";
}

std::string item(const std::string& id, const std::string& transform = "") {
  return "<item objectid=\"" + id + "\"" + (transform.empty() ? "" : " transform=\"" + transform + "\"") + "/>";
}

std::string file_of(const std::string& text, bool packed = true) {
  return zip_of({{"[Content_Types].xml", "<Types/>"}, {"3D/3dmodel.model", text}}, packed);
}

/// The volume that outward triangles enclose, m³ (Gauss).
double volume(const mesh::TriangleSoup& soup) {
  double sum = 0.0;
  for (const auto& t : soup.triangles) {
    const auto x = [&](std::size_t k) { return soup.points[static_cast<std::size_t>(t[k])]; };
    sum += x(0).dot(x(1).cross(x(2))) / 6.0;
  }
  return sum;
}

std::string refusal(const std::string& bytes) {
  return test::message_of<core::DataError>([&] { (void)three_mf_surface(bytes, "part.3mf"); });
}

TEST(ThreeMf, IsReadInItsUnitPackedOrNot) {
  for (const bool packed : {true, false}) {
    const auto read = three_mf_surface(file_of(model("", object("1", tetrahedron), item("1")), packed), "part.3mf");
    EXPECT_EQ(read.unit, "mm");
    EXPECT_EQ(read.soup.triangles.size(), 4U);
    EXPECT_NEAR(volume(read.soup), 10e-9, 1e-21) << "3 · 2 · 10 / 6 mm³";
  }
  const auto inches =
      three_mf_surface(file_of(model("unit=\"inch\"", object("1", tetrahedron), item("1"))), "part.3mf");
  EXPECT_NEAR(volume(inches.soup) / (10.0 * 0.0254 * 0.0254 * 0.0254), 1.0, 1e-12);
}

// A component is turned by 90 degrees about z and shifted, its item mirrored; a support of the print is left out.
TEST(ThreeMf, ObjectsStandWhereTheBuildPlacesThem) {
  const std::string objects = object("1", tetrahedron) + object("8", tetrahedron, "type=\"support\"") +
                              object("2",
                                     "<components><component objectid=\"1\" transform=\"0 1 0 -1 0 0 0 0 1 5 0 0\"/>"
                                     "<component objectid=\"1\"/></components>");
  const auto read = three_mf_surface(
      file_of(model("", objects, item("2", "1 0 0 0 1 0 0 0 -1 0 0 100") + item("8") + item("1"))), "part.3mf");
  EXPECT_EQ(read.soup.triangles.size(), 12U);
  EXPECT_NEAR(volume(read.soup), 30e-9, 1e-20) << "a mirrored body has its facets turned outwards";
  // (3, 0, 0) turns to (0, 3, 0), is shifted to (5, 3, 0), and mirrored in z about 50.
  EXPECT_LT((read.soup.points[1] - Eigen::Vector3d(0.005, 0.003, 0.1)).norm(), 1e-15);
}

TEST(ThreeMf, WhatIsWrongIsSaid) {
  const std::string good = file_of(model("", object("1", tetrahedron), item("1")));
  EXPECT_NE(refusal("solid x").find("part.3mf: is no ZIP archive"), std::string::npos);
  EXPECT_NE(refusal(good.substr(0, good.size() / 2)).find("is no ZIP archive, or not whole"), std::string::npos);
  std::string flipped = good;
  flipped[flipped.find("3D/3dmodel.model") + 40] ^= 0x10;
  EXPECT_NE(refusal(flipped).find("is damaged"), std::string::npos);
  EXPECT_NE(refusal(zip_of({{"a.txt", "x"}}, true)).find("holds no model"), std::string::npos);
  EXPECT_NE(refusal(file_of("<model><a></model>")).find("is no XML"), std::string::npos);
  const auto of = [](const std::string& unit, const std::string& objects, const std::string& items) {
    return refusal(file_of(model(unit, objects, items)));
  };
  EXPECT_NE(of("unit=\"mile\"", object("1", tetrahedron), item("1")).find("the unit \"mile\" is none of"),
            std::string::npos);
  EXPECT_NE(of("", object("1", tetrahedron), item("2")).find("the object \"2\" is not there"), std::string::npos);
  EXPECT_NE(of("", object("1", tetrahedron), "").find("places no object with triangles"), std::string::npos);
  EXPECT_NE(of("", object("1", "<components><component objectid=\"1\"/></components>"), item("1")).find("holds itself"),
            std::string::npos);
  std::string far = tetrahedron;
  far.replace(far.find("v3=\"3\""), 6, "v3=\"4\"");
  EXPECT_NE(of("", object("1", far), item("1")).find("names vertex 4 of 4"), std::string::npos);
  EXPECT_NE(of("", object("1", tetrahedron), item("1", "1 0 0")).find("not of twelve numbers"), std::string::npos);
  std::string many;
  for (int i = 0; i < 30; ++i) {
    const std::string next = "<component objectid=\"" + std::to_string(i + 1) + "\"/>";
    many += object(std::to_string(i), "<components>" + next + next + "</components>");
  }
  EXPECT_NE(of("", many + object("30", "<components/>"), item("0")).find("more than 100000 objects"),
            std::string::npos);
}

using ThreeMfFile = test::ScratchFolder;

TEST_F(ThreeMfFile, StatesItsUnitWhichTheCallersMustAgreeWith) {
  core::write_file_atomically(path("part.3mf"), file_of(model("", object("1", tetrahedron), item("1"))));
  for (const char* unit : {"", "mm"}) EXPECT_NEAR(volume(read_surface(path("part.3mf"), unit)), 10e-9, 1e-20);
  EXPECT_THROW((void)read_surface(path("part.3mf"), "inch"), core::InputError);
}

}  // namespace
}  // namespace thinwall::io::three_mf_test
