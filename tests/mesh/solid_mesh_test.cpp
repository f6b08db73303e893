// Meshes of other programs as tetrahedra: split meshes fill the same volume and fit together, and what is wrong is
// told.

#include "mesh/solid/solid_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "core/error.hpp"
#include "curved_volume.hpp"
#include "labelled_grids.hpp"
#include "mesh/solid/tet_jacobian.hpp"

namespace thinwall::mesh::solid_mesh_test {
namespace {

/// A frustum: tapered, so that cells are no parallelepipeds, with flat faces and straight edges.
Eigen::Vector3d tapered(const Eigen::Vector3d& u) {
  const double scale = 1.0 - 0.4 * u.z();
  return {0.3 * scale * (u.x() - 0.3), 0.2 * scale * (u.y() - 0.6), 0.1 * u.z()};
}

/// ∫ 0.3 · 0.2 (1 − 0.4 z)² 0.1 dz.
const double tapered_volume = 0.3 * 0.2 * 0.1 * (1.0 - std::pow(0.6, 3)) / 1.2;

/// A quarter of a ring, radii 1 and 1.2, height 0.5.
Eigen::Vector3d ring(const Eigen::Vector3d& u) {
  const double radius = 1.0 + 0.2 * u.y();
  const double angle = 0.5 * std::numbers::pi * (1.0 - u.x());
  return {radius * std::cos(angle), radius * std::sin(angle), 0.5 * u.z()};
}

const double ring_volume = 0.25 * std::numbers::pi * 0.44 * 0.5;

struct Kind {
  CellShape shape;
  std::size_t nodes;
};

class Split : public ::testing::TestWithParam<Kind> {
 protected:
  [[nodiscard]] SolidMesh grid(const std::array<int, 3>& cells, const PointMap& map, unsigned seed) const {
    return solid_mesh(LabelledGrid(cells, GetParam().shape, GetParam().nodes, map, seed).mesh);
  }
};

/// Neighbours that cut a face along different diagonals would leave triangles inside.
TEST_P(Split, FillsTheVolumeAndFitsTogetherWhateverTheNumbers) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const SolidMesh solid = grid({3, 2, 4}, tapered, seed);
    EXPECT_NEAR(volume_of(solid), tapered_volume, 1e-13 * tapered_volume);
    EXPECT_EQ(boundary(solid.mesh).size(), 2U * 2U * (3 * 2 + 2 * 4 + 3 * 4));
    EXPECT_EQ(solid.mesh.tets.size(), 6U * 24U);
    EXPECT_EQ(solid.pieces, 1);
    EXPECT_EQ(solid.coincident_nodes, 0);
    EXPECT_LT(solid.midside_offset, 0.11)
        << "the middles of diagonals of a taper lie off their edges, within the faces";
  }
}

TEST_P(Split, MakesTheNodesThatDiagonalsNeedOnceAndPutsThemIntoTheSets) {
  const SolidMesh solid = grid({3, 2, 4}, tapered, 3);
  const bool hex = GetParam().shape == CellShape::hexahedron;
  const auto made = std::count(solid.node_labels.begin(), solid.node_labels.end(), -1);
  const std::ptrdiff_t faces = 4 * 2 * 4 + 3 * 3 * 4 + 3 * 2 * 5;
  const bool serendipity = GetParam().nodes == 20 || GetParam().nodes == 15;
  // The wedges' triangles have their diagonals; a cell has one four-sided face between its two wedges.
  EXPECT_EQ(made, !serendipity ? 0 : hex ? faces + 24 : faces - 3 * 2 * 5 + 24);
  const double left = tapered({0.0, 0.0, 0.0}).x();
  std::set<int> expected;
  for (Eigen::Index i = 0; i < solid.nodes.positions.rows(); ++i) {
    const double height = solid.nodes.positions(i, 2) / 0.1;
    if (std::abs(solid.nodes.positions(i, 0) - left * (1.0 - 0.4 * height)) < 1e-9)
      expected.insert(static_cast<int>(i));
  }
  const NodeSet& set = node_set(solid, "left", "grid");
  EXPECT_EQ(std::set<int>(set.nodes.begin(), set.nodes.end()), expected);
  EXPECT_EQ(element_set(solid, "FIRST", "grid").tets.size(), hex ? 6U : 3U);
}

