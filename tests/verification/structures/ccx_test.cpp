// CalculiX as an oracle: the same mesh file, the same ten frequencies. Skipped where ccx is absent.

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "core/dense_eigenvalues.hpp"
#include "fem/modes.hpp"
#include "fem/reference_element.hpp"
#include "io/mesh/inp.hpp"
#include "tests/mesh/kuhn_box.hpp"
#include "tests/verification/structures/ccx_run.hpp"

namespace thinwall::ccx_test {
namespace {

class CalculiX : public ::testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    if (!ccx_is_installed()) {
      GTEST_SKIP() << "ccx is not installed (Debian's package calculix-ccx)";
    }
    folder_ = std::filesystem::temp_directory_path() /
              ("thinwall_ccx_" + std::to_string(GetParam()) + "_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override {
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }

  /// Runs ccx on NAME.inp in the folder.
  [[nodiscard]] std::vector<double> run(const std::string& name) const {
    return ccx_frequencies(folder_ / (name + ".inp"));
  }

  std::filesystem::path folder_;
};

/// M by CalculiX's own quadrature, one point for C3D4 and four (exact to degree 2) for C3D10, on the free rows:
/// M_e = ρ V / Q Σ_q N(λ_q) N(λ_q)ᵀ. The exact integrals, which thinwall takes, have twice the elements' degree.
Eigen::MatrixXd mass_as_ccx_integrates(const fem::Model& model, double density) {
  std::vector<int> row_of(static_cast<std::size_t>(3 * model.nodes.positions.rows()), -1);
  for (std::size_t i = 0; i < model.free_rows.size(); ++i) {
    row_of[static_cast<std::size_t>(model.free_rows[i])] = static_cast<int>(i);
  }
  const int order = model.nodes.order;
  const int points = order == 1 ? 1 : 4;
  Eigen::MatrixXd M_hat = Eigen::MatrixXd::Zero(model.nodes.elements.cols(), model.nodes.elements.cols());
  for (int q = 0; q < points; ++q) {
    Eigen::Vector4d lambda = Eigen::Vector4d::Constant(order == 1 ? 0.25 : (5.0 - std::sqrt(5.0)) / 20.0);
    if (order == 2) lambda(q) = (5.0 + 3.0 * std::sqrt(5.0)) / 20.0;
    const Eigen::VectorXd N = fem::shape_functions(order, lambda);
    M_hat += N * N.transpose() / points;
  }
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(model.M.rows(), model.M.cols());
  for (Eigen::Index e = 0; e < model.nodes.elements.rows(); ++e) {
    const double mass = density * mesh::volume(model.mesh, static_cast<int>(e));
    for (Eigen::Index a = 0; a < M_hat.rows(); ++a) {
      for (Eigen::Index b = 0; b < M_hat.cols(); ++b) {
        const int i = row_of[static_cast<std::size_t>(3 * model.nodes.elements(e, a))];
        const int j = row_of[static_cast<std::size_t>(3 * model.nodes.elements(e, b))];
        if (i < 0 || j < 0) continue;  // a clamped node: all three of its rows are fixed
        for (int axis = 0; axis < 3; ++axis) M(i + axis, j + axis) += mass * M_hat(a, b);
      }
    }
  }
  return M;
}

/// Ten lowest, from the largest μ of M φ = μ K φ, which lets M be singular, as under-integrated mass is.
Eigen::VectorXd ten_frequencies(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(M, K, Eigen::EigenvaluesOnly | Eigen::Ax_lBx);
  const Eigen::VectorXd mu = solver.eigenvalues().reverse().head(10);
  return mu.cwiseSqrt().cwiseInverse() / (2.0 * std::numbers::pi);
}

const Eigen::Vector3d box_size(0.2, 0.08, 0.05);
const fem::Material steel{210e9, 0.3, 7850.0};

/// Writes the box, clamped at x = 0, and reads it back as a model.
fem::Model box_by_way_of_a_file(const std::filesystem::path& file, const std::array<int, 3>& cells, int order) {
  const auto nodes = mesh::lagrange_nodes(mesh::kuhn_box(box_size, cells), order);
  mesh::NodeSet clamped{"CLAMPED", {}};
  for (Eigen::Index i = 0; i < nodes.positions.rows(); ++i) {
    if (nodes.positions(i, 0) < 1e-9) clamped.nodes.push_back(static_cast<int>(i));
  }
  const io::InpFrequencyStep step{steel.youngs_modulus_Pa, steel.poisson_ratio, steel.density_kg_m3, {"CLAMPED"}, 10};
  io::write_inp(file, nodes, {clamped}, step);
  const mesh::SolidMesh read = io::read_inp(file, 1.0);
  const auto fixed = fem::rows_of(mesh::node_set(read, "CLAMPED", file.string()).nodes, {0, 1, 2});
  fem::Model model = fem::build_model(read.mesh, order, steel, fixed);
  EXPECT_TRUE(model.nodes.elements == read.nodes.elements) << "the fixed rows count the file's nodes";
  return model;
}

double largest_difference(const Eigen::VectorXd& f, const std::vector<double>& expected) {
  double worst = 0.0;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    worst = std::max(worst, std::abs(f(static_cast<Eigen::Index>(k)) / expected[k] - 1.0));
  }
  return worst;
}

/// Stiffness, supports, material and the order of the nodes are CalculiX's; it prints seven digits, 5e-7 at worst.
TEST_P(CalculiX, FindsTheSameTenFrequenciesWhereTheMassIsIntegratedAsItDoes) {
  const fem::Model model = box_by_way_of_a_file(folder_ / "box.inp", {4, 2, 2}, GetParam());
  const std::vector<double> expected = run("box");
  ASSERT_EQ(expected.size(), 10U);
  const auto f = ten_frequencies(Eigen::MatrixXd(model.K), mass_as_ccx_integrates(model, steel.density_kg_m3));
  const double worst = largest_difference(f, expected);
  EXPECT_LE(worst, 1e-6);
  std::printf("ccx, order %d: %td DOFs, largest relative difference %.1e\n", GetParam(), model.K.rows(), worst);
}

/// Exact integrals of the mass differ from CalculiX's by what vanishes with the elements: h⁴ of order 2, h² of order 1,
/// as the eigenvalues themselves converge. Measured: 1.97 and 3.80.
TEST_P(CalculiX, ConvergesToTheSameFrequenciesWithTheMassIntegratedExactly) {
  std::array<double, 2> worst{};
  for (std::size_t level = 0; level < 2; ++level) {
    const int fold = level == 0 ? 1 : 2;
    const fem::Model model = box_by_way_of_a_file(folder_ / "box.inp", {6 * fold, 3 * fold, 2 * fold}, GetParam());
    std::vector<double> expected = run("box");
    ASSERT_EQ(expected.size(), 10U);
    expected.resize(4);
    const fem::Factored factored = fem::factorise(model);
    const fem::Modes modes = fem::modes(model, factored, {});
    worst[level] = largest_difference(modes.frequency_hz, expected);
  }
  const double rate = std::log2(worst[0] / worst[1]);
  std::printf("ccx, order %d: differences %.1e and %.1e, rate %.2f\n", GetParam(), worst[0], worst[1], rate);
  EXPECT_GE(rate, 0.9 * 2.0 * GetParam());
}

INSTANTIATE_TEST_SUITE_P(Orders, CalculiX, ::testing::Values(1, 2));

}  // namespace
}  // namespace thinwall::ccx_test
