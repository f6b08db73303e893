// Meshes that Gmsh wrote, in all its formats, and the same ones by way of its Abaqus files.

#include "io/mesh/gmsh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/mesh/mesh_file.hpp"
#include "mesh_bytes.hpp"
#include "scratch_folder.hpp"

namespace thinwall::io::gmsh_test {
namespace {

using test::data_file;
using GmshFile = test::ScratchFolder;

mesh::SolidMesh read_mm(const std::string& name) {
  return read_solid_mesh(data_file(name), "mm");
}

/// The 40 × 20 × 10 mm box in ten-node tetrahedra, saved by one program in five ways.
TEST(GmshFiles, OfAllVersionsAreTheSameMesh) {
  const mesh::SolidMesh first = read_mm("box_41_binary.msh");
  EXPECT_NEAR(mesh::volume_of(first), 8e-6, 1e-18);
  EXPECT_LT(first.midside_offset, 1e-9) << "Gmsh's order of nodes is not the order of VTK";
  for (const auto& notice : first.notices) EXPECT_EQ(notice.find("exchanged"), std::string::npos);
  for (const char* name :
       {"box_41_ascii.msh", "box_40_ascii.msh", "box_22_ascii.msh", "box_22_binary.msh", "box.inp"}) {
    const mesh::SolidMesh solid = read_mm(name);
    ASSERT_EQ(solid.nodes.elements.rows(), first.nodes.elements.rows()) << name;
    EXPECT_TRUE(solid.nodes.elements == first.nodes.elements) << name;
    EXPECT_LT((solid.nodes.positions - first.nodes.positions).cwiseAbs().maxCoeff(), 1e-15) << name;
    EXPECT_EQ(mesh::element_set(solid, "part", name).tets.size(), solid.mesh.tets.size());
    EXPECT_EQ(mesh::node_set(solid, "clamped", name).nodes, mesh::node_set(first, "clamped", "").nodes) << name;
  }
  for (const int node : mesh::node_set(first, "clamped", "").nodes)
    EXPECT_NEAR(first.nodes.positions(node, 0), 0.0, 1e-15);
  EXPECT_EQ(mesh::node_set(first, "point_7", "").nodes.size(), 1U) << "a physical group without a name";
}

/// The lines of the section between $name and $Endname, without the count.
std::vector<std::string> section(const std::string& text, const std::string& name) {
  const std::size_t begin = text.find('\n', text.find("$" + name + "\n")) + 1;
  std::istringstream in(text.substr(begin, text.find("$End" + name) - begin));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  lines.erase(lines.begin());
  return lines;
}

/// An element line of MSH 2: number, type, tags (physical group, entity), nodes.
struct Msh2Element {
  std::vector<int> words{};
  int number() const { return words.at(0); }
  int type() const { return words.at(1); }
  int group() const { return words.at(3); }
  int entity() const { return words.at(4); }
  std::vector<int> nodes() const { return {words.begin() + 3 + words.at(2), words.end()}; }
};

std::vector<Msh2Element> elements_of(const std::string& msh2) {
  std::vector<Msh2Element> elements;
  for (const std::string& line : section(msh2, "Elements")) {
    std::istringstream in(line);
    elements.emplace_back();
    for (int word = 0; in >> word;) elements.back().words.push_back(word);
  }
  return elements;
}

std::string words(const std::vector<int>& numbers) {
  std::string text;
  for (const int number : numbers) text += " " + std::to_string(number);
  return text;
}

/// The box as MSH 1: $NOD and $ELM, element: number, type, group, entity, count of nodes, nodes (manual, "MSH file
/// format version 1 (Legacy)").
std::string as_msh_1(const std::string& msh2) {
  const auto nodes = section(msh2, "Nodes");
  const auto elements = elements_of(msh2);
  std::string text = "$NOD\n" + std::to_string(nodes.size()) + "\n";
  for (const std::string& node : nodes) text += node + "\n";
  text += "$ENDNOD\n$ELM\n" + std::to_string(elements.size()) + "\n";
  for (const Msh2Element& e : elements)
    text += std::to_string(e.number()) + words({e.type(), e.group(), e.entity(), static_cast<int>(e.nodes().size())}) +
            words(e.nodes()) + "\n";
  return text + "$ENDELM\n";
}

/// The box as MSH 3: nodes with an entity, its dimension and parameters; elements with entity and count of data.
std::string as_msh_3(const std::string& msh2) {
  const auto nodes = section(msh2, "Nodes");
  std::map<std::pair<int, int>, std::set<int>> groups;  // dimension and entity
  std::vector<Msh2Element> once;
  std::set<int> known;
  for (const Msh2Element& e : elements_of(msh2)) {
    const int dimension = e.type() == 15 ? 0 : e.type() == 8 ? 1 : e.type() == 9 ? 2 : 3;
    groups[{dimension, e.entity()}].insert(e.group());
    if (known.insert(e.number()).second) once.push_back(e);
  }
  std::string entities, counts;
  for (int dimension = 0; dimension < 4; ++dimension) {
    int count = 0;
    for (const auto& [entity, of] : groups) {
      if (entity.first != dimension) continue;
      ++count;
      entities += std::to_string(entity.second) + (dimension == 0 ? "" : " 2 7 -8") +
                  words({static_cast<int>(of.size())}) + words({of.begin(), of.end()}) + " \n";
    }
    counts += std::to_string(count) + " ";
  }
  std::string text = "$MeshFormat\n3 0 8\n$EndMeshFormat\n$PhysicalNames\n";
  const auto names = section(msh2, "PhysicalNames");
  text += std::to_string(names.size()) + "\n";
  for (const std::string& name : names) text += name + "\n";
  text += "$EndPhysicalNames\n$Entities\n" + counts + "\n" + entities + "$EndEntities\n$Nodes\n" +
          std::to_string(nodes.size()) + "\n";
  const char* on[] = {" 0", " 4 0", " 4 1 0.5", " 4 2 0.5 0.25", " 4 3 0.1 0.2 0.3"};
  for (std::size_t i = 0; i < nodes.size(); ++i) text += nodes[i] + on[i % 5] + "\n";
  text += "$EndNodes\n$Elements\n" + std::to_string(once.size()) + "\n";
  for (const Msh2Element& e : once) {
    const auto of = e.nodes();
    const bool parted = e.number() % 2 == 0;  // with a part behind the nodes
    text += std::to_string(e.number()) + words({e.type(), e.entity(), static_cast<int>(of.size()) + (parted ? 1 : 0)}) +
            words(of) + (parted ? " 1" : "") + "\n";
  }
  return text + "$EndElements\n";
}

// No program at hand writes them; they are made from the box in MSH 2 by the manual and by what Gmsh's own reader
// takes.
TEST(GmshFiles, OfVersionsOneAndThreeAreTheSameMesh) {
  const std::string two = core::read_file(data_file("box_22_ascii.msh"));
  const mesh::SolidMesh first = read_mm("box_22_ascii.msh");
  const auto expect_same = [&](const std::string& text, const std::string& clamped) {
    const mesh::SolidMesh solid = mesh::solid_mesh(gmsh_mesh(text, "box.msh", 1e-3));
    ASSERT_EQ(solid.nodes.elements.rows(), first.nodes.elements.rows());
    EXPECT_TRUE(solid.nodes.elements == first.nodes.elements);
    EXPECT_TRUE(solid.nodes.positions == first.nodes.positions);
    EXPECT_EQ(mesh::node_set(solid, clamped, "").nodes, mesh::node_set(first, "clamped", "").nodes);
  };
  int clamped = 0;
  for (const std::string& name : section(two, "PhysicalNames")) {
    if (name.find("clamped") != std::string::npos) clamped = std::stoi(name.substr(2));
  }
  expect_same(as_msh_1(two), "surface_" + std::to_string(clamped));
  expect_same(as_msh_3(two), "clamped");
  for (const std::string& text : {as_msh_1(two), as_msh_3(two)}) {
    EXPECT_THROW((void)gmsh_mesh(text.substr(0, text.size() / 2), "box.msh", 1e-3), core::DataError);
  }
  const std::string one = "$NOD\n1\n1 0 0 0\n$ENDNOD\n$ELM\n1\n1 4 0 1 3 1 1 1\n$ENDELM\n";
  EXPECT_NE(test::message_of<core::DataError>([&] {
              (void)gmsh_mesh(one, "box.msh", 1.0);
            }).find("an element of 4 nodes has 3"),
            std::string::npos);
}

struct Kind {
  const char* name;
  std::size_t tets;
  int order;
};

class GmshSplit : public ::testing::TestWithParam<Kind> {};

TEST_P(GmshSplit, FillsTheBoxWithItsSets) {
  const mesh::SolidMesh solid = read_mm(GetParam().name);
  EXPECT_EQ(solid.mesh.tets.size(), GetParam().tets);
  EXPECT_EQ(solid.nodes.order, GetParam().order);
  EXPECT_NEAR(mesh::volume_of(solid), 8e-6, 1e-16);
  EXPECT_LT(solid.midside_offset, 1e-9);
  EXPECT_EQ(mesh::element_set(solid, "PART", "").tets.size(), GetParam().tets);
  std::vector<int> bottom;
  for (Eigen::Index i = 0; i < solid.nodes.positions.rows(); ++i)
    if (std::abs(solid.nodes.positions(i, 2)) < 1e-12) bottom.push_back(static_cast<int>(i));
  EXPECT_EQ(mesh::node_set(solid, "bottom", "").nodes, bottom) << "with the nodes that the split made";
}

INSTANTIATE_TEST_SUITE_P(Files, GmshSplit,
                         ::testing::Values(Kind{"hex8.msh", 12, 1}, Kind{"hex20.msh", 12, 2}, Kind{"hex27.msh", 12, 2},
                                           Kind{"hex20.inp", 12, 2}, Kind{"wedge6.msh", 12, 1},
                                           Kind{"wedge15.msh", 12, 2}, Kind{"wedge18.msh", 12, 2},
                                           Kind{"wedge15.inp", 12, 2}),
                         [](const auto& kind) {
                           std::string name = kind.param.name;
                           std::replace(name.begin(), name.end(), '.', '_');
                           return name;
                         });

TEST(GmshFiles, OfACurvedPartKeepItsFaces) {
  const mesh::SolidMesh ring = read_mm("ring.msh");
  const double exact = 0.25 * std::numbers::pi * (400.0 - 144.0) * 10.0 * 1e-9;
  EXPECT_NEAR(mesh::volume_of(ring), exact, 3e-3 * exact);
  EXPECT_GT(ring.midside_offset, 0.05);
  EXPECT_GT(ring.least_jacobian, 0.1);
  EXPECT_LT(ring.least_jacobian, 1.0);
}

TEST_F(GmshFile, IsWrittenAndReadBack) {
  for (const char* name : {"hex20.msh", "wedge6.msh", "ring.msh"}) {
    const mesh::SolidMesh solid = read_mm(name);
    write_gmsh(path("out.msh"), solid);
    const mesh::SolidMesh back = read_solid_mesh(path("out.msh"), "m");
    EXPECT_TRUE(back.nodes.positions == solid.nodes.positions);
    ASSERT_EQ(back.node_sets.size(), solid.node_sets.size());
    for (const mesh::NodeSet& set : solid.node_sets) EXPECT_EQ(mesh::node_set(back, set.name, "").nodes, set.nodes);
    for (const mesh::ElementSet& set : solid.element_sets)
      EXPECT_EQ(mesh::element_set(back, set.name, "").tets.size(), set.tets.size());
    EXPECT_NEAR(mesh::volume_of(back), mesh::volume_of(solid), 1e-20);
  }
  mesh::SolidMesh named = read_mm("wedge6.msh");
  named.node_sets.front().name = "a\"b";
  EXPECT_THROW(write_gmsh(path("bad.msh"), named), core::InputError);
}

TEST_F(GmshFile, OfSeveralGroupsForAnElementTakesItOnce) {
  const std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n9 0 0 1\n$EndNodes\n"
      "$Elements\n2\n1 4 2 5 1 1 2 3 9\n2 4 2 6 1 1 2 3 9\n$EndElements\n";
  const mesh::SolidMesh solid = read_solid_mesh(write("a.msh", text), "inch");
  EXPECT_EQ(solid.mesh.tets.size(), 1U);
  EXPECT_EQ(mesh::element_set(solid, "volume_5", "").tets, std::vector<int>{0});
  EXPECT_EQ(mesh::element_set(solid, "volume_6", "").tets, std::vector<int>{0});
  EXPECT_NEAR(mesh::volume(solid.mesh), std::pow(0.0254, 3) / 6.0, 1e-18);
}

/// With the bytes of every number turned around it is the same file of a machine of the other kind.
/// A group has a name and a number for each dimension.
TEST(GmshFiles, WithOneNameOnACurveAndASurfaceHaveOneSet) {
  const std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n1 1 \"held\"\n2 2 \"held\"\n3 3 \"part\"\n"
      "$EndPhysicalNames\n$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n$EndNodes\n$Elements\n4\n"
      "1 1 2 1 1 1 2\n2 2 2 2 1 1 3 4\n3 4 2 3 1 1 2 3 4\n4 4 2 3 1 2 5 3 4\n$EndElements\n";
  const mesh::SolidMesh solid = mesh::solid_mesh(gmsh_mesh(text, "x.msh", 1.0));
  ASSERT_EQ(solid.node_sets.size(), 1U);
  EXPECT_EQ(mesh::node_set(solid, "held", "").nodes, (std::vector<int>{0, 1, 2, 3}));
}

TEST(GmshFiles, WithNumbersOfNodesBeyondAnIntAreRefused) {
  for (const char* last : {"2147483647", "2147483648", "4611686018427387000"}) {
    const std::string text =
        std::string("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 ") + last + "\n3 1 0 4\n1\n2\n3\n" + last +
        "\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 " + last + "\n$EndElements\n";
    const auto read = [&] { return mesh::solid_mesh(gmsh_mesh(text, "x.msh", 1.0)); };
    if (std::string(last) == "2147483647") {
      EXPECT_EQ(read().node_labels.back(), 2147483647);
      continue;
    }
    const std::string message = test::message_of<core::DataError>([&] { (void)read(); });
    EXPECT_TRUE(message.starts_with("x.msh:10: the number of node " + std::string(last) + " is beyond")) << message;
  }
}

TEST_F(GmshFile, OfTheOtherByteOrderIsReadTheSame) {
  std::string bytes = core::read_file(std::filesystem::path(THINWALL_SOURCE_DIR) / "fuzz/corpus/gmsh/hex8_22_binary");
  const auto turn = [&bytes](std::size_t at, std::size_t size) {
    std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                 bytes.begin() + static_cast<std::ptrdiff_t>(at + size));
  };
  const auto number = [&bytes](std::size_t at) {
    return static_cast<std::size_t>(static_cast<unsigned char>(bytes[at]));
  };
  turn(bytes.find("2.2 1 8\n") + 8, 4);
  std::size_t at = bytes.find("$Nodes\n12\n") + 10;
  for (int i = 0; i < 12; ++i, at += 28) {
    turn(at, 4);
    for (std::size_t k = 0; k < 3; ++k) turn(at + 4 + 8 * k, 8);
  }
  at = bytes.find("$Elements\n") + 10;
  at = bytes.find('\n', at) + 1;
  while (bytes[at] != '\n' && bytes[at] != '$') {
    const std::size_t type = number(at), count = number(at + 4), tags = number(at + 8);
    ASSERT_TRUE(type == 3 || type == 5) << type;
    const std::size_t words = 3 + count * (1 + tags + (type == 3 ? 4 : 8));
    for (std::size_t w = 0; w < words; ++w) turn(at + 4 * w, 4);
    at += 4 * words;
  }
  const mesh::SolidMesh turned = read_solid_mesh(write("turned.msh", bytes), "mm");
  EXPECT_TRUE(turned.nodes.positions.isApprox(read_mm("hex8.msh").nodes.positions, 1e-14));
}

const std::string heading = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const std::string nodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n";
const std::string element = "$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n";

struct BadFile {
  const char* name;
  std::string text;
  std::vector<std::string> says;
};

class BadGmsh : public test::ScratchFolder, public ::testing::WithParamInterface<BadFile> {};

TEST_P(BadGmsh, IsToldWithItsPlace) {
  const auto file = write("bad.msh", GetParam().text);
  const std::string message = test::message_of<core::DataError>([&] { (void)read_gmsh(file, 1.0); });
  for (const std::string& part : GetParam().says) EXPECT_NE(message.find(part), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    Files, BadGmsh,
    ::testing::Values(
        BadFile{"Empty", "", {"bad.msh:1:", "$MeshFormat"}},
        BadFile{"Version5", "$MeshFormat\n5 0 8\n", {"bad.msh:2:", "\"5\"", "2.2 or 4.1"}},
        BadFile{"Binary40", "$MeshFormat\n4 1 8\n", {"4.0", "4.1"}}, BadFile{"HeadingOnly", heading, {"$Nodes"}},
        BadFile{"NodesOnly", heading + nodes, {"no solid element"}},
        BadFile{"CutInNodes", heading + nodes.substr(0, 30), {"bad.msh:", "truncated"}},
        BadFile{"CountTooHigh", heading + "$Nodes\n2147483647\n1 0 0 0\n$EndNodes\n", {"bad.msh:", "$EndNodes"}},
        BadFile{"CountTooLow", heading + "$Nodes\n2\n1 0 0 0\n2 0 0 0\n3 1 1 1\n$EndNodes\n", {"bad.msh:8:", "\"3\""}},
        BadFile{"NotANumber", heading + "$Nodes\n1\n1 0 nan 0\n$EndNodes\n", {"bad.msh:6:", "finite"}},
        BadFile{"AbsentNode",
                heading + nodes + "$Elements\n1\n1 4 2 1 1 1 2 3 5\n$EndElements\n",
                {"bad.msh:13:", "node 5"}},
        BadFile{"Inverted",
                heading + nodes + "$Elements\n1\n1 4 2 1 1 1 3 2 4\n$EndElements\n",
                {"bad.msh:13:", "element 1", "volume"}},
        BadFile{"CubicElement",
                heading + nodes + "$Elements\n1\n1 29 2 1 1 1 3 2 4\n$EndElements\n",
                {"bad.msh:13:", "type 29", "Mesh.ElementOrder"}},
        BadFile{"NoEnd", heading + nodes + element + "$Periodic\n1 2 3\n", {"bad.msh:", "$Periodic"}},
        BadFile{"NoSection", heading + nodes + element + "and more", {"\"and\""}}),
    [](const auto& file) { return file.param.name; });

TEST_F(GmshFile, NeedsAUnit) {
  EXPECT_THROW((void)read_solid_mesh(data_file("hex8.msh"), ""), core::InputError);
  EXPECT_THROW((void)read_solid_mesh(data_file("hex8.msh"), "kg"), core::InputError);
  EXPECT_THROW((void)read_gmsh(data_file("hex8.msh"), -1.0), core::InputError);
  const std::string message =
      test::message_of<core::DataError>([&] { (void)read_solid_mesh(write("a.bdf", "GRID,1,,0.,0.,0."), "mm"); });
  EXPECT_NE(message.find(".msh"), std::string::npos) << message;
}

}  // namespace
}  // namespace thinwall::io::gmsh_test