TEST_P(Split, KeepsCurvedFaces) {
  if (GetParam().nodes <= 8) return;  // linear
  std::array<double, 2> error{};
  for (const int fold : {1, 2})
    error[static_cast<std::size_t>(fold - 1)] =
        std::abs(volume_of(grid({3 * fold, fold, fold}, ring, 5)) / ring_volume - 1.0);
  std::printf("volume of a ring: errors %.1e, %.1e\n", error[0], error[1]);
  EXPECT_LT(error[0], 3e-4);
  EXPECT_GT(std::log2(error[0] / error[1]), 3.5) << "straight-sided elements converge with 2";
}

INSTANTIATE_TEST_SUITE_P(Kinds, Split,
                         ::testing::Values(Kind{CellShape::hexahedron, 8}, Kind{CellShape::hexahedron, 20},
                                           Kind{CellShape::hexahedron, 27}, Kind{CellShape::wedge, 6},
                                           Kind{CellShape::wedge, 15}, Kind{CellShape::wedge, 18}),
                         [](const auto& kind) { return "Nodes" + std::to_string(kind.param.nodes); });

/// Corners 0 to 3 of a tetrahedron and the middles of its edges, bent by `shift` at the first.
LabelledMesh tet10(const Eigen::Vector3d& shift = Eigen::Vector3d::Zero()) {
  LabelledMesh mesh;
  mesh.path = "file";
  const std::array<Eigen::Vector3d, 4> corner{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}}};
  for (std::size_t k = 0; k < 4; ++k) mesh.nodes.push_back({static_cast<std::int64_t>(k), 0, corner[k]});
  for (const auto& [a, b] : topology(CellShape::tetrahedron).edges)
    mesh.nodes.push_back({static_cast<std::int64_t>(mesh.nodes.size()), 0, 0.5 * (corner[a] + corner[b])});
  mesh.nodes[4].x += shift;
  mesh.cells.push_back({17, 0, CellShape::tetrahedron, 0, 10});
  for (std::int64_t a = 0; a < 10; ++a) mesh.cell_nodes.push_back(a);
  return mesh;
}

