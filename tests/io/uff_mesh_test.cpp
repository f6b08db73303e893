#include "io/frf/uff_mesh.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "scratch_folder.hpp"
#include "uff_bytes.hpp"

namespace thinwall::io::test::uff_mesh_test {

namespace {

class UniversalMesh : public ScratchFolder {};

UffMesh small_mesh() {
  UffMesh mesh;
  mesh.nodes = {{1, Eigen::Vector3d(0.0, -0.1, 1.0 / 3.0)},
                {12, Eigen::Vector3d(-1.25, 0.0, 1e-9)},
                {7, Eigen::Vector3d(0.3, M_PI, -2.0)},
                {400, Eigen::Vector3d(0.0, 0.0, 0.1)}};
  mesh.elements = {{1, uff::linear_tetrahedron, {1, 12, 7, 400}}, {2, uff::linear_beam, {1, 7}}};
  mesh.lines = {{1, "edge", {1, 12, 0, 7, 400, 1, 12, 7, 400, 1}}};
  return mesh;
}

std::string after(const std::string& text, const std::string& heading) {
  const auto at = text.find("    -1\n" + heading + "\n");
  EXPECT_NE(at, std::string::npos) << heading;
  const auto start = at + heading.size() + 8;
  return text.substr(start, text.find("    -1\n", start) - start);
}

std::string uff_mesh_refusal(const std::string& bytes) {
  return message_of<core::DataError>([&] { (void)uff_mesh(bytes, "wing.unv"); });
}

const std::string old_nodes =
    "    -1\n    15\n        12         0         0        11  1.00000E+03 -2.50000E+02  0.00000E+00\n    -1\n";

}  // namespace

TEST_F(UniversalMesh, ComesBackToTheLastBit) {
  const UffMesh mesh = small_mesh();
  write_uff_mesh(path("wing.unv"), mesh);
  const UffMesh back = read_uff_mesh(path("wing.unv"));
  EXPECT_TRUE(back.notes.empty());
  ASSERT_EQ(back.nodes.size(), mesh.nodes.size());
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    EXPECT_EQ(back.nodes[i].label, mesh.nodes[i].label);
    EXPECT_EQ(back.nodes[i].position, mesh.nodes[i].position);
  }
  ASSERT_EQ(back.elements.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back.elements[i].label, mesh.elements[i].label);
    EXPECT_EQ(back.elements[i].descriptor, mesh.elements[i].descriptor);
    EXPECT_EQ(back.elements[i].nodes, mesh.elements[i].nodes);
  }
  ASSERT_EQ(back.lines.size(), 1U);
  EXPECT_EQ(back.lines[0].name, "edge");
  EXPECT_EQ(back.lines[0].nodes, mesh.lines[0].nodes);
}

// From the FORMAT statements: 4I10 and 3D25.16; 6I10, 3I10 of a beam, 8I10; 3I10, 80A1, 8I10.
TEST_F(UniversalMesh, HasEveryFieldInItsColumns) {
  write_uff_mesh(path("wing.unv"), small_mesh());
  const std::string text = core::read_file(path("wing.unv"));
  EXPECT_EQ(after(text, "  2411").substr(0, 117),
            "         1         1         1         7\n"
            "   0.0000000000000000E+00  -1.0000000000000001E-01   3.3333333333333331E-01\n");
  EXPECT_EQ(after(text, "  2412"),
            "         1       111         1         1         7         4\n"
            "         1        12         7       400\n"
            "         2        21         1         1         7         2\n"
            "         0         1         1\n"
            "         1         7\n");
  EXPECT_EQ(after(text, "    82"),
            "         1        10         7\nedge" + std::string(76, ' ') +
                "\n"
                "         1        12         0         7       400         1        12         7\n"
                "       400         1\n");
}

TEST_F(UniversalMesh, IsConvertedByItsUnits) {
  EXPECT_EQ(uff_mesh(units_set(10, 1000.0, 1.0) + old_nodes, "wing.unv").nodes.at(0).position,
            Eigen::Vector3d(1.0, -0.25, 0.0));
  EXPECT_EQ(uff_mesh(old_nodes, "wing.unv", 0.01).nodes.at(0).position, Eigen::Vector3d(10.0, -2.5, 0.0));
  EXPECT_NE(uff_mesh_refusal(old_nodes).find("state the unit of length"), std::string::npos);
}

TEST_F(UniversalMesh, OfFortranIsRead) {
  const std::string nodes =
      "    -1\n  2411\n         3         1         1        11\n"
      "   1.0000000000000000D+00  -2.5000000000000000D-01   0.0000000000000000D+00\n    -1\n";
  EXPECT_EQ(uff_mesh(units_set(1, 1.0, 1.0) + nodes, "wing.unv").nodes.at(0).position,
            Eigen::Vector3d(1.0, -0.25, 0.0));
}

TEST_F(UniversalMesh, WithUnknownNodesOrWrongCountsIsNoted) {
  const std::string line =
      "    -1\n    82\n         1         9         7\nNONE\n        12         0        13\n    -1\n";
  const UffMesh mesh = uff_mesh(units_set(1, 1.0, 1.0) + old_nodes + line, "wing.unv");
  ASSERT_EQ(mesh.notes.size(), 2U);
  EXPECT_EQ(mesh.notes[0], "wing.unv:11: a trace line states 9 nodes and has 3");
  EXPECT_EQ(mesh.notes[1], "wing.unv: elements and trace lines name nodes that the file does not have, 1 times");
}

TEST_F(UniversalMesh, ThatCannotBeReadIsRefused) {
  const std::string units = units_set(1, 1.0, 1.0);
  EXPECT_NE(uff_mesh_refusal(units).find("holds no nodes"), std::string::npos);
  std::string local = old_nodes;
  local.replace(local.find("         0"), 10, "         3");
  EXPECT_NE(uff_mesh_refusal(units + local).find("coordinate system 3"), std::string::npos);
  const std::string element =
      "    -1\n  2412\n         1       111         1         1         7 999999999\n         1\n    -1\n";
  EXPECT_NE(uff_mesh_refusal(units + old_nodes + element).find("wing.unv:13: \"\" in columns 11 to 20"),
            std::string::npos);
  EXPECT_NE(uff_mesh_refusal(units + "    -1\n    15\n       1.5\n    -1\n").find("\"1.5\" in columns 1 to 10"),
            std::string::npos);
}

TEST_F(UniversalMesh, IsNotWrittenFromWhatItCannotHold) {
  std::vector<UffMesh> refused(7, small_mesh());
  refused[0].nodes[1].label = 1;
  refused[1].nodes[1].label = 0;
  refused[2].nodes[1].position.y() = std::nan("");
  refused[3].elements[0].nodes[2] = 8;
  refused[4].lines[0].nodes.assign(251, 1);
  refused[5].lines[0].nodes[0] = 1000;
  refused[6].elements[0].nodes.clear();
  for (const UffMesh& mesh : refused) EXPECT_THROW(write_uff_mesh(path("wing.unv"), mesh), core::InputError);
  EXPECT_TRUE(is_empty());
}

}  // namespace thinwall::io::test::uff_mesh_test
