// The report on imported matrices: a body whose mass and inertia are known, and each fault that it is there to find.

#include "reduction/trust/sparse_report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "core/error.hpp"
#include "dynamics/sparse_spatial.hpp"
#include "tube.hpp"

namespace thinwall::reduction::sparse_report_test {
namespace {

using dynamics::NodeDof;
using dynamics::SparseModel;
using testing::length;
using testing::tube;

const Finding& finding(const ReducedModelReport& report, const std::string& name) {
  for (const Finding& found : report.findings)
    if (found.name == name) return found;
  throw std::runtime_error("no finding " + name);
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(SparseReport, KnowsTheMassAndInertiaOfAFreeTube) {
  ReportOptions options;
  options.rigid_motions = 6;
  const ReducedModelReport report = sparse_report(tube(12), options);
  EXPECT_TRUE(report.trustworthy()) << text(report);
  const double area = M_PI / 4.0 * (0.04 * 0.04 - 0.03 * 0.03),
               I = M_PI / 64.0 * (std::pow(0.04, 4) - std::pow(0.03, 4));
  const double mass = 7850.0 * area * length;
  ASSERT_TRUE(report.rigid.has_value());
  const RigidBodyState& rigid = *report.rigid;
  EXPECT_EQ(rigid.free_motions, 6);
  EXPECT_EQ(rigid.sets.without_energy, 6);
  EXPECT_NEAR(rigid.body.mass_kg, mass, 1e-10 * mass);
  EXPECT_LT((rigid.body.centre_m - Eigen::Vector3d(length / 2, 0.1, 0.0)).norm(), 1e-10);
  EXPECT_NEAR(rigid.body.inertia_kg_m2(0, 0), 2.0 * 7850.0 * I * length, 1e-9);
  EXPECT_NEAR(rigid.body.inertia_kg_m2(2, 2), mass * length * length / 12.0 + 7850.0 * I * length, 1e-9);
  EXPECT_EQ(report.matrices.back().zero, 6);
}

// The dense report is another algorithm throughout.
TEST(SparseReport, AgreesWithTheDenseOne) {
  for (const bool held : {false, true}) {
    const SparseModel model = held ? tube(10, {{1, 1}, {1, 2}, {1, 3}, {1, 4}, {1, 5}, {1, 6}}) : tube(10);
    const ReducedModelReport sparse = sparse_report(model);
    ReportOptions options;
    for (const auto& [node, x] : model.positions)
      if (node > 1 || !held) options.positions["node " + std::to_string(node)] = x;
    const ReducedModelReport dense = report(dynamics::spatial_model(model), options);
    ASSERT_EQ(sparse.frequencies_hz.size(), 20U);
    for (std::size_t k = 0; k < 20; ++k)
      EXPECT_NEAR(sparse.frequencies_hz[k] / dense.frequencies_hz[k], 1.0, 1e-6) << k;
    EXPECT_EQ(sparse.rigid->free_motions, dense.rigid->free_motions);
    EXPECT_NEAR(sparse.rigid->body.mass_kg, dense.rigid->body.mass_kg, 1e-9);
    for (const auto& of_sparse : sparse.matrices)
      for (const auto& of_dense : dense.matrices)
        if (of_sparse.name == of_dense.name) {
          EXPECT_EQ(of_sparse.negative, of_dense.negative) << of_sparse.name;
          EXPECT_EQ(of_sparse.zero, of_dense.zero) << of_sparse.name;
        }
  }
}

TEST(SparseReport, SaysWhichMotionIsFree) {
  ReportOptions options;
  options.rigid_motions = 0;
  const ReducedModelReport report = sparse_report(tube(8, {{1, 1}, {1, 2}, {1, 3}, {1, 4}, {1, 5}}), options);
  EXPECT_FALSE(report.trustworthy());
  EXPECT_EQ(report.rigid->free_motions, 1);
  ASSERT_EQ(report.rigid->in_words.size(), 1U);
  EXPECT_EQ(report.rigid->in_words.front(), "rotation about z through (0, 0.1, 0)");
  EXPECT_TRUE(has(finding(report, "free rigid motions").advice, "rotation about z"));
}

TEST(SparseReport, NamesAPieceThatHangsOnNothing) {
  SparseModel model = tube(8);
  const SparseModel other = tube(3);
  const Eigen::Index n = model.size(), m = other.size();
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n + m, n + m), M = K;
  K.topLeftCorner(n, n) = model.K;
  K.bottomRightCorner(m, m) = other.K;
  M.topLeftCorner(n, n) = model.M;
  M.bottomRightCorner(m, m) = other.M;
  for (const NodeDof& dof : other.dofs) model.dofs.push_back({dof.node + 50, dof.component});
  for (const auto& [node, x] : other.positions) model.positions[node + 50] = x + Eigen::Vector3d(0.0, 0.0, 1.0);
  model.K = K.sparseView();
  model.M = M.sparseView();
  const ReducedModelReport report = sparse_report(model);
  const Finding& pieces = finding(report, "pieces that share no entry");
  EXPECT_EQ(pieces.value, 2.0);
  EXPECT_FALSE(pieces.ok);
  EXPECT_TRUE(has(pieces.advice, "node 51.x")) << pieces.advice;
  EXPECT_EQ(report.rigid->free_motions, 12);
}

TEST(SparseReport, NamesTheDofOfWhatIsIndefiniteOrAsymmetric) {
  SparseModel model = tube(8);
  const int row = 6 * 4 + 2;  // node 5, z
  model.M.coeffRef(row, row) = -1.0;
  const ReducedModelReport negative = sparse_report(model);
  const Finding& mass = finding(negative, "least eigenvalue of M");
  EXPECT_FALSE(mass.ok);
  EXPECT_LT(mass.value, -0.9);
  EXPECT_TRUE(has(mass.advice, "node 5.z")) << mass.advice;
  model = tube(8);
  model.K.coeffRef(row, row + 6) *= 1.1;
  const Finding symmetry = finding(sparse_report(model), "symmetry of K");
  EXPECT_FALSE(symmetry.ok);
  EXPECT_TRUE(has(symmetry.advice, "node 5.z, node 6.z")) << symmetry.advice;
}

// Rotations without mass, as lumped masses leave them, are no fault of a held part.
TEST(SparseReport, TakesMassesAtTranslationsAlone) {
  SparseModel model = tube(8, {{1, 1}, {1, 2}, {1, 3}, {1, 4}, {1, 5}, {1, 6}});
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(model.size(), model.size());
  for (Eigen::Index row = 0; row < model.size(); ++row)
    if (model.dofs[static_cast<std::size_t>(row)].component <= 3) M(row, row) = 0.1;
  model.M = M.sparseView();
  const ReducedModelReport report = sparse_report(model);
  EXPECT_TRUE(report.trustworthy()) << text(report);
  // A chain of equal masses along x, k = EA/l: ω = 2 √(k/m) sin((2j − 1) π / (4 n + 2)).
  const double area = M_PI / 4.0 * (0.04 * 0.04 - 0.03 * 0.03);
  const double along = std::sqrt(210e9 * area / (length / 8) / 0.1) * 2.0 * std::sin(M_PI / 34.0) / (2.0 * M_PI);
  double nearest = 1.0;
  for (const double hz : report.frequencies_hz) nearest = std::min(nearest, std::abs(hz / along - 1.0));
  EXPECT_LT(nearest, 1e-7);
}

}  // namespace
}  // namespace thinwall::reduction::sparse_report_test
