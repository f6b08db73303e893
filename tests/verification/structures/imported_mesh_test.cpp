// Meshes of other programs have the same frequencies by thinwall and by CalculiX, on one file of tetrahedra. Skipped if
// ccx is absent.

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/atomic_file.hpp"
#include "core/dense_eigenvalues.hpp"
#include "fem/curved_element.hpp"
#include "fem/model.hpp"
#include "fem/reference_element.hpp"
#include "io/mesh/mesh_file.hpp"
#include "tests/mesh/curved_volume.hpp"
#include "tests/mesh/labelled_grids.hpp"
#include "tests/verification/structures/ccx_run.hpp"

namespace thinwall::imported_mesh_test {
namespace {

const fem::Material steel{210e9, 0.3, 7850.0};

/// CalculiX's points: one for C3D4, four (exact to degree 2) for C3D10.
fem::CurvedReference reference_of_ccx(int order) {
  const Eigen::Index points = order == 1 ? 1 : 4;
  fem::CurvedReference reference;
  reference.order = order;
  reference.weight = Eigen::VectorXd::Constant(points, 1.0 / static_cast<double>(points));
  reference.values.resize(order == 1 ? 4 : 10, points);
  for (auto& slope : reference.slopes) slope.resize(reference.values.rows(), points);
  for (Eigen::Index q = 0; q < points; ++q) {
    Eigen::Vector4d lambda = Eigen::Vector4d::Constant(order == 1 ? 0.25 : (5.0 - std::sqrt(5.0)) / 20.0);
    if (order == 2) lambda(q) = (5.0 + 3.0 * std::sqrt(5.0)) / 20.0;
    reference.values.col(q) = fem::shape_functions(order, lambda);
    const Eigen::MatrixX3d slopes = fem::shape_slopes(order, lambda);
    for (std::size_t k = 0; k < 3; ++k) reference.slopes[k].col(q) = slopes.col(static_cast<Eigen::Index>(k));
  }
  return reference;
}

/// The lowest frequencies (Hz) with both matrices integrated as CalculiX does, all nodes of the set held; from the
/// largest μ of M φ = μ K φ, which lets M be singular, as under-integrated mass is.
Eigen::VectorXd frequencies_as_ccx(const mesh::SolidMesh& solid, const fem::Material& material,
                                   const std::vector<int>& held, int count) {
  std::vector<int> row(static_cast<std::size_t>(solid.nodes.positions.rows()), 0);
  for (const int node : held) row[static_cast<std::size_t>(node)] = -1;
  int rows = 0;
  for (int& r : row) {
    if (r == 0) {
      r = rows;
      rows += 3;
    }
  }
  const fem::CurvedReference reference = reference_of_ccx(solid.nodes.order);
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(rows, rows);
  Eigen::MatrixXd M = K;
  for (Eigen::Index e = 0; e < solid.nodes.elements.rows(); ++e) {
    const Eigen::Index n = solid.nodes.elements.cols();
    Eigen::Matrix<double, Eigen::Dynamic, 3> x(n, 3);
    for (Eigen::Index a = 0; a < n; ++a) x.row(a) = solid.nodes.positions.row(solid.nodes.elements(e, a));
    const auto element = fem::curved_element(reference, x, fem::lame(material), material.density_kg_m3);
    for (Eigen::Index a = 0; a < n; ++a) {
      for (Eigen::Index b = 0; b < n; ++b) {
        const int i = row[static_cast<std::size_t>(solid.nodes.elements(e, a))];
        const int j = row[static_cast<std::size_t>(solid.nodes.elements(e, b))];
        if (i < 0 || j < 0) continue;
        K.block<3, 3>(i, j) += element.K.block<3, 3>(3 * a, 3 * b);
        M.block<3, 3>(i, j).diagonal().array() += element.M(a, b);
      }
    }
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(M, K, Eigen::EigenvaluesOnly | Eigen::Ax_lBx);
  return solver.eigenvalues().reverse().head(count).cwiseSqrt().cwiseInverse() / (2.0 * std::numbers::pi);
}

double largest_difference(const Eigen::VectorXd& f, const std::vector<double>& expected) {
  double worst = 0.0;
  for (std::size_t k = 0; k < expected.size(); ++k)
    worst = std::max(worst, std::abs(f(static_cast<Eigen::Index>(k)) / expected[k] - 1.0));
  return worst;
}

class ImportedMesh : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!ccx_is_installed()) GTEST_SKIP() << "ccx is not installed (Debian's package calculix-ccx)";
    folder_ = std::filesystem::temp_directory_path() / ("thinwall_imported_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override {
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }

