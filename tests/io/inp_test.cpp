// Input files of Abaqus and CalculiX: what is written comes back, and what is wrong is told with its line.

#include "io/mesh/inp.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <random>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "scratch_folder.hpp"
#include "tests/mesh/kuhn_box.hpp"
#include "tests/processor_time.hpp"

namespace thinwall::io::inp_test {
namespace {

using InpFile = test::ScratchFolder;

/// A box whose corners lie at coordinates of full precision.
mesh::TetMesh jittered_box() {
  mesh::TetMesh box = mesh::kuhn_box({0.45, 0.1, 0.006}, {4, 3, 1});
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-1e-4, 1e-4);
  for (auto& x : box.vertices) x += Eigen::Vector3d(shift(random), shift(random), shift(random));
  return box;
}

void expect_same(const mesh::SolidMesh& read, const mesh::TetMesh& mesh, const mesh::LagrangeNodes& nodes) {
  EXPECT_EQ(read.mesh.tets, mesh.tets);
  EXPECT_EQ(read.nodes.order, nodes.order);
  ASSERT_EQ(read.nodes.positions.rows(), nodes.positions.rows());
  EXPECT_TRUE(read.nodes.elements == nodes.elements);
  for (Eigen::Index i = 0; i < nodes.positions.rows(); ++i) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(read.nodes.positions(i, axis), nodes.positions(i, axis), 5e-14 * std::abs(nodes.positions(i, axis)));
    }
  }
  ASSERT_EQ(read.mesh.vertices.size(), mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    EXPECT_EQ(read.mesh.vertices[i].transpose(), read.nodes.positions.row(static_cast<Eigen::Index>(i)));
  }
}

class InpRoundTrip : public test::ScratchFolder, public ::testing::WithParamInterface<int> {};

TEST_P(InpRoundTrip, GivesBackNodesElementsAndSets) {
  const mesh::TetMesh box = jittered_box();
  const auto nodes = mesh::lagrange_nodes(box, GetParam());
  std::vector<int> many(20);
  for (int i = 0; i < 20; ++i) many[static_cast<std::size_t>(i)] = 2 * i;
  write_inp(path("box.inp"), nodes, {{"ONE", {3}}, {"TWENTY", many}});
  const mesh::SolidMesh read = read_inp(path("box.inp"), 1.0);
  expect_same(read, box, nodes);
  EXPECT_LT(read.midside_offset, 1e-10);
  EXPECT_EQ(node_set(read, "one", "box.inp").nodes, std::vector<int>{3});
  EXPECT_EQ(node_set(read, "Twenty", "box.inp").nodes, many);
  EXPECT_EQ(node_set(read, "all_nodes", "box.inp").nodes.size(), read.node_labels.size());
  EXPECT_EQ(read.node_labels.front(), 1);
  EXPECT_EQ(read.element_labels.back(), static_cast<std::int64_t>(box.tets.size()));
}

INSTANTIATE_TEST_SUITE_P(Orders, InpRoundTrip, ::testing::Values(1, 2));

/// The ten nodes of one element, the mid-edge ones put where the manual's figure has them: 5 on 1-2, 6 on 2-3, 7 on
/// 3-1, 8 on 1-4, 9 on 2-4, 10 on 3-4.
TEST_F(InpFile, PutsMidEdgeNodesWhereTheFormatHasThem) {
  const mesh::SolidMesh read =
      read_inp(write("tet.inp",
                     "*NODE\n1,0,0,0\n2,2,0,0\n3,0,2,0\n4,0,0,2\n5,1,0,0\n6,1,1,0\n7,0,1,0\n8,0,0,1\n"
                     "9,1,0,1\n10,0,1,1\n*ELEMENT,TYPE=C3D10\n1,1,2,3,4,5,6,7,8,9,10\n"),
               1.0);
  EXPECT_EQ(read.midside_offset, 0.0);
  const auto own = mesh::lagrange_nodes(read.mesh, 2);
  for (Eigen::Index a = 0; a < 10; ++a) {
    EXPECT_EQ(read.nodes.positions.row(read.nodes.elements(0, a)), own.positions.row(own.elements(0, a))) << a;
  }
}

