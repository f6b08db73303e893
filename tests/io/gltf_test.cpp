// glTF files: binary and embedded, the transforms of their nodes, and what is refused.

#include "io/surface/gltf.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cstring>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "gltf_bytes.hpp"
#include "io/surface/surface_file.hpp"
#include "scratch_folder.hpp"

namespace thinwall::io::gltf_test {
namespace {

using test::glb_of;
using test::gltf_json;
using test::tetrahedron_numbers;

const std::string one = R"({"mesh":0})";

/// The volume that outward triangles enclose, m³ (Gauss).
double volume(const mesh::TriangleSoup& soup) {
  double sum = 0.0;
  for (const auto& t : soup.triangles) {
    const auto x = [&](std::size_t k) { return soup.points[static_cast<std::size_t>(t[k])]; };
    sum += x(0).dot(x(1).cross(x(2))) / 6.0;
  }
  return sum;
}

mesh::TriangleSoup read(const std::string& bytes) {
  return gltf_surface(bytes, "part.glb").soup;
}

std::string refusal(const std::string& bytes) {
  return test::message_of<core::DataError>([&] { (void)read(bytes); });
}

TEST(Gltf, IsReadInMetresBinaryOrEmbedded) {
  for (const std::string& bytes : {glb_of(gltf_json(one, ""), tetrahedron_numbers()), gltf_json(one)}) {
    const mesh::TriangleSoup soup = read(bytes);
    EXPECT_EQ(soup.triangles.size(), 4U);
    EXPECT_NEAR(volume(soup), 10.0, 1e-12) << "3 · 2 · 10 / 6 m³";
    EXPECT_EQ(soup.points[3], Eigen::Vector3d(0.0, 0.0, 10.0)) << "points lie 16 bytes apart";
  }
}

// The child is scaled by 2, turned by 90 degrees about z, shifted by (1, 0, 0); its parent mirrors x: (3, 0, 0) goes to
// (6, 0, 0), (0, 6, 0), (1, 6, 0), (-1, 6, 0).
TEST(Gltf, MeshesStandWhereTheNodesPlaceThem) {
  const std::string nodes =
      R"({"children":[1,2],"matrix":[-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]},)"
      R"({"mesh":0,"translation":[1,0,0],"rotation":[0,0,0.70710678118654752,0.70710678118654752],"scale":[2,2,2]},)"
      R"({"mesh":0})";
  const mesh::TriangleSoup soup = read(gltf_json(nodes));
  EXPECT_EQ(soup.triangles.size(), 8U);
  EXPECT_LT((soup.points[1] - Eigen::Vector3d(-1.0, 6.0, 0.0)).norm(), 1e-14);
  EXPECT_NEAR(volume(soup), 8.0 * 10.0 + 10.0, 1e-12) << "a mirrored body has its facets turned outwards";
}

TEST(Gltf, WithoutIndicesThreePointsEachAreATriangle) {
  const auto text = gltf_json(one, test::embedded, {{",\"indices\":1", ""}, {"\"count\":4", "\"count\":3"}});
  const mesh::TriangleSoup soup = read(text);
  ASSERT_EQ(soup.triangles.size(), 1U);
  EXPECT_EQ(soup.triangles[0], (std::array<int, 3>{0, 1, 2}));
}

TEST(Gltf, LinesArePassedOverAndUnusedExtensionsToo) {
  const std::string lines = R"("primitives":[{"attributes":{"POSITION":0},"mode":1},)";
  const auto text = gltf_json(
      one, test::embedded,
      {{"\"primitives\":[", lines}, {"\"scene\":0", "\"extensionsRequired\":[\"KHR_materials_unlit\"],\"scene\":0"}});
  EXPECT_EQ(read(text).triangles.size(), 4U);
}

TEST(Gltf, WhatIsWrongIsSaid) {
  const std::string whole = glb_of(gltf_json(one, ""), tetrahedron_numbers());
  EXPECT_NE(refusal(whole.substr(0, whole.size() - 4)).find("it is not whole"), std::string::npos);
  EXPECT_NE(refusal(whole.substr(0, 15)).find("ends in its heading"), std::string::npos);
  std::string first = whole;
  first[4] = '\1';
  EXPECT_NE(refusal(first).find("of version 1; version 2 is read"), std::string::npos);
  EXPECT_NE(refusal("solid x").find("part.glb: is no glTF: "), std::string::npos);
  EXPECT_NE(refusal("[]").find("no JSON object"), std::string::npos);
  EXPECT_NE(refusal(gltf_json(one, "\"uri\":\"part.bin\",")).find("another file, \"part.bin\""), std::string::npos);
  EXPECT_NE(refusal(gltf_json(one, "\"uri\":\"data:;base64,A\",")).find("part.glb: buffer 0"), std::string::npos);
  EXPECT_NE(refusal(gltf_json(one, "")).find("buffer 0 has no bytes"), std::string::npos);
  using Change = std::tuple<std::string, std::string, std::string>;  // what stands there, what shall, the message
  const std::vector<Change> changes{
      {"\"2.0\"", "\"1.0\"", "glTF of version \"1.0\""},
      {"\"scene\":0", "\"scene\":1", "scenes has no item 1 of 1"},
      {"\"scene\":0", "\"scene\":0,\"extensionsRequired\":[\"KHR_draco_mesh_compression\"]",
       "KHR_draco_mesh_compression"},
      {"{\"mesh\":0}", "{\"mesh\":1}", "meshes has no item 1 of 1"},
      {"{\"mesh\":0}", "{\"mesh\":-1}", "\"mesh\" is missing or no whole number"},
      {"{\"mesh\":0}", "{\"mesh\":0,\"skin\":0}", "skin"},
      {"{\"mesh\":0}", "{\"children\":[0]}", "holds itself"},
      {"{\"mesh\":0}", "{\"mesh\":0,\"scale\":[1,1]}", "\"scale\" is not of 3 numbers"},
      {"{\"mesh\":0}", "{\"mesh\":0,\"scale\":[1e308,1,1]}", "point 1 of a mesh is not finite"},
      {"{\"mesh\":0}", "{\"mesh\":0,\"rotation\":[0,0,0,2]}", "no unit quaternion"},
      {"{\"mesh\":0}", "{\"mesh\":0,\"matrix\":[1,0,0,1,0,1,0,0,0,0,1,0,0,0,0,1]}", "another last row"},
      {"{\"mesh\":0}", "{}", "shows no triangles"},
      {"\"indices\":1", "\"indices\":1,\"mode\":5", "strips or fans (mode 5)"},
      {"\"indices\":1", "\"indices\":1,\"targets\":[{}]", "morph targets"},
      {"\"indices\":1", "\"indices\":0", "component type 5126, which is no index"},
      {"5126", "5122", "positions of the component type 5122"},
      {"\"count\":4", "\"count\":3", "names point 3 of 3"},
      {"\"count\":4", "\"count\":5", "accessor 0 reaches beyond its bytes"},
      {"\"count\":12", "\"count\":11", "11 corners are no whole number of triangles"},
      {"\"count\":12", "\"count\":4000000000", "accessor 1 reaches beyond its bytes"},
      {"\"byteStride\":16", "\"byteStride\":4", "accessor 0 reaches beyond its bytes"},
      {"\"byteOffset\":64", "\"byteOffset\":99", "accessor 1 reaches beyond its bytes"},
      {"\"type\":\"VEC3\"", "\"type\":\"VEC2\"", "accessor 0 is not of the type VEC3"},
      {"\"count\":4", "\"count\":4,\"sparse\":{}", "accessor 0 is sparse"},
      {"\"byteLength\":88", "\"byteLength\":89", "buffer 0 holds 88 of 89 bytes"},
      {"\"bufferView\":0", "\"bufferView\":7", "bufferViews has no item 7 of 2"},
      {"\"buffer\":0", "\"buffer\":1", "a buffer that is not there"},
      {"\"nodes\":[0]", "\"nodes\":[\"a\"]", "\"nodes\" holds what is no index"}};
  for (const auto& [from, to, message] : changes) {
    EXPECT_NE(refusal(gltf_json(one, test::embedded, {{from, to}})).find(message), std::string::npos) << to;
  }
}

// Two of the same below each of thirty levels: refused by their number, not after 2³⁰ of them.
TEST(Gltf, NodesThatMultiplyAreRefused) {
  std::string nodes;
  for (int i = 1; i <= 30; ++i) {
    const std::string next = std::to_string(i);
    nodes += "{\"children\":[" + next + "," + next + "]},";
  }
  EXPECT_NE(refusal(gltf_json(nodes + one)).find("more than 100000 nodes"), std::string::npos);
}

TEST(Gltf, APositionThatIsNotFiniteIsRefused) {
  std::string numbers = tetrahedron_numbers();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(numbers.data() + 16, &nan, 4);
  EXPECT_NE(refusal(glb_of(gltf_json(one, ""), numbers)).find("point 1 of a mesh is not finite"), std::string::npos);
}

using GltfFile = test::ScratchFolder;

TEST_F(GltfFile, IsInMetresWithWhichTheCallersUnitMustAgree) {
  core::write_file_atomically(path("part.glb"), glb_of(gltf_json(one, ""), tetrahedron_numbers()));
  core::write_file_atomically(path("part.gltf"), gltf_json(one));
  for (const char* file : {"part.glb", "part.gltf"}) {
    for (const char* unit : {"", "m"}) EXPECT_NEAR(volume(read_surface(path(file), unit)), 10.0, 1e-12);
    EXPECT_THROW((void)read_surface(path(file), "mm"), core::InputError);
  }
}

}  // namespace
}  // namespace thinwall::io::gltf_test
