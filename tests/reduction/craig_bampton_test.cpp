#include "reduction/methods/craig_bampton.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <numbers>
#include <tuple>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "dynamics/conversion.hpp"
#include "tests/reduction/solid_part.hpp"

namespace thinwall::reduction::craig_bampton_test {
namespace {

const Eigen::Vector3d size(0.3, 0.2, 0.1);

Eigen::VectorXd omega(const dynamics::SpatialModel& model) {
  return dynamics::undamped_modes(model).omega_rad_s;
}

double worst_ratio(const Eigen::VectorXd& found, const Eigen::VectorXd& expected) {
  return (found - expected).cwiseQuotient(expected).cwiseAbs().maxCoeff();
}

/// The nodes on the plane x = x_plane, by rising (y, z), as single-node interface points.
std::vector<fem::NamedPoint> points_on_plane(const fem::Model& model, double x_plane) {
  std::vector<Eigen::Vector3d> positions;
  for (Eigen::Index i = 0; i < model.nodes.positions.rows(); ++i) {
    if (std::abs(model.nodes.positions(i, 0) - x_plane) < 1e-9) positions.emplace_back(model.nodes.positions.row(i));
  }
  std::sort(positions.begin(), positions.end(), [](const auto& a, const auto& b) {
    return std::tuple(std::round(a.y() * 1e6), a.z()) < std::tuple(std::round(b.y() * 1e6), b.z());
  });
  std::vector<fem::NamedPoint> points;
  for (const auto& x : positions) points.push_back({"I" + std::to_string(points.size()), x, 0.0, xyz});
  return points;
}

CraigBampton reduce(const fem::Model& model, const Interface& interface, const CraigBamptonOptions& options) {
  const bool is_free = model.rigid_motions > 0;
  const StaticInverse inverse(is_free ? restrained(model.K, interface) : model.K, model.node_of_row);
  return craig_bampton(model.K, model.M, inverse.action(), interface, options);
}

int inner_count(const fem::Model& model, const Interface& interface) {
  return static_cast<int>(model.K.rows() - interface.W.cols());
}

TEST(CraigBampton, WithAllModesKeptIsTheFullModel) {
  for (const double radius : {0.0, 0.03}) {
    const fem::Model model = block(size, {2, 2, 1}, 2, true);
    const Interface interface = interface_at(model, {{"P", {0.3, 0.1, 0.05}, radius, xyz}});
    const CraigBampton all = reduce(model, interface, {.modes = inner_count(model, interface), .up_to_hz = {}});
    const double error = worst_ratio(omega(all.model), omega(dense(model.K, model.M)));
    std::printf("Craig-Bampton, all %td modes of a %s interface kept: %.1e from the full model\n", all.model.size(),
                radius > 0 ? "patch" : "point", error);
    EXPECT_LT(error, 1e-9);
  }
}

TEST(CraigBampton, APartCutInTwoAndJoinedAgainIsTheWholePart) {
  for (const int order : {1, 2}) {
    const int per_cell = order == 1 ? 2 : 1;
    const fem::Model whole = block({0.6, 0.2, 0.1}, {2 * per_cell, per_cell, per_cell}, order, true);
    const fem::Model root = block(size, {per_cell, per_cell, per_cell}, order, true);
    const fem::Model tip = block(size, {per_cell, per_cell, per_cell}, order, false, {0.3, 0, 0});
    const Interface root_end = interface_at(root, points_on_plane(root, 0.3));
    const Interface tip_end = interface_at(tip, points_on_plane(tip, 0.3));
    ASSERT_EQ(root_end.dofs.size(), tip_end.dofs.size());
    const CraigBampton a = reduce(root, root_end, {.modes = inner_count(root, root_end), .up_to_hz = {}});
    const CraigBampton b = reduce(tip, tip_end, {.modes = inner_count(tip, tip_end), .up_to_hz = {}});
    const Eigen::Index nb = root_end.W.cols();
    const Eigen::Index n = a.model.size() + b.model.size() - nb;
    ASSERT_EQ(n, whole.K.rows());
    dynamics::SpatialModel joined{Eigen::MatrixXd::Zero(n, n),
                                  Eigen::MatrixXd::Zero(n, n),
                                  Eigen::MatrixXd::Zero(n, n),
                                  {},
                                  dynamics::DofTable(static_cast<std::size_t>(n))};
    std::vector<int> rows_of_b;
    for (Eigen::Index i = 0; i < b.model.size(); ++i) {
      rows_of_b.push_back(static_cast<int>(i < nb ? i : a.model.size() + i - nb));
    }
    joined.K.topLeftCorner(a.model.size(), a.model.size()) += a.model.K;
    joined.M.topLeftCorner(a.model.size(), a.model.size()) += a.model.M;
    joined.K(rows_of_b, rows_of_b) += b.model.K;
    joined.M(rows_of_b, rows_of_b) += b.model.M;
    const double error = worst_ratio(omega(joined), omega(dense(whole.K, whole.M)));
    std::printf("cut in two and rejoined, order %d: %td frequencies within %.1e\n", order, n, error);
    EXPECT_LT(error, 1e-9);
  }
}

TEST(CraigBampton, FrequenciesFallMonotonicallyTowardsTheFullOnes) {
  const fem::Model model = block(size, {2, 2, 1}, 2, true);
  const Interface interface =
      interface_at(model, {{"P", {0.3, 0.1, 0.05}, 0.03, xyz}, {"Q", {0.1, 0.2, 0.05}, 0.02, xyz}});
  const Eigen::VectorXd full = omega(dense(model.K, model.M)).head(6);
  Eigen::VectorXd before = Eigen::VectorXd::Constant(6, 1e12);
  for (const int modes : {0, 1, 2, 3, 5, 8, 12, 20, 40, 80}) {
    const Eigen::VectorXd found = omega(reduce(model, interface, {.modes = modes, .up_to_hz = {}}).model).head(6);
    EXPECT_TRUE((found.array() <= before.array() * (1 + 1e-12)).all()) << modes << " modes";
    EXPECT_TRUE((found.array() >= full.array() * (1 - 1e-12)).all()) << modes << " modes";
    before = found;
  }
  EXPECT_LT(worst_ratio(before, full), 1e-4);
}

/// The defining equations of both kinds of mode.
void expect_defining_equations(const fem::Model& model, const Interface& interface, const CraigBampton& reduced) {
  const Eigen::Index nb = interface.W.cols();
  const Eigen::MatrixXd Psi = reduced.T.leftCols(nb);
  const Eigen::MatrixXd Phi = reduced.T.rightCols(reduced.T.cols() - nb);
  const Eigen::MatrixXd visible = interface.W.transpose() * Psi;
  EXPECT_LT((visible - Eigen::MatrixXd::Identity(nb, nb)).cwiseAbs().maxCoeff(), 1e-10) << "WᵀΨ = I";
  EXPECT_LT((interface.W.transpose() * Phi).cwiseAbs().maxCoeff(), 1e-10 * Phi.cwiseAbs().maxCoeff()) << "WᵀΦ = 0";
  const double scale = std::sqrt(reduced.model.K.topLeftCorner(nb, nb).diagonal().maxCoeff() *
                                 reduced.model.K.diagonal().tail(Phi.cols()).maxCoeff());
  EXPECT_LT((Psi.transpose() * (model.K * Phi)).cwiseAbs().maxCoeff(), 1e-9 * scale) << "ΨᵀKΦ = 0";
  const Eigen::MatrixXd gram = Phi.transpose() * (model.M * Phi);
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(Phi.cols(), Phi.cols())).cwiseAbs().maxCoeff(), 1e-10) << "ΦᵀMΦ = I";
  const Eigen::VectorXd lambda = (Phi.transpose() * (model.K * Phi)).diagonal();
  EXPECT_LT(worst_ratio(reduced.model.K.diagonal().tail(Phi.cols()), lambda), 1e-9);
  ASSERT_EQ(reduced.model.dofs.size(), static_cast<std::size_t>(reduced.T.cols()));
  EXPECT_EQ(dynamics::name(reduced.model.dofs[static_cast<std::size_t>(nb)]), "mode 1");
}