  /// Writes the tetrahedra as C3D4 or C3D10 with the set held, and compares eight frequencies.
  void expect_same(const mesh::SolidMesh& solid, const std::string& set, const std::string& name) const {
    const std::vector<int>& held = mesh::node_set(solid, set, name).nodes;
    const auto file = folder_ / "part.inp";
    io::write_inp(file, solid.nodes, {{"HELD", held}},
                  io::InpFrequencyStep{steel.youngs_modulus_Pa, steel.poisson_ratio, steel.density_kg_m3, {"HELD"}, 8});
    const std::vector<double> expected = ccx_frequencies(file);
    ASSERT_EQ(expected.size(), 8U) << name;
    const double worst = largest_difference(frequencies_as_ccx(solid, steel, held, 8), expected);
    std::printf("%s: %td tetrahedra of order %d, %.1f Hz ..., %.1e off ccx\n", name.c_str(),
                solid.nodes.elements.rows(), solid.nodes.order, expected.front(), worst);
    EXPECT_LE(worst, 1e-6) << name << ": ccx prints seven digits";
    // The matrices that the program takes, with exact integrals: the same solid.
    const fem::Model model = fem::build_model(solid.mesh, solid.nodes, steel, fem::rows_of(held, {0, 1, 2}));
    EXPECT_NEAR(model.mass.mass_kg / (steel.density_kg_m3 * mesh::volume_of(solid)), 1.0, 1e-10) << name;
    EXPECT_EQ(model.rigid_motions, 0);
    EXPECT_GE(model.least_jacobian, solid.least_jacobian - 1e-12) << "bounded on the whole element, met at points";
  }

