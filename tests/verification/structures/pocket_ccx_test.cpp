// The L-pocket by CalculiX and by thinwall on one mesh of quadratic tetrahedra. Skipped where ccx is absent.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <numbers>

#include "fem/reference_element.hpp"
#include "io/mesh/inp.hpp"
#include "tests/mesh/plane_shapes.hpp"
#include "tests/verification/structures/ccx_run.hpp"
#include "tests/verification/structures/prism_part.hpp"

namespace thinwall::pocket_ccx_test {
namespace {

/// The mass as CalculiX integrates it over its ten-node tetrahedron, by four points (exact to degree 2, not 4), on the
/// free rows: M_e = ρ V / 4 Σ_q N(λ_q) N(λ_q)ᵀ.
linalg::SparseMatrix mass_by_four_points(const fem::Model& model, double density) {
  Eigen::Matrix<double, 10, 10> M_hat = Eigen::Matrix<double, 10, 10>::Zero();
  for (Eigen::Index q = 0; q < 4; ++q) {
    Eigen::Vector4d lambda = Eigen::Vector4d::Constant((5.0 - std::sqrt(5.0)) / 20.0);
    lambda(q) = (5.0 + 3.0 * std::sqrt(5.0)) / 20.0;
    const Eigen::VectorXd N = fem::shape_functions(2, lambda);
    M_hat += N * N.transpose() / 4.0;
  }
  std::vector<int> row_of(static_cast<std::size_t>(3 * model.nodes.positions.rows()), -1);
  for (std::size_t i = 0; i < model.free_rows.size(); ++i)
    row_of[static_cast<std::size_t>(model.free_rows[i])] = static_cast<int>(i);
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index e = 0; e < model.nodes.elements.rows(); ++e) {
    const double mass = density * mesh::volume(model.mesh, static_cast<int>(e));
    for (Eigen::Index a = 0; a < 10; ++a) {
      for (Eigen::Index b = 0; b < 10; ++b) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const int i = row_of[3 * static_cast<std::size_t>(model.nodes.elements(e, a)) + axis];
          const int j = row_of[3 * static_cast<std::size_t>(model.nodes.elements(e, b)) + axis];
          if (i >= 0 && j >= 0) entries.emplace_back(i, j, mass * M_hat(a, b));
        }
      }
    }
  }
  linalg::SparseMatrix M(model.M.rows(), model.M.cols());
  M.setFromTriplets(entries.begin(), entries.end());
  return M;
}

class PocketByCalculiX : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!ccx_is_installed()) GTEST_SKIP() << "ccx is not installed (Debian's package calculix-ccx)";
    folder_ = std::filesystem::temp_directory_path() / ("thinwall_pocket_ccx_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override {
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }
  std::filesystem::path folder_;
};

TEST_F(PocketByCalculiX, TenFrequenciesAreTheSameAndTheHighOrdersLieBelow) {
  const mesh::Prism pocket = mesh::pocket_corner();
  const fem::Support clamped = held_plane(2, 0.0);  // the floor's lower face
  const Solved ours = solved(graded_mesh(pocket, 0.008, 0), 2, steel_part, {clamped}, 10);
  const auto held =
      mesh::nodes_on(ours.model.nodes, ours.model.mesh,
                     mesh::select(ours.model.mesh, mesh::boundary(ours.model.mesh), clamped.region, clamped.name));
  const auto input = folder_ / "pocket.inp";
  io::write_inp(input, ours.model.nodes, {{"HELD", held}},
                io::InpFrequencyStep{
                    steel_part.youngs_modulus_Pa, steel_part.poisson_ratio, steel_part.density_kg_m3, {"HELD"}, 10});
  const std::vector<double> ccx = ccx_frequencies(input);
  ASSERT_EQ(ccx.size(), 10U);

  const fem::Factored factored = fem::factorise(ours.model);
  const auto as_ccx = linalg::lowest_eigenpairs(ours.model.K, mass_by_four_points(ours.model, steel_part.density_kg_m3),
                                                fem::inverse_of(factored), 10);
  ASSERT_EQ(as_ccx.status, linalg::EigenStatus::converged);
  const Eigen::VectorXd f = as_ccx.lambda.cwiseSqrt() / (2.0 * std::numbers::pi);
  const double same = worst_error(f, as_vector(ccx));
  const double exact_mass = worst_error(elastic(ours.modes), as_vector(ccx));
  std::printf("L-pocket: %td DOFs, ten frequencies from %.1f Hz; ccx's quadrature: %.1e off ccx, exact mass: %.1e\n",
              ours.model.K.rows(), ccx.front(), same, exact_mass);
  EXPECT_LE(same, 1e-6) << "ccx prints seven digits";
  EXPECT_LE(exact_mass, 0.01) << "what vanishes with the elements";

  // Few graded elements of order 5 lie below, as Ritz says, and the finer tet10 comes nearer.
  const Solved high = solved(graded_mesh(pocket, 0.03, 1), 5, steel_part, {clamped}, 10);
  const Solved fine = solved(graded_mesh(pocket, 0.004, 0), 2, steel_part, {clamped}, 10);
  const auto above = [&](const Solved& s) {
    const Eigen::VectorXd off = elastic(s.modes).cwiseQuotient(elastic(high.modes)).array() - 1.0;
    std::printf("L-pocket: %td DOFs of tet10 lie %.2f to %.2f %% above %td DOFs of order 5\n", s.model.K.rows(),
                100 * off.minCoeff(), 100 * off.maxCoeff(), high.model.K.rows());
    EXPECT_GT(off.minCoeff(), 0.0);
    return off.maxCoeff();
  };
  EXPECT_LT(above(fine), 0.4 * above(ours)) << "they fall towards it";
}

}  // namespace
}  // namespace thinwall::pocket_ccx_test