/// The last two exchanged, as Gmsh has them, is put right.
TEST_F(InpFile, TellsHowFarMidEdgeNodesLieOffTheirEdges) {
  const std::string nodes =
      "*NODE\n1,0,0,0\n2,2,0,0\n3,0,2,0\n4,0,0,2\n5,1,0.2,0\n6,1,1,0\n7,0,1,0\n8,0,0,1\n9,1,0,1\n10,0,1,1\n";
  const mesh::SolidMesh bent =
      read_inp(write("bent.inp", nodes + "*ELEMENT,TYPE=C3D10\n1,1,2,3,4,5,6,7,8,9,10\n"), 1.0);
  EXPECT_NEAR(bent.midside_offset, 0.1, 1e-15);
  const mesh::SolidMesh swapped =
      read_inp(write("swapped.inp", nodes + "*ELEMENT,TYPE=C3D10\n1,1,2,3,4,5,6,7,8,10,9\n"), 1.0);
  EXPECT_TRUE(swapped.nodes.elements == bent.nodes.elements);
}

constexpr const char* by_hand = R"(** a comment
*Heading
 any text, at all
*NODE, nset=Every
  1000,  0.0,   0.,  0
  10,    +1.0,  0.0, 0.0
** nodes need not be sorted
  20,    0.0,   1.0D+0, 0.0
  7,     0.0,   0.0, 1e0
  500,   9, 9, 9
  21,    -1.0,  0.0, 0.0
*Element, type=C3D4,
   elset=Body
  5, 1000, 10, 20,
     7
  3, 1000, 20, 21, 7

*Nset, nset="Some"
  10, 20,
  every
*NSET, NSET=RANGE, GENERATE
  7, 21, 7
  1000, 2000
*NSET, NSET=FEW
  1000, 10
*BOUNDARY
  FEW, 1, 3
)";

