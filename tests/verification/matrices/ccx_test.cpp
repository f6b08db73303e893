// CalculiX as an oracle for imported matrices: the matrices that it writes have the frequencies that it finds. Skipped
// without ccx.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <numbers>
#include <string>

#include "core/atomic_file.hpp"
#include "core/dense_eigenvalues.hpp"
#include "dynamics/sparse_spatial.hpp"
#include "fem/modes.hpp"
#include "io/matrices/mat_sparse.hpp"
#include "io/matrices/matrix_files.hpp"
#include "io/mesh/inp.hpp"
#include "tests/mesh/kuhn_box.hpp"

namespace thinwall::ccx_test {
namespace {

const fem::Material steel{210e9, 0.3, 7850.0};

class CalculixMatrices : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v ccx > /dev/null 2>&1") != 0) GTEST_SKIP() << "ccx is not installed (calculix-ccx)";
    folder_ = std::filesystem::temp_directory_path() / ("thinwall_ccx_matrices_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    write_decks();
    for (const char* deck : {"modes", "stored"}) {
      const std::string command =
          "cd '" + folder_.string() + "' && OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 ccx " + deck + " > ccx.log 2>&1";
      ASSERT_EQ(std::system(command.c_str()), 0) << deck;
    }
  }
  void TearDown() override {
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }

  /// A box of C3D10, clamped at x = 0, in SI: with its modes in full precision (.eig), and with its matrices.
  void write_decks() {
    const auto nodes = mesh::lagrange_nodes(mesh::kuhn_box({0.2, 0.08, 0.05}, {3, 2, 1}), 2);
    mesh::NodeSet clamped{"CLAMPED", {}};
    for (Eigen::Index i = 0; i < nodes.positions.rows(); ++i)
      if (nodes.positions(i, 0) < 1e-9) clamped.nodes.push_back(static_cast<int>(i));
    const io::InpFrequencyStep step{steel.youngs_modulus_Pa, steel.poisson_ratio, steel.density_kg_m3, {"CLAMPED"}, 10};
    io::write_inp(folder_ / "box.inp", nodes, {clamped}, step);
    std::string deck = core::read_file(folder_ / "box.inp");
    const auto at = deck.find("*FREQUENCY");
    const std::string rest = deck.substr(deck.find('\n', at));
    core::write_file_atomically(folder_ / "modes.inp", deck.substr(0, at) + "*FREQUENCY, STORAGE=YES" + rest);
    core::write_file_atomically(folder_ / "stored.inp",
                                deck.substr(0, at) + "*FREQUENCY, SOLVER=MATRIXSTORAGE\n*END STEP\n");
  }

  /// ω² of CalculiX, rad²/s²: of .eig the doubles behind four whole numbers, the last of which counts them.
  [[nodiscard]] Eigen::VectorXd eigenvalues_of_ccx() const {
    const std::string bytes = core::read_file(folder_ / "modes.eig");
    int count = 0;
    std::memcpy(&count, bytes.data() + 12, sizeof count);
    EXPECT_EQ(count, 10);
    Eigen::VectorXd lambda(10);
    std::memcpy(lambda.data(), bytes.data() + 16, 80);
    return lambda;
  }

  [[nodiscard]] io::MatrixFiles stored() const {
    return {folder_ / "stored.sti", folder_ / "stored.mas", {}, {}, folder_ / "box.inp", "m", "kg"};
  }

  std::filesystem::path folder_;
};

/// The ten lowest λ, from the largest μ of M φ = μ K φ: CalculiX's quadrature leaves M singular.
Eigen::VectorXd ten_lowest(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(M, K, Eigen::EigenvaluesOnly | Eigen::Ax_lBx);
  return solver.eigenvalues().reverse().head(10).cwiseInverse();
}

double largest_difference(const Eigen::VectorXd& lambda, const Eigen::VectorXd& expected) {
  return (lambda.cwiseQuotient(expected).cwiseSqrt().array() - 1.0).abs().maxCoeff();
}

TEST_F(CalculixMatrices, HaveTheFrequenciesThatItFinds) {
  const io::ImportedMatrices read = io::read_matrices(stored());
  dynamics::require_plausible(read.model);
  const double worst = largest_difference(ten_lowest(Eigen::MatrixXd(read.model.K), Eigen::MatrixXd(read.model.M)),
                                          eigenvalues_of_ccx());
  std::printf("ccx, stored matrices of %td rows: largest relative difference of a frequency %.1e\n", read.model.size(),
              worst);
  EXPECT_LE(worst, 1e-9);
}

/// Row by row: what CalculiX calls node 17, z is that row of our own stiffness of the same file.
TEST_F(CalculixMatrices, HaveOurStiffnessRowByRowAndItsMass) {
  const dynamics::SparseModel model = io::read_matrices(stored()).model;
  const mesh::SolidMesh inp = io::read_inp(folder_ / "box.inp", 1.0);
  const auto fixed = fem::rows_of(mesh::node_set(inp, "CLAMPED", "").nodes, {0, 1, 2});
  const fem::Model ours = fem::build_model(inp.mesh, 2, steel, fixed);
  ASSERT_EQ(ours.K.rows(), model.size());
  std::vector<int> row_of(model.dofs.size());
  for (std::size_t i = 0; i < ours.free_rows.size(); ++i) {
    const int row = ours.free_rows[i];
    const dynamics::NodeDof dof{static_cast<int>(inp.node_labels[static_cast<std::size_t>(row / 3)]), row % 3 + 1};
    const auto found = std::find(model.dofs.begin(), model.dofs.end(), dof);
    ASSERT_NE(found, model.dofs.end());
    row_of[i] = static_cast<int>(found - model.dofs.begin());
    EXPECT_LT((model.positions.at(dof.node) - ours.nodes.positions.row(row / 3).transpose()).norm(), 1e-14);
  }
  const Eigen::MatrixXd K = Eigen::MatrixXd(model.K)(row_of, row_of);
  const Eigen::MatrixXd own = Eigen::MatrixXd(ours.K);
  EXPECT_LT((K - own).cwiseAbs().maxCoeff(), 1e-12 * own.cwiseAbs().maxCoeff());
  const Eigen::MatrixXd M = Eigen::MatrixXd(model.M)(row_of, row_of);
  const double worst = largest_difference(ten_lowest(K, M), ten_lowest(own, M));
  std::printf("ccx's stiffness against ours: largest relative difference of a frequency %.1e\n", worst);
  EXPECT_LE(worst, 1e-9);
}

TEST_F(CalculixMatrices, GoOutAndComeBackBitByBit) {
  const dynamics::SparseModel model = io::read_matrices(stored()).model;
  io::write_mat(folder_ / "box.mat", model);
  const dynamics::SparseModel back = io::read_matrices({folder_ / "box.mat", {}, {}, {}, {}, "m", "kg"}).model;
  EXPECT_EQ((back.K - model.K).norm(), 0.0);
  EXPECT_EQ((back.M - model.M).norm(), 0.0);
  EXPECT_EQ(back.dofs, model.dofs);
  EXPECT_EQ(back.positions, model.positions);
}

}  // namespace
}  // namespace thinwall::ccx_test
