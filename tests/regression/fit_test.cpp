// Hyper-parameters of largest likelihood and cross-validation against values computed outside this project.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "regression/cross_validation.hpp"
#include "regression/gaussian_process.hpp"
#include "tests/regression/toy.hpp"

namespace thinwall::regression::fit_test {
namespace {

TaskData toy(const std::vector<int>& tasks, bool without_noise = false) {
  return testing::toy_data(tasks, false, without_noise);
}

int starts_that_reach(const Fit& found, double likelihood) {
  return static_cast<int>(
      std::count_if(found.of_starts.begin(), found.of_starts.end(), [&](double l) { return l > likelihood - 1e-4; }));
}

TEST(Fit, OfOneTaskIsNotBelowTheBestKnown) {
  const std::vector<double> best{19.816582923718912, -66.704823625697614, -133.0126553488119};
  for (const int task : {0, 1, 2}) {
    const Fit found = fit(toy({task}));
    EXPECT_GT(found.log_likelihood, best[static_cast<std::size_t>(task)] - 1e-4) << task;
    EXPECT_GE(starts_that_reach(found, best[static_cast<std::size_t>(task)]), 10) << task;
  }
}

TEST(Fit, OfThreeTasksIsNotBelowTheBestKnown) {
  constexpr double best = -153.93502478855766;
  const Fit found = fit(toy({0, 1, 2}));
  EXPECT_GT(found.log_likelihood, best - 1e-4);
  EXPECT_GE(starts_that_reach(found, best), 10);
}

/// Starts are shared out among threads, and what is found does not depend on their number.
TEST(Fit, DoesNotDependOnTheNumberOfThreads) {
  const int threads = core::thread_count();
  core::set_thread_count(1);
  const Fit alone = fit(toy({0, 1}), {.starts = 3});
  core::set_thread_count(3);
  const Fit shared = fit(toy({0, 1}), {.starts = 3});
  core::set_thread_count(threads);
  EXPECT_EQ(packed(alone.parameters), packed(shared.parameters));
  EXPECT_EQ(alone.of_starts, shared.of_starts);
}

/// One search from where another ended stays there.
TEST(Fit, BeginsWhereItIsTold) {
  const Fit found = fit(toy({0, 1}), {.starts = 3});
  const Fit again = fit(toy({0, 1}), {.starts = 1, .first = found.parameters});
  EXPECT_NEAR(again.log_likelihood, found.log_likelihood, 1e-6);
  EXPECT_LT((packed(again.parameters) - packed(found.parameters)).norm(), 0.01);
  EXPECT_THROW((void)fit(toy({0}), {.first = found.parameters}), core::InputError);
}

/// Many tasks, of which a search takes long, are searched from fewer places.
TEST(Fit, StartsFromFewerPlacesWhereParametersAreMany) {
  EXPECT_EQ(search_starts({}, 3, 3), 12);
  EXPECT_EQ(search_starts({}, 3, 24), 4);
  EXPECT_EQ(search_starts({.starts = 2}, 3, 24), 2);
}

/// R² of the pooled folds: 0.97291, 0.85104, 0.43977 alone; 0.97322, 0.86309, 0.48568 together.
TEST(CrossValidation, HasTheR2OfAnotherProgram) {
  std::vector<int> fold;
  for (const auto& row : testing::toy_rows) fold.push_back(row.fold);
  const double alone[] = {0.9729137858426741, 0.8510352718576139, 0.4397729531604717};
  for (const int task : {0, 1, 2}) {
    const CrossValidation of_task = cross_validate(toy({task}), fold);
    EXPECT_NEAR(of_task.R2(0), alone[task], 2e-4) << task;
    EXPECT_NEAR(of_task.covered(0), 0.9375, 1e-9) << task;
  }
  const CrossValidation together = cross_validate(toy({0, 1, 2}), fold);
  EXPECT_NEAR(together.R2(0), 0.9732210348738677, 5e-4);
  EXPECT_NEAR(together.R2(1), 0.8630892883490733, 5e-4);
  EXPECT_NEAR(together.R2(2), 0.4856832775010962, 5e-4);
}

/// Predictions do not depend on the unit of the targets.
TEST(GaussianProcess, IsInTheUnitOfItsTargets) {
  const TaskData data = toy({0, 1});
  TaskData other = data;
  other.targets.col(1) = (-3000.0 * data.targets.col(1).array() + 7.0).matrix();
  HyperParameters parameters;
  parameters.length = Eigen::Vector3d(1.0, 0.8, 1.5);
  parameters.L = (Eigen::Matrix2d() << 1.0, 0.0, 0.6, 0.8).finished();
  parameters.noise_sd = Eigen::Vector2d(0.1, 0.2);
  const GaussianProcess a(data, parameters, Kernel::matern_5_2);
  parameters.L.row(1) *= -1.0;
  parameters.L(1, 1) *= -1.0;
  const GaussianProcess b(other, parameters, Kernel::matern_5_2);
  const Eigen::MatrixXd at = data.inputs.topRows(3).array() + 0.05;
  const Prediction here = a.predict(at), there = b.predict(at);
  EXPECT_LT((there.mean.col(0) - here.mean.col(0)).norm(), 1e-8 * here.mean.col(0).norm());
  EXPECT_LT((there.mean.col(1).array() - (-3000.0 * here.mean.col(1).array() + 7.0)).matrix().norm(),
            1e-8 * there.mean.col(1).norm());
  EXPECT_NEAR(there.covariance(1, 1), 9e6 * here.covariance(1, 1), 1e-6 * there.covariance(1, 1));
}

TEST(Fit, RefusesWhatItCannotLearnFrom) {
  TaskData data = toy({0, 2});
  data.targets.col(1).setConstant(std::numeric_limits<double>::quiet_NaN());
  data.targets(4, 1) = 1.0;
  EXPECT_THROW((void)fit(data), core::InputError);
  data = toy({0});
  data.inputs(3, 1) = std::numeric_limits<double>::infinity();
  EXPECT_THROW((void)fit(data), core::InputError);
  EXPECT_THROW((void)fit(toy({0}), {Kernel::matern_3_2, {}, 0}), core::InputError);
  EXPECT_THROW((void)cross_validate(toy({0}), {0, 1}), core::InputError);
}

}  // namespace
}  // namespace thinwall::regression::fit_test