template <class Call>
std::string message_of(Call call) {
  try {
    call();
  } catch (const core::DataError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

std::string refusal(LabelledMesh mesh) {
  return message_of([&] { (void)solid_mesh(std::move(mesh)); });
}

void expect_parts(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(message.find(part), std::string::npos) << message;
}

bool has_notice(const SolidMesh& solid, const std::string& part) {
  return std::any_of(solid.notices.begin(), solid.notices.end(),
                     [&](const std::string& notice) { return notice.find(part) != std::string::npos; });
}

/// Two tetrahedra over one triangle, as the file's first and second element.
LabelledMesh two_tets() {
  LabelledMesh mesh = tet10();
  mesh.nodes.resize(4);
  mesh.nodes.push_back({40, 0, {0, 0, -2}});
  mesh.cells = {{1, 0, CellShape::tetrahedron, 0, 4}, {2, 0, CellShape::tetrahedron, 4, 4}};
  mesh.cell_nodes = {0, 1, 2, 3, 0, 2, 1, 40};
  return mesh;
}

TEST(MidsideOrder, IsPutRightIfTheLastTwoAreExchangedEverywhere) {
  LabelledMesh swapped = tet10();
  std::swap(swapped.cell_nodes[8], swapped.cell_nodes[9]);
  const SolidMesh right = solid_mesh(tet10());
  const SolidMesh solid = solid_mesh(swapped);
  EXPECT_TRUE(solid.nodes.elements == right.nodes.elements);
  EXPECT_TRUE(has_notice(solid, "exchanged"));
  EXPECT_FALSE(has_notice(right, "exchanged"));
  EXPECT_EQ(solid.midside_offset, 0.0);
}

TEST(MidsideOrder, OfAnyOtherKindIsRefusedWithTheElement) {
  for (std::size_t i = 4; i < 10; ++i) {
    for (std::size_t j = i + 1; j < 10; ++j) {
      if (i == 8 && j == 9) continue;
      LabelledMesh wrong = tet10();
      std::swap(wrong.cell_nodes[i], wrong.cell_nodes[j]);
      expect_parts(refusal(wrong), {"element 17", "order"});
    }
  }
  // One of two elements in Gmsh's order, the other not.
  LabelledGrid grid({1, 1, 1}, CellShape::wedge, 15, tapered);
  const SolidMesh split = solid_mesh(grid.mesh);
  LabelledMesh mixed;
  for (Eigen::Index i = 0; i < split.nodes.positions.rows(); ++i)
    mixed.nodes.push_back({i, 0, split.nodes.positions.row(i).transpose()});
  const auto alphas = lattice(2);
  for (Eigen::Index e = 0; e < split.nodes.elements.rows(); ++e) {
    mixed.cells.push_back({e, 0, CellShape::tetrahedron, mixed.cell_nodes.size(), 10});
    for (Eigen::Index k = 0; k < 4; ++k) mixed.cell_nodes.push_back(split.nodes.elements(e, k));
    for (const auto& [a, b] : topology(CellShape::tetrahedron).edges) {
      std::array<int, 4> alpha{};
      alpha[a] = alpha[b] = 1;
      const auto column = std::find(alphas.begin(), alphas.end(), alpha) - alphas.begin();
      mixed.cell_nodes.push_back(split.nodes.elements(e, column));
    }
  }
  EXPECT_EQ(solid_mesh(mixed).mesh.tets.size(), 6U);
  std::swap(mixed.cell_nodes[38], mixed.cell_nodes[39]);
  expect_parts(refusal(mixed), {"element 3", "another order"});
}

TEST(MidsideOrder, OfBentElementsIsNotMistaken) {
  LabelledMesh bent = tet10();
  for (std::size_t a = 4; a < 10; ++a) bent.nodes[a].x += Eigen::Vector3d(0.11, 0.12, 0.13);
  EXPECT_NO_THROW((void)solid_mesh(bent));
}

/// Against a dense sample of the element; the bound may refuse a little early, never late.
TEST(Jacobian, IsBoundedOnTheWholeElement) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> shift(-0.35, 0.35);
  int sound = 0;
  for (int trial = 0; trial < 300; ++trial) {
    LagrangeNodes nodes = solid_mesh(tet10()).nodes;
    for (Eigen::Index i = 4; i < 10; ++i)
      for (Eigen::Index k = 0; k < 3; ++k) nodes.positions(i, k) += shift(random);
    const LeastJacobian least = least_jacobian(nodes, 0, 1e-3);
    if (!least.has_volume) continue;
    sound += least.is_sound ? 1 : 0;
    double sampled = 1e9;
    const double mean = 6.0 * volume_of(SolidMesh{{}, nodes, {}, {}, {}, {}, 0.0, 1.0, 1, 0, {}});
    for (const auto& alpha : lattice(10)) {
      const Eigen::Vector4d l(0.1 * alpha[0], 0.1 * alpha[1], 0.1 * alpha[2], 0.1 * alpha[3]);
      sampled = std::min(sampled, quadratic_determinant(nodes, 0, l) / mean);
    }
    EXPECT_TRUE(!least.is_sound || sampled > 1e-3 - 1e-9) << "not refused: " << sampled;
    EXPECT_TRUE(least.is_sound || least.ratio < 0.1) << "refused although it is far from turned: " << least.ratio;
    EXPECT_TRUE(!least.is_sound || sampled > least.ratio - 0.05) << "lower than the least that was found";
  }
  EXPECT_GT(sound, 30);
  EXPECT_LT(sound, 270);
}

TEST(Jacobian, ThatIsNotPositiveIsToldWithElementAndPlace) {
  expect_parts(refusal(tet10({1.2, 0.0, 0.0})), {"element 17", "turned inside out at (2000, 0, 0) mm", "det J is -"});
  LabelledMesh inverted = two_tets();
  std::swap(inverted.cell_nodes[0], inverted.cell_nodes[1]);
  expect_parts(refusal(inverted), {"element 1", "no positive volume", "mm"});
  LabelledMesh flat = two_tets();
  flat.nodes[3].x.setZero();
  flat.nodes[3].x.x() = 1.0;
  expect_parts(refusal(flat), {"element 1", "no positive volume"});
}

TEST(SolidMeshInput, ThatIsWrongIsRefused) {
  LabelledMesh none = two_tets();
  none.cells.clear();
  expect_parts(refusal(none), {"file:", "no solid element"});
  LabelledMesh twice = two_tets();
  twice.nodes.push_back(twice.nodes.front());
  expect_parts(refusal(twice), {"node 0", "already"});
  LabelledMesh element_twice = two_tets();
  element_twice.cells[1].label = 1;
  expect_parts(refusal(element_twice), {"element 1", "already"});
  LabelledMesh absent = two_tets();
  absent.cell_nodes.back() = 41;
  expect_parts(refusal(absent), {"node 41", "not among"});
  LabelledMesh not_finite = two_tets();
  not_finite.nodes[2].x.y() = std::nan("");
  expect_parts(refusal(not_finite), {"node 2", "finite"});
  LabelledMesh stray = two_tets();
  stray.nodes[2].x.y() = 3e38;
  expect_parts(refusal(stray), {"node 2 lies at", "3e+41", "no part is larger"});
  LabelledMesh repeated = two_tets();
  repeated.cell_nodes = {0, 1, 2, 3, 1, 2, 0, 3};
  expect_parts(refusal(repeated), {"element 2", "same nodes as element 1"});
  LabelledMesh orders = tet10();
  orders.cells.push_back({18, 0, CellShape::tetrahedron, 0, 4});
  expect_parts(refusal(orders), {"element 18 has 4 nodes", "one order"});
  LabelledMesh unknown_in_set = two_tets();
  unknown_in_set.node_sets.push_back({"A", {99}});
  expect_parts(refusal(unknown_in_set), {"node 99"});
}

TEST(SolidMeshInput, OfAnEdgeWithTwoMiddlesIsRefused) {
  LabelledMesh mesh = tet10();
  // A second element below, on the same triangle, with a node of its own in the middle of edge 0-1.
  const std::array<Eigen::Vector3d, 4> corner{{{0, 0, 0}, {0, 2, 0}, {2, 0, 0}, {0, 0, -2}}};
  mesh.nodes.push_back({10, 0, corner[3]});
  const std::array<std::int64_t, 4> labels{0, 2, 1, 10};
  mesh.cells.push_back({18, 0, CellShape::tetrahedron, 10, 10});
  mesh.cell_nodes.insert(mesh.cell_nodes.end(), labels.begin(), labels.end());
  const std::array<std::int64_t, 6> middles{6, 5, 14, 11, 12, 13};
  std::size_t e = 0;
  for (const auto& [a, b] : topology(CellShape::tetrahedron).edges) {
    if (middles[e] > 10) mesh.nodes.push_back({middles[e], 0, 0.5 * (corner[a] + corner[b])});
    mesh.cell_nodes.push_back(middles[e++]);
  }
  expect_parts(refusal(mesh), {"element 18", "middle", "nodes 1 and 0"});
}

TEST(SolidMeshInput, OfElementsThatTheFormatRepeatsIsTakenOnce) {
  LabelledMesh repeated = two_tets();
  repeated.cells.push_back({3, 0, CellShape::tetrahedron, 0, 4});
  repeated.cell_sets = {{"A", {1}}, {"B", {3, 2}}};
  repeated.repeated_cells_are_one = true;
  const SolidMesh solid = solid_mesh(repeated);
  EXPECT_EQ(solid.mesh.tets.size(), 2U);
  EXPECT_EQ(element_set(solid, "A", "").tets, std::vector<int>{0});
  EXPECT_EQ(element_set(solid, "B", "").tets, (std::vector<int>{0, 1}));
}

TEST(SolidMeshInput, WithNodesThatNothingUsesLeavesThemOut) {
  LabelledMesh orphans = two_tets();
  orphans.nodes.push_back({50, 0, {9, 9, 9}});
  orphans.nodes.push_back({1000000007, 0, {9, 9, 8}});
  orphans.node_sets.push_back({"A", {50, 40}});
  const SolidMesh solid = solid_mesh(orphans);
  EXPECT_TRUE(has_notice(solid, "2 nodes that no solid element uses"));
  EXPECT_EQ(solid.node_labels, (std::vector<std::int64_t>{0, 1, 2, 3, 40}));
  EXPECT_EQ(node_set(solid, "a", "").nodes, std::vector<int>{4});
}

TEST(SolidMeshInput, OfSeveralPiecesCracksAndHingesIsToldOf) {
  LabelledMesh apart = two_tets();  // the second has corners of its own, at the same places
  for (const std::int64_t k : {0, 1, 2})
    apart.nodes.push_back({100 + k, 0, apart.nodes[static_cast<std::size_t>(k)].x});
  apart.cell_nodes = {0, 1, 2, 3, 100, 102, 101, 40};
  const SolidMesh two = solid_mesh(apart);
  EXPECT_EQ(two.pieces, 2);
  EXPECT_EQ(two.coincident_nodes, 3);
  EXPECT_TRUE(has_notice(two, "in 2 pieces"));
  EXPECT_TRUE(has_notice(two, "3 nodes lie where another one lies"));

  LabelledMesh hinge = two_tets();  // an edge in common
  hinge.nodes.push_back({41, 0, {2, -2, -2}});
  hinge.cell_nodes = {0, 1, 2, 3, 0, 1, 40, 41};
  std::swap(hinge.cell_nodes[6], hinge.cell_nodes[7]);
  const SolidMesh hung = solid_mesh(hinge);
  EXPECT_EQ(hung.pieces, 1);
  EXPECT_TRUE(has_notice(hung, "hang on the rest"));
  EXPECT_FALSE(has_notice(solid_mesh(two_tets()), "hang"));
}

/// A hexahedron, its top covered by two tetrahedra on either diagonal.
TEST(SolidMeshInput, OfTetrahedraOnTheOtherDiagonalOfAFaceIsRefused) {
  LabelledMesh mesh =
      LabelledGrid({1, 1, 1}, CellShape::hexahedron, 8, [](const Eigen::Vector3d& u) { return u; }).mesh;
  mesh.nodes.push_back({1000, 0, {0.5, 0.5, 2.0}});
  const std::vector<std::int64_t> top(mesh.cell_nodes.begin() + 4, mesh.cell_nodes.begin() + 8);
  const std::size_t lowest = static_cast<std::size_t>(std::min_element(top.begin(), top.end()) - top.begin());
  for (const std::size_t start : {lowest, lowest + 1}) {
    LabelledMesh covered = mesh;
    for (const std::size_t k : {std::size_t{1}, std::size_t{2}}) {
      covered.cells.push_back({static_cast<std::int64_t>(k), 0, CellShape::tetrahedron, covered.cell_nodes.size(), 4});
      for (const std::size_t c : {start, start + k, start + k + 1}) covered.cell_nodes.push_back(top[c % 4]);
      covered.cell_nodes.push_back(1000);
    }
    if (start == lowest) {
      EXPECT_EQ(solid_mesh(covered).mesh.tets.size(), 8U);
    } else {
      expect_parts(refusal(covered), {"element 1000", "other diagonal"});
    }
  }
}

TEST(SolidMeshOfOrderOne, IsRaisedToTwoWithItsSets) {
  const SolidMesh one = solid_mesh(LabelledGrid({3, 2, 4}, CellShape::hexahedron, 8, tapered).mesh);
  const SolidMesh two = with_order(one, 2);
  EXPECT_NEAR(volume_of(two), tapered_volume, 1e-13 * tapered_volume);
  std::size_t left = 0;
  for (Eigen::Index i = 0; i < two.nodes.positions.rows(); ++i) {
    const double height = two.nodes.positions(i, 2) / 0.1;
    left += std::abs(two.nodes.positions(i, 0) + 0.09 * (1.0 - 0.4 * height)) < 1e-9 ? 1 : 0;
  }
  EXPECT_EQ(node_set(two, "LEFT", "").nodes.size(), left);
  EXPECT_THROW((void)with_order(two, 1), core::InputError);
  EXPECT_EQ(with_order(two, 2).nodes.positions, two.nodes.positions);
}

}  // namespace
}  // namespace thinwall::mesh::solid_mesh_test
