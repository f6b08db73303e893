// Files of surfaces that are not sound are refused in one line: file, line or byte, what, what to do.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "core/error.hpp"
#include "io/surface/obj.hpp"
#include "io/surface/off.hpp"
#include "io/surface/ply.hpp"
#include "io/surface/stl.hpp"
#include "io/surface/surface_file.hpp"
#include "mesh/surface/surface_repair.hpp"
#include "scratch_folder.hpp"
#include "surface_bytes.hpp"
#include "tests/mesh/solid_shapes.hpp"

namespace thinwall::io::test::surface_refusals_test {

namespace {

const mesh::TriangleSoup cube = mesh::soup(mesh::block_surface({1, 1, 1}, 1));

template <class Read>
void expect_refused(Read read, const std::string& bytes, const std::string& what, const std::string& where) {
  const std::string text = message_of<core::DataError>([&] { (void)read(bytes, "part", 1.0); });
  EXPECT_NE(text.find(what), std::string::npos) << text;
  EXPECT_NE(text.find(where), std::string::npos) << text;
  EXPECT_TRUE(text.starts_with("part")) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos) << "one line";
}

/// The text with the first occurrence replaced.
std::string with(std::string text, const std::string& old, const std::string& by) {
  return text.replace(text.find(old), old.size(), by);
}

TEST(StlRefusals, ATruncatedBinaryFileTellsBothSizes) {
  for (const std::string& bytes : {stl_bytes(cube, 1.0), binary_stl_of_solid(cube, 1.0)}) {
    expect_refused(stl_surface, bytes.substr(0, bytes.size() - 7), "states 12 facets, 684 bytes",
                   "has 677: it is truncated");
    expect_refused(stl_surface, bytes + "tail", "states 12 facets, 684 bytes", "has 688: something follows");
  }
  std::string many = stl_bytes(cube, 1.0);
  many.replace(80, 4, "\xff\xff\xff\xff");
  expect_refused(stl_surface, many, "4294967295 facets", "truncated");
  expect_refused(stl_surface, "", "0 bytes are no STL", "solid");
  expect_refused(stl_surface, stl_bytes({}, 1.0), "no facets", "export");
}

TEST(StlRefusals, ANumberThatIsNoneTellsItsFacetOrLine) {
  std::string bytes = stl_bytes(cube, 1.0);
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    std::memcpy(bytes.data() + 84 + 50 * 3 + 12 + 16, &bad, sizeof bad);
    expect_refused(stl_surface, bytes, "not finite", "facet 4 (byte 234)");
  }
  const std::string text = ascii_stl(cube);
  expect_refused(stl_surface, with(text, "vertex 0 0 0", "vertex 0 nan 0"), "\"nan\", not finite", "part:");
  expect_refused(stl_surface, with(text, "vertex 0 0 0", "vertex 0 1,5 0"), "\"1,5\" where a coordinate belongs",
                 "part:");
}

TEST(StlRefusals, ATextThatIsNotWholeTellsItsLine) {
  const std::string text = ascii_stl(cube);
  expect_refused(stl_surface, text.substr(0, text.find("endsolid")), "before \"endsolid\"", "part:86");
  expect_refused(stl_surface, text.substr(0, text.find("endloop")), "\"endloop\" belongs: the file is truncated",
                 "part:7");
  expect_refused(stl_surface, with(text, "    endloop", "      vertex 1 1 1\n    endloop"), "three vertices", "part:7");
  expect_refused(stl_surface, "solid nothing\nendsolid\n", "no facets", "export");
}

TEST(OffRefusals, TellTheLine) {
  const std::string text = off_text(cube);
  expect_refused(off_surface, with(text, "OFF", "nOFF"), "\"nOFF\" is not read", "part:1");
  expect_refused(off_surface, "OFF BINARY\n", "binary OFF", "part:1");
  expect_refused(off_surface, "hello\n", "where \"OFF\" belongs", "part:1");
  expect_refused(off_surface, with(text, "8 12", "9 12"), "truncated", "part:24");
  expect_refused(off_surface, with(text, "8 12", "8 13"), "truncated", "part:");
  expect_refused(off_surface, with(text, "\n1 ", "\ninf "), "not finite", "part:");
  expect_refused(off_surface, with(text, "\n3 ", "\n2 "), "from 3 to 1000", "part:12");
  expect_refused(off_surface, "OFF\n2000000000 2000000000 0\n0 0 0\n", "truncated", "part:");
}