  std::filesystem::path folder_;
};

std::filesystem::path gmsh_file(const std::string& name) {
  return std::filesystem::path(THINWALL_SOURCE_DIR) / "tests" / "io" / "data" / name;
}

TEST_F(ImportedMesh, OfGmshVibratesAsInCalculiX) {
  for (const char* name : {"box_41_binary.msh", "box_22_ascii.msh", "box.inp"})
    expect_same(io::read_solid_mesh(gmsh_file(name), "mm"), "clamped", name);
  for (const char* name : {"hex20.msh", "hex27.msh", "hex20.inp", "wedge15.msh", "wedge15.inp"})
    expect_same(io::read_solid_mesh(gmsh_file(name), "mm"), "bottom", name);
}

Eigen::Vector3d ring(const Eigen::Vector3d& u) {
  const double radius = 0.1 + 0.01 * u.y();
  const double angle = 1.2 * (1.0 - u.x());
  return {radius * std::cos(angle), radius * std::sin(angle), 0.05 * u.z()};
}

Eigen::Vector3d tapered(const Eigen::Vector3d& u) {
  return {0.2 * u.x(), (0.08 - 0.03 * u.x()) * (u.y() - 0.5), 0.05 * u.z()};
}

TEST_F(ImportedMesh, OfHexahedraAndWedgesThatAreSplitVibratesAsInCalculiX) {
  using mesh::CellShape;
  // ∫ 0.2 (0.08 − 0.03 x) 0.05 dx.
  const double volume = 0.2 * 0.05 * (0.08 - 0.015);
  for (const auto& [shape, nodes] : {std::pair{CellShape::hexahedron, std::size_t{8}},
                                     {CellShape::hexahedron, 20},
                                     {CellShape::wedge, 6},
                                     {CellShape::wedge, 15}}) {
    const std::string name = "C3D" + std::to_string(nodes);
    const mesh::SolidMesh flat = mesh::solid_mesh(mesh::LabelledGrid({3, 2, 1}, shape, nodes, tapered).mesh);
    EXPECT_NEAR(mesh::volume_of(flat), volume, 1e-12 * volume) << name;
    expect_same(flat, "LEFT", name + " split, tapered");
    if (nodes <= 8) expect_same(mesh::with_order(flat, 2), "LEFT", name + " split, raised to order 2");
    if (nodes > 8)
      expect_same(mesh::solid_mesh(mesh::LabelledGrid({4, 1, 2}, shape, nodes, ring).mesh), "LEFT",
                  name + " split, curved");
  }
}

/// A file in millimetres, tonnes and seconds with its material, as it is read by both programs.
TEST_F(ImportedMesh, WithItsMaterialInTheFilesOwnUnitsVibratesAsInCalculiX) {
  for (const int order : {1, 2}) {
    mesh::SolidMesh solid = mesh::with_order(
        mesh::solid_mesh(mesh::LabelledGrid({3, 2, 1}, mesh::CellShape::wedge, 6, tapered).mesh), order);
    solid.nodes.positions *= 1000.0;
    const auto file = folder_ / "own.inp";
    io::write_inp(file, solid.nodes, solid.node_sets, io::InpFrequencyStep{210e3, 0.3, 7.85e-9, {"LEFT"}, 8});
    const io::MeshFile read = io::read_mesh_file(file, "mm");
    ASSERT_EQ(read.materials.size(), 1U);
    const io::InpMaterial si = io::in_si(read.materials.front(), 1e-3, 1e3);
    const fem::Material material{si.youngs_modulus.value(), si.poisson_ratio.value(), si.density.value()};
    EXPECT_NEAR(material.youngs_modulus_Pa, 210e9, 1.0);
    EXPECT_NEAR(material.density_kg_m3, 7850.0, 1e-9);
    const auto f = frequencies_as_ccx(read.solid, material, mesh::node_set(read.solid, "LEFT", "").nodes, 8);
    const std::vector<double> expected = ccx_frequencies(file);
    ASSERT_EQ(expected.size(), 8U);
    EXPECT_LE(largest_difference(f, expected), 1e-6) << "order " << order;
  }
}

/// A file of twenty-node bricks with its step, as CalculiX solves it without any splitting.
std::string brick_deck(const mesh::LabelledMesh& bricks) {
  const auto number = [](double x) {
    std::array<char, 32> digits{};
    std::snprintf(digits.data(), digits.size(), ", %.12e", x);
    return std::string(digits.data());
  };
  std::string text = "*NODE, NSET=ALL\n";
  for (const mesh::LabelledNode& node : bricks.nodes)
    text += std::to_string(node.label) + number(node.x.x()) + number(node.x.y()) + number(node.x.z()) + "\n";
  text += "*ELEMENT, TYPE=C3D20, ELSET=BODY\n";
  for (const mesh::LabelledCell& cell : bricks.cells) {
    text += std::to_string(cell.label);
    for (std::size_t a = 0; a < 20; ++a)
      text += (a == 10 ? ",\n" : ", ") + std::to_string(bricks.cell_nodes[cell.first + a]);
    text += "\n";
  }
  text += "*NSET, NSET=LEFT\n";
  for (const std::int64_t label : bricks.node_sets.front().labels) text += std::to_string(label) + ",\n";
  return text +
         "*MATERIAL, NAME=STEEL\n*ELASTIC\n210e9, 0.3\n*DENSITY\n7850.\n*SOLID SECTION, ELSET=BODY, MATERIAL=STEEL\n"
         "*BOUNDARY\nLEFT, 1, 3\n*STEP\n*FREQUENCY\n4\n*END STEP\n";
}

/// The element that CalculiX has itself and its split are two discretisations of one part, which meet under refinement.
TEST_F(ImportedMesh, OfBricksConvergesToTheBricksOwnFrequencies) {
  std::array<double, 2> worst{};
  for (const int fold : {1, 2}) {
    const mesh::LabelledGrid grid({4 * fold, 2 * fold, fold}, mesh::CellShape::hexahedron, 20, tapered);
    const auto file = folder_ / "brick.inp";
    core::write_file_atomically(file, brick_deck(grid.mesh));
    const std::vector<double> expected = ccx_frequencies(file);
    ASSERT_EQ(expected.size(), 4U);
    const mesh::SolidMesh solid = io::read_solid_mesh(file, "m");
    EXPECT_EQ(solid.mesh.tets.size(), 6U * grid.mesh.cells.size());
    const fem::Model model = fem::build_model(solid.mesh, solid.nodes, steel,
                                              fem::rows_of(mesh::node_set(solid, "LEFT", "").nodes, {0, 1, 2}));
    const fem::Factored factored = fem::factorise(model);
    const auto pairs = linalg::lowest_eigenpairs(model.K, model.M, fem::inverse_of(factored), 4);
    const Eigen::VectorXd f = pairs.lambda.cwiseSqrt() / (2.0 * std::numbers::pi);
    worst[static_cast<std::size_t>(fold - 1)] = largest_difference(f, expected);
  }
  std::printf("C3D20 of ccx against its split into tetrahedra: %.1e, refined %.1e\n", worst[0], worst[1]);
  EXPECT_LE(worst[1], 0.02);
  EXPECT_LE(worst[1], 0.6 * worst[0]);
}

}  // namespace
}  // namespace thinwall::imported_mesh_test