TEST(CraigBampton, ModesOfAPatchInterfaceSatisfyTheirEquations) {
  const fem::Model model = block(size, {2, 2, 1}, 2, true);
  const Interface interface = interface_at(model, {{"P", {0.3, 0.11, 0.05}, 0.03, xyz}});
  expect_defining_equations(model, interface, reduce(model, interface, {.modes = 12, .up_to_hz = {}}));
}

TEST(CraigBampton, LanczosOnTheEmbeddedInverseFindsWhatDenseAlgebraFinds) {
  const fem::Model model = block(size, {6, 3, 1}, 2, true);
  ASSERT_GT(model.K.rows(), 600) << "or the small path is taken";
  const Interface interface = interface_at(model, {{"P", {0.3, 0.11, 0.05}, 0.03, xyz}});
  const CraigBampton sparse = reduce(model, interface, {.modes = 12, .up_to_hz = {}});
  ASSERT_EQ(sparse.status, linalg::EigenStatus::converged);
  expect_defining_equations(model, interface, sparse);
  const auto expected = linalg::dense_eigenpairs(model.K, model.M, interface.W);
  const Eigen::VectorXd found = (2.0 * std::numbers::pi * sparse.fixed_interface_hz).cwiseAbs2();
  EXPECT_LT(worst_ratio(found, expected.lambda.head(12)), 1e-10);
  const double bound = 0.5 * (sparse.fixed_interface_hz(6) + sparse.fixed_interface_hz(7));
  EXPECT_EQ(reduce(model, interface, {.modes = 1, .up_to_hz = bound}).fixed_interface_hz.size(), 7);
}