TEST_F(InpFile, OfAnotherHandIsReadWithGapsRangesCommentsAndContinuedLines) {
  const mesh::SolidMesh read = read_inp(write("hand.inp", by_hand), 0.001);
  EXPECT_EQ(read.node_labels, (std::vector<std::int64_t>{7, 10, 20, 21, 1000})) << "node 500 belongs to no element";
  EXPECT_EQ(read.element_labels, (std::vector<std::int64_t>{5, 3}));
  EXPECT_EQ(read.nodes.order, 1);
  ASSERT_EQ(read.mesh.tets.size(), 2U);
  EXPECT_EQ(read.mesh.tets[0], (std::array{4, 1, 2, 0}));
  EXPECT_EQ(read.mesh.tets[1], (std::array{4, 2, 3, 0}));
  EXPECT_NEAR(mesh::volume(read.mesh), 2.0 / 6.0 * 1e-9, 1e-24) << "in millimetres";
  EXPECT_EQ(node_set(read, "every", "").nodes, (std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_EQ(node_set(read, "SOME", "").nodes, (std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_EQ(node_set(read, "range", "").nodes, (std::vector<int>{0, 3, 4})) << "7, 14 (absent), 21, and 1000";
  EXPECT_EQ(node_set(read, "few", "").nodes, (std::vector<int>{1, 4}));
  EXPECT_NE(test::message_of<core::DataError>([&] { (void)node_set(read, "rnge", "hand.inp"); }).find("RANGE"),
            std::string::npos);
}

TEST_F(InpFile, OfRangesTakesEveryStepThatIsANode) {
  std::string text = "*ELEMENT, TYPE=C3D4\n1,1,2,3,4\n*NODE\n";
  for (int node = 1; node <= 2000; ++node)
    if (node != 1001) text += std::to_string(node) + ",0,0," + std::to_string(node) + "\n";
  text += "*NSET,NSET=FEW,GENERATE\n1,2000,500\n*NSET,NSET=ODD,GENERATE\n3,1000000,2\n*NSET,NSET=ONE,GENERATE\n7,7\n";
  const auto sets = inp_mesh(text, "ranges.inp", 1.0).mesh.node_sets;
  ASSERT_EQ(sets.size(), 3U);
  EXPECT_EQ(sets[0].labels, (std::vector<std::int64_t>{1, 501, 1501})) << "1001 is absent";
  EXPECT_EQ(sets[1].labels.size(), 998U);
  EXPECT_EQ(sets[1].labels.back(), 1999);
  EXPECT_EQ(sets[2].labels, std::vector<std::int64_t>{7});
}

/// Two megabytes that name each other, or ranges, as often as they can: read or refused, not computed for minutes. Each
/// takes up to 2 s of processor time on an idle machine, up to 4 s on a busy one.
TEST_F(InpFile, WhoseSetsMultiplyEndsSoon) {
  const std::string tet = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT,TYPE=C3D4\n1,1,2,3,4\n";
  const auto filled = [](std::string text, std::size_t size, const std::function<std::string(int)>& line) {
    for (int k = 1; text.size() < size; ++k) text += line(k);
    return text;
  };
  const auto number = [](int k) { return std::to_string(k); };
  std::vector<std::string> files;
  files.push_back(filled(tet + "*NSET,NSET=A0\n1\n", 2000000,
                         [&](int k) { return "*NSET,NSET=A" + number(k) + "\nA" + number(k - 1) + "\n"; }));
  files.push_back(filled(tet + "*NSET,NSET=A\n1\n*NSET,NSET=B\n", 1000000, [](int) { return "A,A,A,A\n"; }));
  files.back() = filled(files.back(), 2000000, [&](int k) { return "*NSET,NSET=C" + number(k) + "\nB\n"; });
  const std::string nodes = filled(tet + "*NODE\n", 1000000, [&](int k) { return number(k + 4) + ",0,0,1\n"; });
  for (const char* range :
       {"1,2147483647,99999999\n", "1,2147483647,400000\n", "1,2147483647,9000\n", "1,90000,7\n", "90001,90002\n"})
    files.push_back(filled(nodes + "*NSET,NSET=R,GENERATE\n", 2000000, [&](int) { return range; }));
  files.push_back(filled(tet, 2000000, [&](int k) {
    return "*MATERIAL,NAME=M" + number(k) + "\n*SOLID SECTION,ELSET=E,MATERIAL=M" + number(k) + "\n";
  }));
  for (std::size_t i = 0; i < files.size(); ++i) {
    const double start = tests::processor_seconds();
    try {
      (void)inp_mesh(files[i], "many.inp", 1.0);
    } catch (const core::DataError& error) {
      EXPECT_NE(std::string(error.what()).find("too many members"), std::string::npos) << i << ": " << error.what();
    }
    EXPECT_LT(tests::processor_seconds() - start, 20.0) << i;
  }
}

TEST_F(InpFile, WithWindowsLineEndsReadsTheSame) {
  std::string text;
  for (const char* c = by_hand; *c != '\0'; ++c) text += *c == '\n' ? std::string("\r\n") : std::string(1, *c);
  const mesh::SolidMesh read = read_inp(write("crlf.inp", text), 1.0);
  EXPECT_EQ(read.node_labels, (std::vector<std::int64_t>{7, 10, 20, 21, 1000}));
  EXPECT_EQ(node_set(read, "range", "").nodes, (std::vector<int>{0, 3, 4}));
}

const std::string corners = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n";
const std::string sound = corners + "*ELEMENT, TYPE=C3D4\n1,1,2,3,4\n";

struct BadFile {
  const char* name;
  std::string text;
  std::vector<std::string> says;
};

class BadInp : public test::ScratchFolder, public ::testing::WithParamInterface<BadFile> {};

TEST_P(BadInp, IsToldWithItsLine) {
  const auto file = write("bad.inp", GetParam().text);
  const std::string message = test::message_of<core::DataError>([&] { (void)read_inp(file, 1.0); });
  for (const std::string& part : GetParam().says) EXPECT_NE(message.find(part), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    Files, BadInp,
    ::testing::Values(
        BadFile{"Empty", "", {"bad.inp", "no *ELEMENT"}}, BadFile{"NodesOnly", corners, {"no *ELEMENT"}},
        BadFile{"Word", "*NODE\n1,0,zero,0\n", {"bad.inp:2:", "\"zero\""}},
        BadFile{"NotANumber", "*NODE\n1,0,nan,0\n", {"bad.inp:2:", "finite"}},
        BadFile{"Infinity", "*NODE\n1,0,1e999,0\n", {"bad.inp:2:", "finite"}},
        BadFile{"DecimalComma", "*NODE\n1,0,5,0,0,0\n", {"bad.inp:2:", "beyond"}},
        BadFile{"NegativeLabel", "*NODE\n-1,0,0,0\n", {"bad.inp:2:", "\"-1\""}},
        BadFile{"HugeLabel", "*NODE\n99999999999,0,0,0\n", {"bad.inp:2:", "2147483647"}},
        BadFile{"NodeTwice", sound + "*NODE\n3,5,5,5\n", {"bad.inp:9:", "node 3", "line 4"}},
        BadFile{"ElementTwice", sound + "1,1,2,3,4\n", {"bad.inp:8:", "element 1", "line 7"}},
        BadFile{"AbsentNode", corners + "*ELEMENT, TYPE=C3D4\n1,1,2,3,5\n", {"bad.inp:7:", "node 5"}},
        BadFile{"Inverted", corners + "*ELEMENT, TYPE=C3D4\n1,1,3,2,4\n", {"bad.inp:7:", "element 1", "volume"}},
        BadFile{"Short", corners + "*ELEMENT, TYPE=C3D4\n1,1,2,3\n*NSET, NSET=A\n1\n", {"bad.inp:7:", "lacks 1"}},
        BadFile{"ShortAtTheEnd", corners + "*ELEMENT, TYPE=C3D4\n1,1,2", {"bad.inp:7:", "lacks 2"}},
        BadFile{"Long", corners + "*ELEMENT, TYPE=C3D4\n1,1,2,3,4,4\n", {"bad.inp:7:", "more than 4"}},
        BadFile{"ShortBrick", corners + "*ELEMENT, TYPE=C3D8\n1,1,2,3,4\n", {"bad.inp:7:", "lacks 4"}},
        BadFile{"BothOrders",
                sound + "*ELEMENT, TYPE=C3D10\n2,1,2,3,4,1,2,3,4,1,2\n",
                {"bad.inp:9:", "element 2", "one order"}},
        BadFile{"AbsentInclude", sound + "*INCLUDE, INPUT=more.inp\n", {"bad.inp:8:", "more.inp\" is not there"}},
        BadFile{"NamelessInclude", sound + "*INCLUDE\n", {"bad.inp:8:", "INPUT=file"}},
        BadFile{"IncludedFolder", sound + "*INCLUDE, INPUT=.\n", {"bad.inp:8:", "no plain file"}},
        BadFile{"IncludedInItself", sound + "*INCLUDE, INPUT=./bad.inp\n", {"bad.inp:8:", "includes itself"}},
        BadFile{"NodeGeneration", "*NODE\n1,0,0,0\n*ngen\n1,5,1\n", {"bad.inp:3:", "*NGEN"}},
        BadFile{"NamelessSet", sound + "*NSET\n1\n", {"bad.inp:8:", "NSET=name"}},
        BadFile{"SetOfUnknownSet", sound + "*NSET, NSET=A\nB\n", {"bad.inp:9:", "\"B\""}},
        BadFile{"RangeBackwards", sound + "*NSET, NSET=A, GENERATE\n5, 1, 1\n", {"bad.inp:9:", "from 5 down to 1"}},
        BadFile{"RangeOfStepZero", sound + "*NSET, NSET=A, GENERATE\n1, 5, 0\n", {"bad.inp:9:", "\"0\""}}),
    [](const auto& file) { return file.param.name; });

/// The lines of a file go on in those that it includes, in the section that is open, and its own go on behind them.
TEST_F(InpFile, IncludesOthersInTheirPlaces) {
  std::filesystem::create_directory(path("mesh"));
  write("mesh/points.txt", "2,1,0,0\n3,0,1,0\n");
  write("mesh/Corners.inp", "*NODE\n1,0,0,0\n*include, input=mesh/points.txt\n4,0,0,1\n");
  write("mesh/fixed.inp", "*NSET, NSET=FIXED\n1, 2\n");
  const auto file = write("main.inp",
                          "*INCLUDE, INPUT=\"mesh\\Corners.inp\"\n*ELEMENT, TYPE=C3D4\n1,1,2,3,4\n"
                          "*INCLUDE, INPUT=mesh/fixed.inp\n*INCLUDE, INPUT=mesh/fixed.inp\n*NSET, NSET=TOP\n4\n");
  const InpLabelled read = inp_mesh(core::read_file(file), file.string(), 1.0);
  const mesh::SolidMesh solid = mesh::solid_mesh(read.mesh);
  EXPECT_NEAR(mesh::volume(solid.mesh), 1.0 / 6.0, 1e-15);
  EXPECT_EQ(mesh::node_set(solid, "FIXED", "").nodes, (std::vector<int>{0, 1}));
  EXPECT_EQ(mesh::node_set(solid, "TOP", "").nodes, std::vector<int>{3});
  std::vector<std::string> names;
  for (const auto& included : read.included) names.push_back(included.filename().string());
  EXPECT_EQ(names, (std::vector<std::string>{"Corners.inp", "fixed.inp", "points.txt"})) << "each once";
}

/// A fault is told with the file and the line where it stands, on both sides of an included file and within it.
TEST_F(InpFile, TellsFaultsWithTheIncludedFileAndItsLine) {
  const auto message = [&](const std::string& main, const std::string& more) {
    write("more.inp", more);
    const auto file = write("main.inp", main);
    return test::message_of<core::DataError>([&] { (void)read_inp(file, 1.0); });
  };
  const std::string include = "*INCLUDE, INPUT=more.inp\n";
  const std::string within = message(corners + include, "** none\n5,0,zero,0\n");
  EXPECT_NE(within.find("more.inp:2: \"zero\""), std::string::npos) << within;
  const std::string behind = message(sound + include + "*NODE\n9,0,0\n*NODE\n8,x,0,0\n", "*NSET, NSET=A\n1\n");
  EXPECT_NE(behind.find("main.inp:12: \"x\""), std::string::npos) << behind;
  const std::string twice = message(sound + include, "*NODE\n3,5,5,5\n");
  EXPECT_NE(twice.find("more.inp:2: node 3 is there already, at "), std::string::npos) << twice;
  EXPECT_NE(twice.find("main.inp:4"), std::string::npos) << twice;
  const std::string again = message(include + include, sound);
  EXPECT_NE(again.find("main.inp:2:"), std::string::npos) << again;
  EXPECT_NE(again.find("for the second time"), std::string::npos) << again;
  const std::string cycle = message(include, sound + "*INCLUDE, INPUT=main.inp\n");
  EXPECT_NE(cycle.find("more.inp:8: the file \"main.inp\" includes itself"), std::string::npos) << cycle;
}

TEST_F(InpFile, IncludesTenFilesWithinEachOtherAndAThousandInAll) {
  const auto chain = [&](int files) {  // each names the next, the last one has the mesh
    for (int k = 0; k < files; ++k) write("f" + std::to_string(k), "*INCLUDE, INPUT=f" + std::to_string(k + 1) + "\n");
    write("f" + std::to_string(files), sound);
    return path("f0");
  };
  EXPECT_EQ(read_inp(chain(10), 1.0).mesh.tets.size(), 1U);
  EXPECT_NE(test::message_of<core::DataError>([&] { (void)read_inp(chain(11), 1.0); }).find("more than 10 files"),
            std::string::npos);
  write("empty", "** nothing\n");
  std::string text = sound;
  for (int k = 0; k < 1000; ++k) text += "*INCLUDE, INPUT=empty\n";
  EXPECT_EQ(read_inp(write("many.inp", text), 1.0).mesh.tets.size(), 1U);
  const auto file = write("many.inp", text + "*INCLUDE, INPUT=empty\n");
  EXPECT_NE(test::message_of<core::DataError>([&] { (void)read_inp(file, 1.0); }).find("more than 1000 files"),
            std::string::npos);
}

/// Abaqus and CalculiX take a coordinate that is blank, or left out, as 0.
TEST_F(InpFile, TakesCoordinatesThatAreLeftOutAsZeroAndTellsSo) {
  const mesh::SolidMesh solid =
      read_inp(write("blank.inp", "*NODE\n1\n2,1\n3,,1\n4, , ,1.\n*ELEMENT, TYPE=C3D4\n1,1,2,3,4\n"), 1.0);
  EXPECT_NEAR(mesh::volume(solid.mesh), 1.0 / 6.0, 1e-15);
  const auto told = std::find_if(solid.notices.begin(), solid.notices.end(), [](const std::string& notice) {
    return notice.find("4 nodes have fewer than three coordinates") != std::string::npos;
  });
  ASSERT_NE(told, solid.notices.end());
  EXPECT_NE(told->find("blank.inp:2)"), std::string::npos) << *told;
}

TEST_F(InpFile, MayHaveASetOfAMissingNodeThatNobodyUses) {
  const auto file = write("sets.inp", sound +
                                          "*NSET, NSET=A\n1, 9\n*NSET, NSET=B\nA\n*NSET, NSET=C\n2\n"
                                          "*SURFACE, NAME=S, TYPE=NODE\nA\n");
  const mesh::SolidMesh solid = read_inp(file, 1.0);
  EXPECT_EQ(node_set(solid, "C", "").nodes, std::vector<int>{1});
  for (const char* name : {"A", "B", "S"}) {
    const std::string message = test::message_of<core::DataError>([&] { (void)node_set(solid, name, ""); });
    EXPECT_NE(message.find("sets.inp:9: the set \"" + std::string(name) + "\" names node 9"), std::string::npos)
        << message;
  }
  EXPECT_EQ(std::count_if(solid.notices.begin(), solid.notices.end(),
                          [](const std::string& notice) { return notice.starts_with("3 sets name missing nodes"); }),
            1);
}

TEST_F(InpFile, WhereACornerIsAMidEdgeNodeElsewhereDoesNotFitTogether) {
  const auto file = write("bad.inp",
                          "*NODE\n1,0,0,0\n2,2,0,0\n3,0,2,0\n4,0,0,2\n5,1,0,0\n6,1,1,0\n7,0,1,0\n8,0,0,1\n9,1,0,1\n"
                          "10,0,1,1\n11,0,0,-2\n*ELEMENT, TYPE=C3D10\n1,1,2,3,4,5,6,7,8,9,10\n"
                          "2,5,2,3,4,1,6,7,8,9,10\n");
  const std::string message = test::message_of<core::DataError>([&] { (void)read_inp(file, 1.0); });
  EXPECT_NE(message.find(":15: node 5"), std::string::npos) << message;
}

TEST_F(InpFile, IsNotWrittenFromWhatTheFormatCannotHold) {
  const auto nodes = mesh::lagrange_nodes(jittered_box(), 2);
  const auto cubic = mesh::lagrange_nodes(jittered_box(), 3);
  EXPECT_THROW(write_inp(path("a.inp"), cubic, {}), core::InputError);
  for (const char* name : {"", "two words", "a,b", "1st"}) {
    EXPECT_THROW(write_inp(path("a.inp"), nodes, {{name, {0}}}), core::InputError) << name;
  }
  const InpFrequencyStep held_elsewhere{210e9, 0.3, 7850.0, {"B"}, 10};
  EXPECT_THROW(write_inp(path("a.inp"), nodes, {{"A", {0}}}, held_elsewhere), core::InputError);
  auto broken = nodes;
  broken.positions(5, 1) = std::nan("");
  EXPECT_THROW(write_inp(path("a.inp"), broken, {}), core::NumericalError);
  EXPECT_THROW((void)read_inp(path("a.inp"), 1.0), core::DataError) << "nothing was left behind";
  EXPECT_THROW((void)read_inp(write("b.inp", sound), 0.0), core::InputError);
}

/// CalculiX reads twenty characters of a number and drops the rest, exponent and all; 132 of a line.
TEST_F(InpFile, KeepsItsNumbersWithinTwentyCharactersAndItsLinesWithin132) {
  auto nodes = mesh::lagrange_nodes(jittered_box(), 2);
  nodes.positions.row(0) << -1.2345678901234567e-105, 1.0 / 3.0, -2.0e22 / 3.0;
  write_inp(path("wide.inp"), nodes, {});
  const std::string text = core::read_file(path("wide.inp"));
  std::size_t field = 0;
  std::size_t line = 0;
  for (const char c : text) {
    line = c == '\n' ? 0 : line + 1;
    field = c == '\n' || c == ',' ? 0 : field + (c == ' ' ? 0 : 1);
    ASSERT_LE(line, 132U);
    ASSERT_LE(field, 20U);
  }
}

}  // namespace
}  // namespace thinwall::io::inp_test
