// Input files with hexahedra, wedges, element sets, surfaces, materials and elements that are no solids.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "mesh_bytes.hpp"
#include "scratch_folder.hpp"

namespace thinwall::io::inp_solids_test {
namespace {

using InpSolids = test::ScratchFolder;

/// Two bricks of 1 × 1 × 1 side by side, 1 under the first top a shell, the second's top a surface.
const std::string bricks =
    "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n10,2,0,0\n11,2,1,0\n12,2,0,1\n"
    "13,2,1,1\n99,7,7,7\n"
    "*ELEMENT, TYPE=C3D8R, ELSET=BODY\n1,1,2,3,4,5,6,7,8\n2, 2,10,11,3,\n 6,12,13,7\n"
    "*ELEMENT, TYPE=S4, ELSET=SKIN\n3, 5,6,7,8\n*ELEMENT, TYPE=MASS, ELSET=M\n4, 99\n"
    "*ELSET, ELSET=RIGHT\n2\n*ELSET, ELSET=BOTH, GENERATE\n1, 2\n";

TEST_F(InpSolids, GiveSetsSurfacesAndMaterials) {
  const InpPart part = read_inp_part(
      write("a.inp", bricks + "*SURFACE, NAME=TOP\nRIGHT, S2\n1, S6\n*SURFACE, NAME=P, TYPE=NODE\n13\n"
                              "*MATERIAL, NAME=ALU\n*ELASTIC\n70000, 0.33, 20.\n60000, 0.33, 200.\n*DENSITY\n2.7e-9\n"
                              "*SOLID SECTION, ELSET=BODY, MATERIAL=alu\n"),
      1e-3);
  const mesh::SolidMesh& solid = part.solid;
  EXPECT_EQ(solid.mesh.tets.size(), 12U);
  EXPECT_NEAR(mesh::volume(solid.mesh), 2e-9, 1e-24);
  EXPECT_EQ(mesh::element_set(solid, "right", "").tets.size(), 6U);
  EXPECT_EQ(mesh::element_set(solid, "BOTH", "").tets.size(), 12U);
  const auto labels = [&](const std::string& name) {
    std::vector<std::int64_t> result;
    for (const int node : mesh::node_set(solid, name, "a.inp").nodes)
      result.push_back(solid.node_labels[static_cast<std::size_t>(node)]);
    return result;
  };
  EXPECT_EQ(labels("TOP"), (std::vector<std::int64_t>{1, 4, 5, 6, 7, 8, 12, 13})) << "x = 0 of 1, z = 1 of 2";
  EXPECT_EQ(labels("P"), std::vector<std::int64_t>{13});
  EXPECT_EQ(labels("SKIN"), (std::vector<std::int64_t>{5, 6, 7, 8})) << "the nodes of shells";
  const auto told = [&](const std::string& what) {
    return std::any_of(solid.notices.begin(), solid.notices.end(),
                       [&](const std::string& notice) { return notice.find(what) != std::string::npos; });
  };
  EXPECT_TRUE(told("1 elements of type \"S4\""));
  EXPECT_TRUE(told("1 elements of type \"MASS\""));
  EXPECT_TRUE(told("1 nodes that no solid element uses"));
  EXPECT_TRUE(told("2 hexahedra of order 1, split into 12 tetrahedra"));
  ASSERT_EQ(part.materials.size(), 1U);
  EXPECT_EQ(part.materials[0].element_set, "BODY");
  EXPECT_EQ(part.materials[0].youngs_modulus, 70000.0) << "as the file has it, of the first temperature";
  const InpMaterial si = in_si(part.materials[0], 1e-3, 1e3);
  EXPECT_NEAR(si.youngs_modulus.value(), 70e9, 1.0);
  EXPECT_NEAR(si.density.value(), 2700.0, 1e-9);
}

/// Every face of every shape: the surface of all of them is the shape's, each face's nodes lie in one plane.
TEST_F(InpSolids, HaveTheirFacesWhereTheFormatHasThem) {
  const std::string tet =
      "*NODE\n1,0,0,0\n2,2,0,0\n3,0,2,0\n4,0,0,2\n5,1,0,0\n6,1,1,0\n7,0,1,0\n8,0,0,1\n9,1,0,1\n10,0,1,1\n"
      "*ELEMENT,TYPE=C3D10\n1,1,2,3,4,5,6,7,8,9,10\n";
  // CalculiX manual, "Ten-node tetrahedral element": face 1: 1-2-3, 2: 1-4-2, 3: 2-4-3, 4: 3-4-1.
  const std::vector<std::vector<std::int64_t>> expected{
      {1, 2, 3, 5, 6, 7}, {1, 2, 4, 5, 8, 9}, {2, 3, 4, 6, 9, 10}, {1, 3, 4, 7, 8, 10}};
  for (std::size_t face = 0; face < 4; ++face) {
    const mesh::SolidMesh solid =
        read_inp(write("t.inp", tet + "*SURFACE, NAME=F\n1, S" + std::to_string(face + 1) + "\n"), 1.0);
    std::vector<std::int64_t> labels;
    for (const int node : mesh::node_set(solid, "F", "").nodes)
      labels.push_back(solid.node_labels[static_cast<std::size_t>(node)]);
    EXPECT_EQ(labels, expected[face]);
  }
}

/// A shell's two sides are its nodes, alone, by a set, or beside the face of a solid.
TEST_F(InpSolids, HaveTheSidesOfShellsAsSurfaces) {
  const mesh::SolidMesh solid =
      read_inp(write("a.inp", bricks + "*SURFACE, NAME=OVER\nSKIN, SPOS\n*SURFACE, NAME=UNDER\n3, sneg\n"
                                       "*SURFACE, NAME=ALL, TYPE=ELEMENT\nSKIN, SNEG\n2, S2\n"),
               1e-3);
  const auto labels = [&](const std::string& name) {
    std::vector<std::int64_t> result;
    for (const int node : mesh::node_set(solid, name, "a.inp").nodes)
      result.push_back(solid.node_labels[static_cast<std::size_t>(node)]);
    return result;
  };
  EXPECT_EQ(labels("OVER"), (std::vector<std::int64_t>{5, 6, 7, 8}));
  EXPECT_EQ(labels("UNDER"), (std::vector<std::int64_t>{5, 6, 7, 8}));
  EXPECT_EQ(labels("ALL"), (std::vector<std::int64_t>{5, 6, 7, 8, 12, 13}));
}

struct BadFile {
  const char* name;
  std::string text;
  std::vector<std::string> says;
};

class BadInpSolids : public test::ScratchFolder, public ::testing::WithParamInterface<BadFile> {};

TEST_P(BadInpSolids, AreToldWithTheirLine) {
  const auto file = write("bad.inp", GetParam().text);
  const std::string message = test::message_of<core::DataError>([&] { (void)read_inp(file, 1.0); });
  for (const std::string& part : GetParam().says) EXPECT_NE(message.find(part), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    Files, BadInpSolids,
    ::testing::Values(
        BadFile{"UnknownSolid", "*ELEMENT, TYPE=C3D7\n", {"bad.inp:1:", "\"C3D7\""}},
        BadFile{"NoType", "*ELEMENT\n", {"bad.inp:1:", "\"\""}},
        BadFile{"TurnedBrick",
                "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n"
                "*ELEMENT, TYPE=C3D8\n1,5,6,7,8,1,2,3,4\n",
                {"bad.inp:11:", "element 1", "positive volume", "mm"}},
        BadFile{"MovedInstance", bricks + "*INSTANCE, NAME=A\n5., 0., 0.\n", {"*INSTANCE"}},
        BadFile{"FaceThatIsNone", bricks + "*SURFACE, NAME=A\n1, S7\n", {"\"S7\""}},
        BadFile{"SideOfASolid", bricks + "*SURFACE, NAME=A\nBODY, SPOS\n", {"element 1 is a solid"}},
        BadFile{"SurfaceOfUnknownSet", bricks + "*SURFACE, NAME=A\nNOWHERE, S1\n", {"\"NOWHERE\""}},
        BadFile{"SectionOfUnknownMaterial", bricks + "*SOLID SECTION, ELSET=BODY, MATERIAL=X\n", {"\"X\""}},
        BadFile{"MixedOrders",
                bricks +
                    "*NODE\n20,5,0,0\n21,7,0,0\n22,5,2,0\n23,5,0,2\n24,6,0,0\n25,6,1,0\n26,5,1,0\n27,5,0,1\n28,6,0,1\n"
                    "29,5,1,1\n*ELEMENT, TYPE=C3D10\n9,20,21,22,23,24,25,26,27,28,29\n",
                {"element 9 has 10 nodes", "one order"}}),
    [](const auto& file) { return file.param.name; });

}  // namespace
}  // namespace thinwall::io::inp_solids_test
