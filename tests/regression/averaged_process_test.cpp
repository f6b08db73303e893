// Processes that do not take their hyper-parameters as known.

#include "regression/averaged_process.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/error.hpp"
#include "regression/gaussian_process.hpp"

namespace thinwall::regression::averaged_process_test {
namespace {

double between(std::mt19937& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
}

double normal(std::mt19937& random) {
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) sum += between(random, 0.0, 1.0);
  return sum;
}

Eigen::MatrixXd places(std::mt19937& random, Eigen::Index n, Eigen::Index d) {
  Eigen::MatrixXd x(n, d);
  for (double& v : x.reshaped()) v = between(random, -1.0, 1.0);
  return x;
}

/// With a prior that allows one set of hyper-parameters, the average is the process of these.
TEST(AveragedProcess, IsTheProcessOfTheHyperParametersWhereThePriorAllowsNoOthers) {
  std::mt19937 random(3);
  TaskData data{places(random, 9, 2), Eigen::MatrixXd(9, 1)};
  for (Eigen::Index i = 0; i < 9; ++i) data.targets(i, 0) = std::sin(2.0 * data.inputs(i, 0)) + data.inputs(i, 1);
  AveragingOptions options;
  options.prior = {std::log(0.8), 1e-9, std::log(1.3), 1e-9, std::log(0.1), 1e-9};
  HyperParameters known{Eigen::Vector2d(0.8, 0.8), Eigen::MatrixXd::Constant(1, 1, 1.3),
                        Eigen::VectorXd::Constant(1, 0.1)};
  const Eigen::MatrixXd at = places(random, 4, 2);
  const AveragedPrediction averaged = AveragedProcess(data, options).predict(at);
  const Prediction plain = GaussianProcess(data, known, Kernel::squared_exponential).predict(at);
  EXPECT_LT((averaged.mean - plain.mean.col(0)).norm(), 1e-6);
  EXPECT_LT((averaged.covariance - plain.covariance).norm(), 1e-6);
  EXPECT_NEAR(averaged.noise_variance, 0.01 * standardised(data).deviation.cwiseAbs2()(0), 1e-9);
}

/// With next to no data the draws are those of the prior: mean and deviation of 400 draws of ln ℓ, whose
/// standard errors are 0.8/√400 = 0.04 at most for independent ones, and some times that for a chain.
TEST(AveragedProcess, DrawsFromThePriorWhereDataSayNothing) {
  TaskData data{Eigen::MatrixXd(2, 1), Eigen::MatrixXd(2, 1)};
  data.inputs << 0.0, 1e6;
  data.targets << -1.0, 1.0;
  AveragingOptions options;
  options.samples = 400;
  Eigen::VectorXd ln_length(options.samples);
  const AveragedProcess process(data, options);
  for (int i = 0; i < options.samples; ++i)
    ln_length(i) = std::log(process.draws()[static_cast<std::size_t>(i)].parameters.length(0));
  EXPECT_NEAR(ln_length.mean(), options.prior.ln_length, 0.16);
  EXPECT_NEAR(std::sqrt((ln_length.array() - ln_length.mean()).square().mean()), options.prior.sd_ln_length, 0.16);
}

/// Functions of nine places in three dimensions, drawn from processes whose lengths are drawn too: the intervals of the
/// average cover what they say, where those of the most likely hyper-parameters cover too little. The standard error of
/// a share of 40 functions of 6 places each is below 0.03.
TEST(AveragedProcess, CoversWhatItSaysWithFewPlaces) {
  std::mt19937 random(7);
  int covered = 0, covered_by_likeliest = 0, all = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const Eigen::MatrixXd x = places(random, 15, 3);
    Eigen::VectorXd length(3);
    for (double& l : length) l = std::exp(0.7 + 0.8 * normal(random));
    Eigen::MatrixXd K = correlation(Kernel::squared_exponential, x, x, length);
    K.diagonal().array() += 1e-8;
    Eigen::VectorXd z(15);
    for (double& v : z) v = normal(random);
    const Eigen::VectorXd f = Eigen::LLT<Eigen::MatrixXd>(K).matrixL() * z;
    TaskData data{x.topRows(9), f.head(9)};
    for (double& y : data.targets.reshaped()) y += 0.02 * normal(random);
    const AveragedPrediction averaged = AveragedProcess(data).predict(x.bottomRows(6));
    const Prediction likeliest = GaussianProcess(data, {.starts = 3}).predict(x.bottomRows(6));
    for (Eigen::Index i = 0; i < 6; ++i, ++all) {
      covered += std::abs(f(9 + i) - averaged.mean(i)) <= 1.96 * std::sqrt(averaged.covariance(i, i));
      covered_by_likeliest +=
          std::abs(f(9 + i) - likeliest.mean(i, 0)) <= 1.96 * std::sqrt(std::max(0.0, likeliest.covariance(i, i)));
    }
  }
  EXPECT_GE(covered, 0.90 * all);
  EXPECT_LT(covered_by_likeliest, covered);
}

TEST(AveragedProcess, RefusesWhatItCannotLearn) {
  EXPECT_THROW(AveragedProcess({Eigen::MatrixXd::Zero(1, 1), Eigen::MatrixXd::Zero(1, 1)}), core::InputError);
  EXPECT_THROW(AveragedProcess({Eigen::MatrixXd::Random(4, 1), Eigen::MatrixXd::Zero(4, 2)}), core::InputError);
  EXPECT_THROW(AveragedProcess({Eigen::MatrixXd::Random(4, 1), Eigen::MatrixXd::Zero(3, 1)}), core::InputError);
}

}  // namespace
}  // namespace thinwall::regression::averaged_process_test