TEST(CraigBampton, OfAFreePartIsTheTextbookPartition) {
  const fem::Model model = block(size, {2, 1, 1}, 2, false);
  ASSERT_EQ(model.rigid_motions, 6);
  // Three corner nodes restrain all rigid motions.
  const Interface interface =
      interface_at(model, {{"A", {0, 0, 0}, 0.0, xyz}, {"B", {0.3, 0, 0}, 0.0, xyz}, {"C", {0, 0.2, 0.1}, 0.0, xyz}});
  const CraigBampton reduced = reduce(model, interface, {.modes = 10, .up_to_hz = {}});

  std::vector<int> b;
  for (Eigen::Index j = 0; j < interface.W.cols(); ++j) {
    const linalg::SparseMatrix::InnerIterator it(interface.W, j);
    ASSERT_NEAR(it.value(), 1.0, 1e-15);
    b.push_back(static_cast<int>(it.row()));
  }
  std::vector<int> i;
  for (int row = 0; row < model.K.rows(); ++row) {
    if (std::find(b.begin(), b.end(), row) == b.end()) i.push_back(row);
  }
  const Eigen::MatrixXd K = model.K;
  const Eigen::MatrixXd M = model.M;
  const Eigen::MatrixXd Kii = K(i, i);
  const Eigen::MatrixXd Psi = -Kii.partialPivLu().solve(Eigen::MatrixXd(K(i, b)));
  const auto inner = linalg::dense_eigenpairs(linalg::restrict_to(model.K, i), linalg::restrict_to(model.M, i), {});
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(K.rows(), 19);
  T(b, Eigen::seqN(0, 9)) = Eigen::MatrixXd::Identity(9, 9);
  T(i, Eigen::seqN(0, 9)) = Psi;
  T(i, Eigen::seqN(9, 10)) = inner.Phi.leftCols(10);
  const Eigen::MatrixXd Mr = T.transpose() * M * T;
  const Eigen::MatrixXd Kr = T.transpose() * K * T;
  EXPECT_LT((reduced.model.M - Mr).cwiseAbs().maxCoeff(), 1e-9 * Mr.cwiseAbs().maxCoeff());
  EXPECT_LT((reduced.model.K.topLeftCorner(9, 9) - Kr.topLeftCorner(9, 9)).cwiseAbs().maxCoeff(),
            1e-9 * Kr.topLeftCorner(9, 9).cwiseAbs().maxCoeff());
  EXPECT_LT(worst_ratio(reduced.model.K.diagonal().tail(10), Kr.diagonal().tail(10)), 1e-9);
  const Eigen::VectorXd frequencies = omega(reduced.model);
  EXPECT_LT(frequencies(5), 1e-4 * frequencies(6)) << "six rigid motions stay";
}

TEST(CraigBampton, RefusesAnInterfaceThatDependsOnItselfAndMoreModesThanThereAre) {
  const fem::Model model = block(size, {1, 1, 1}, 1, true);
  const fem::NamedPoint corner{"P", {0.3, 0.2, 0.1}, 0.0, xyz};
  fem::NamedPoint again = corner;
  again.name = "Q";
  try {
    (void)reduce(model, interface_at(model, {corner, again}), {.modes = 1, .up_to_hz = {}});
    FAIL() << "two points coincide";
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("P.x, P.y, P.z, Q.x"), std::string::npos) << error.what();
  }
  EXPECT_THROW((void)reduce(model, interface_at(model, {corner}), {.modes = 10, .up_to_hz = {}}), core::InputError);
  EXPECT_EQ(reduce(model, interface_at(model, {corner}), {.modes = 9, .up_to_hz = {}}).model.size(), 12);
  const StaticInverse inverse(model.K, model.node_of_row);
  linalg::ShiftedInverse shifted = inverse.action();
  shifted.sigma = -1.0;
  EXPECT_THROW((void)craig_bampton(model.K, model.M, shifted, interface_at(model, {corner}), {}), core::NumericalError);
}

}  // namespace
}  // namespace thinwall::reduction::craig_bampton_test
