#include "reduction/trust/sparse_report.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace thinwall::reduction::sparse_report_test {
namespace {

using dynamics::SparseModel;
using Eigen::MatrixXd;

/// Masses of 1 kg on springs of 1e6 N/m along x, the first held to ground, 10 mm apart; `empty` rows behind them.
SparseModel chain(int n, int empty) {
  MatrixXd K = MatrixXd::Zero(n + empty, n + empty), M = K;
  SparseModel model;
  for (int i = 0; i < n; ++i) {
    M(i, i) = 1.0;
    K(i, i) += 1e6;
    if (i == 0) continue;
    K(i - 1, i - 1) += 1e6;
    K(i, i - 1) = K(i - 1, i) = -1e6;
  }
  for (int i = 0; i < n + empty; ++i) {
    model.dofs.push_back({i + 1, 1});
    model.positions[i + 1] = Eigen::Vector3d(0.01 * i, 0.0, 0.0);
  }
  model.K = K.sparseView();
  model.M = M.sparseView();
  return model;
}

const Finding* finding(const ReducedModelReport& report, const std::string& name) {
  for (const Finding& each : report.findings)
    if (each.name == name) return &each;
  return nullptr;
}

TEST(SparseReport, NamesRowsWithoutMassAndStiffnessAndWhatWasNotFound) {
  const ReducedModelReport good = sparse_report(chain(8, 0)), bad = sparse_report(chain(8, 2));
  ASSERT_TRUE(finding(good, "DOFs without mass and stiffness") && finding(good, "frequencies found"));
  EXPECT_TRUE(finding(good, "DOFs without mass and stiffness")->ok && finding(good, "frequencies found")->ok);
  EXPECT_TRUE(good.trustworthy()) << text(good);
  const Finding* bare = finding(bad, "DOFs without mass and stiffness");
  ASSERT_TRUE(bare);
  EXPECT_EQ(bare->value, 2.0);
  EXPECT_FALSE(bare->ok);
  EXPECT_NE(bare->advice.find("node 9.x, node 10.x"), std::string::npos) << bare->advice;
  EXPECT_FALSE(finding(bad, "frequencies found")->ok) << text(bad);
  EXPECT_FALSE(bad.trustworthy());
}

TEST(SparseReport, OfAnIndefiniteStiffnessDoesNotPassForWantOfFrequencies) {
  SparseModel model = chain(8, 0);
  model.K.coeffRef(3, 3) = -1e6;
  const ReducedModelReport report = sparse_report(model);
  EXPECT_TRUE(report.frequencies_hz.empty());
  EXPECT_FALSE(finding(report, "frequencies found")->ok);
  EXPECT_NE(finding(report, "frequencies found")->advice.find("positive definite"), std::string::npos);
}

/// Lumped masses leave rows without any: fewer modes than rows are no search that failed.
TEST(SparseReport, FindsAsManyModesAsThereAreMasses) {
  for (const int step : {2, 3}) {
    SparseModel model = chain(24, 0);
    for (int i = 0; i < 24; ++i)
      if ((i + 1) % step != 0) model.M.coeffRef(i, i) = 0.0;
    model.M.prune(0.0);
    const ReducedModelReport report = sparse_report(model);
    EXPECT_TRUE(report.trustworthy()) << text(report);
    // Springs in series between n masses: ω = 2 √(k/m) sin((2j − 1) π / (4 n + 2)).
    const int n = 24 / step;
    ASSERT_EQ(std::ssize(report.frequencies_hz), n);
    for (int j = 1; j <= n; ++j) {
      const double omega = 2.0 * std::sqrt(1e6 / step) * std::sin((2 * j - 1) * M_PI / (4 * n + 2));
      EXPECT_NEAR(report.frequencies_hz[static_cast<std::size_t>(j - 1)] * 2.0 * M_PI / omega, 1.0, 1e-9) << j;
    }
  }
}

TEST(SparseReport, MeasuresLengthsByThePointsOfTheTable) {
  SparseModel model = chain(8, 0);
  model.positions[99] = Eigen::Vector3d(5.0, 0.0, 0.0);  // a node without a row
  EXPECT_NEAR(sparse_report(model).rigid->sets.length_m, 0.035, 1e-12);
}

}  // namespace
}  // namespace thinwall::reduction::sparse_report_test