TEST(ObjRefusals, TellTheLine) {
  const std::string text = obj_text(cube);
  expect_refused(obj_surface, text + "f 1 2 99\n", "names point 98 (counted from 0), and there are 8", "part:25");
  expect_refused(obj_surface, text + "f 1 2 0\n", "OBJ counts from 1", "part:25");
  expect_refused(obj_surface, text + "f 1 2 -9\n", "\"-9\"", "part:25");
  expect_refused(obj_surface, text + "f 1 2\n", "2 corners", "part:25");
  expect_refused(obj_surface, text + "v 1 2\n", "a coordinate belongs", "part:25");
  expect_refused(obj_surface, text + "v 1 2 nan\n", "not finite", "part:25");
  expect_refused(obj_surface, text + "surf 0 1 0 1\n", "free-form", "part:25");
  expect_refused(obj_surface, "v 0 0 0\n", "no facets", "part:");
  // A bow tie whose wings differ.
  expect_refused(obj_surface, "v 0 0 0\nv 4 0 0\nv 1 3 0\nv 3 3 0\nf 1 2 3 4\n", "a facet of 4 corners crosses itself",
                 "part:5");
}

TEST(PlyRefusals, TellTheLineOrTheRowAndByte) {
  const std::string text = ascii_ply(cube);
  expect_refused(ply_surface, "plx\n", "begins with \"ply\"", "part:1");
  expect_refused(ply_surface, with(text, "ascii", "binary"), "no format of PLY", "part:2");
  expect_refused(ply_surface, with(text, "double y", "double w"), "lack a property x, y or z", "vertex 0");
  expect_refused(ply_surface, with(text, "vertex_indices", "corners"), "no list vertex_indices", "face 0");
  expect_refused(ply_surface, with(text, "uchar int", "float int"), "a whole number", "part:9");
  expect_refused(ply_surface, with(text, "element face", "element tristrips"), "triangle strips", "part:");
  expect_refused(ply_surface, with(text, "end_header", "end"), "does not belong into the heading", "part:10");
  expect_refused(ply_surface, text + "1\n", "something follows", "part:31");
  expect_refused(ply_surface, with(text, "face 12", "face 13"), "truncated", "part:31: face 12");
  for (const bool big_endian : {false, true}) {
    const std::string bytes = binary_ply(cube, big_endian);
    const std::size_t heading = bytes.find("end_header\n") + 11;
    expect_refused(ply_surface, bytes.substr(0, heading + 30), "vertex 1: the file ends within it",
                   "byte " + std::to_string(heading + 24));
    expect_refused(ply_surface, bytes.substr(0, bytes.size() - 1), "face 11: the file ends within it", "byte");
    expect_refused(ply_surface, bytes + "x", "something follows", "byte");
    std::string bad = bytes.substr(0, heading);
    append_value(bad, std::nan(""), big_endian);
    expect_refused(ply_surface, bad + bytes.substr(heading + 8), "vertex 0: a coordinate is not finite", "byte");
    std::string corner = bytes.substr(0, bytes.size() - 4);
    append_value(corner, std::int32_t{8}, big_endian);
    expect_refused(ply_surface, corner, "names point 8 (counted from 0), and there are 8", "face 11");
  }
}

class SurfaceUnits : public ScratchFolder {};

TEST_F(SurfaceUnits, ThatAreMissingOrNoLengthAreNamed) {
  const auto file = write("part.stl", ascii_stl(cube));
  const auto refusal = [](const std::filesystem::path& path, const std::string& unit) {
    return message_of<core::InputError>([&] { (void)read_surface(path, unit); });
  };
  EXPECT_NE(refusal(file, "").find("is missing; files of its kind do not tell it"), std::string::npos);
  EXPECT_NE(refusal(file, "kg").find("state a length"), std::string::npos) << refusal(file, "kg");
  EXPECT_NE(refusal(file, "furlong").find("furlong"), std::string::npos);
  EXPECT_NE(refusal(path("part.igs"), "mm").find(".stl, .off, .obj, .ply, .3mf, .glb, .gltf or .step"),
            std::string::npos);
  for (const double bad : {0.0, -1.0, std::nan("")}) {
    EXPECT_THROW((void)stl_surface(ascii_stl(cube), "part", bad), core::InputError);
    EXPECT_THROW((void)off_surface(off_text(cube), "part", bad), core::InputError);
    EXPECT_THROW((void)obj_surface(obj_text(cube), "part", bad), core::InputError);
    EXPECT_THROW((void)ply_surface(ascii_ply(cube), "part", bad), core::InputError);
  }
  EXPECT_THROW((void)read_surface(path("absent.stl"), "mm"), core::DataError);
}

TEST_F(SurfaceUnits, TakenWronglyAreSeenByTheWall) {
  // A rib of 4 mm walls whose file is in metres, read as millimetres: everything is below a wall of 0.1 mm.
  const auto soup = read_surface(write("rib.obj", obj_text(mesh::soup(mesh::pocketed_rib()))), "mm");
  mesh::SurfaceRepairOptions options;
  options.thinnest_wall_m = 1e-4;
  const std::string text = message_of<core::InputError>([&] { (void)mesh::repaired_surface(soup, options); });
  EXPECT_NE(text.find("correct the unit"), std::string::npos) << text;
}

}  // namespace

}  // namespace thinwall::io::test::surface_refusals_test
