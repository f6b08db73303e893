// Gaussian processes against values computed outside this project, two of them with forty digits, and against
// identities.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "regression/dense_process.hpp"
#include "regression/kronecker_process.hpp"
#include "regression/one_task.hpp"
#include "tests/regression/toy.hpp"

namespace thinwall::regression::process_test {
namespace {

Eigen::VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

TaskData toy(const std::vector<int>& tasks, bool third_at_28 = false) {
  return testing::toy_data(tasks, third_at_28);
}

Eigen::MatrixXd test_places() {
  Eigen::MatrixXd u(3, 3);
  u << 0.1, -0.2, 0.3, -0.9, 0.8, -0.7, 1.2, 0.0, 1.1;
  return u;
}

const std::vector<double> single_theta{0.095310179804324949, -0.10536051565782628, 0.33647223662121284,
                                       0.18232155679395459, -2.120263536200091};
const std::vector<double> shared_theta{0.095310179804324949,
                                       -0.10536051565782628,
                                       0.33647223662121284,
                                       -0.10536051565782628,
                                       -0.69999999999999996,
                                       -0.51082562376599072,
                                       0.5,
                                       -0.40000000000000002,
                                       -0.916290731874155,
                                       -2.120263536200091,
                                       -1.3862943611198906,
                                       -0.69314718055994529};

void expect_near(const Eigen::MatrixXd& value, const Eigen::MatrixXd& expected, double tolerance) {
  ASSERT_EQ(value.rows(), expected.rows());
  ASSERT_EQ(value.cols(), expected.cols());
  EXPECT_LT((value - expected).cwiseAbs().maxCoeff(), tolerance * expected.cwiseAbs().maxCoeff());
}

/// Place-major.
Eigen::VectorXd in_one(const Eigen::MatrixXd& mean) {
  return mean.transpose().reshaped();
}

TEST(DenseProcess, OfOneTaskHasTheLikelihoodOfFortyDigits) {
  const auto process = dense_process(Kernel::squared_exponential, toy({0}), unpacked(vector_of(single_theta), 3, 1));
  ASSERT_TRUE(process);
  const Likelihood likelihood = log_likelihood(*process);
  EXPECT_NEAR(likelihood.value, 9.0178213877032039315, 1e-10);
  expect_near(likelihood.gradient,
              vector_of({-2.2484946997901645, 20.983257951787962, -14.315960238385461, 1.5097125583667059,
                         -4.3686208970275091}),
              1e-10);
  const Prediction at = predict(*process, test_places());
  expect_near(at.mean, vector_of({1.0597272340767638, -1.9746679627215737, 0.044077231794577898}), 1e-10);
  Eigen::MatrixXd covariance(3, 3);
  covariance << 0.0034763983752563732, -0.0006609322741860657, 0.0002415389063815665, -0.0006609322741860657,
      0.005818483533816865, -0.00043365486894919592, 0.0002415389063815665, -0.00043365486894919592,
      0.022287178478996417;
  expect_near(at.covariance, covariance, 1e-9);
}

TEST(DenseProcess, OfThreeTasksHasTheLikelihoodOfFortyDigits) {
  const auto process =
      dense_process(Kernel::squared_exponential, toy({0, 1, 2}), unpacked(vector_of(shared_theta), 3, 3));
  ASSERT_TRUE(process);
  const Likelihood likelihood = log_likelihood(*process);
  EXPECT_NEAR(likelihood.value, -216.8485519915730316, 1e-10 * 216.8);
  expect_near(likelihood.gradient,
              vector_of({-11.692547413917321, 16.075951827947392, -40.398515460666928, 15.072155824908064,
                         -16.014483201266131, 7.563431426322353, -8.1538028098916868, 33.412534457624623,
                         23.211333536921913, 3.2509886913755963, 68.551613187445639, 108.17383393046154}),
              1e-10);
  const Prediction at = predict(*process, test_places());
  expect_near(
      in_one(at.mean),
      vector_of({1.0811565154655565, -0.88061665347809281, 0.85256712638791043, -1.9542546977078334, 1.5930429782952764,
                 -1.2331644437460363, 0.072194472392846265, 0.3255949520824073, 0.38663499788537781}),
      1e-10);
  EXPECT_NEAR(at.covariance(0, 0), 0.0028162159096803974, 1e-12);
  EXPECT_NEAR(at.covariance(0, 4), 0.00025586934031465725, 1e-12);
}

TEST(DenseProcess, LeavesOutWhatWasNotMeasured) {
  const auto process =
      dense_process(Kernel::squared_exponential, toy({0, 1, 2}, true), unpacked(vector_of(shared_theta), 3, 3));
  ASSERT_TRUE(process);
  EXPECT_EQ(process->y.size(), 2 * 112 + 28);
  const Likelihood likelihood = log_likelihood(*process);
  EXPECT_NEAR(likelihood.value, -90.759858217305776, 1e-10 * 90.8);
  expect_near(likelihood.gradient,
              vector_of({-10.057713196656502, 17.913268751020755, -23.310912634055089, 15.058454468493828,
                         -9.94387159320884, 0.4152699844524223, -1.4266348649643703, 11.952853821228027,
                         7.4471620843749413, 3.999480356490742, 64.49106492685965, 9.3497027017379022}),
              1e-10);
  const Prediction at = predict(*process, test_places());
  expect_near(
      in_one(at.mean),
      vector_of({1.0770191585968716, -0.87694616984164586, 0.75364518878548159, -1.9551317114149098, 1.6175163236905101,
                 -1.5896161376468512, 0.068881098285039855, 0.37217671332656721, -0.22540507888192174}),
      1e-10);
  expect_near(at.covariance.diagonal(),
              vector_of({0.0028198067131094406, 0.0077074768588732967, 0.036941666210171253, 0.0043177189827470208,
                         0.011085587040742584, 0.055343808465246225, 0.0167852254773182, 0.035561471995196436,
                         0.094704262622471669}),
              1e-9);
}

/// All of its answers are those of the dense process.
TEST(KroneckerProcess, IsTheDenseOne) {
  for (const Kernel kernel : {Kernel::squared_exponential, Kernel::matern_3_2, Kernel::matern_5_2}) {
    const HyperParameters parameters = unpacked(vector_of(shared_theta), 3, 3);
    const auto dense = dense_process(kernel, toy({0, 1, 2}), parameters);
    const auto kronecker = kronecker_process(kernel, toy({0, 1, 2}), parameters);
    ASSERT_TRUE(dense && kronecker);
    const Likelihood a = log_likelihood(*dense), b = log_likelihood(*kronecker);
    EXPECT_NEAR(b.value, a.value, 1e-10 * std::abs(a.value));
    expect_near(b.gradient, a.gradient, 1e-10);
    const Prediction at = predict(*dense, test_places()), also = predict(*kronecker, test_places());
    expect_near(also.mean, at.mean, 1e-10);
    expect_near(also.covariance, at.covariance, 1e-9);
    const LeaveOneOut left = leave_one_out(*dense), also_left = leave_one_out(*kronecker);
    expect_near(also_left.mean, left.mean, 1e-9);
    expect_near(also_left.variance, left.variance, 1e-9);
  }
}

/// The gradients of all kernels are those of differences of the value.
TEST(DenseProcess, HasTheGradientOfItsValue) {
  for (const Kernel kernel : {Kernel::squared_exponential, Kernel::matern_3_2, Kernel::matern_5_2}) {
    const Eigen::VectorXd theta = vector_of(shared_theta);
    const TaskData data = toy({0, 1, 2}, true);
    const Eigen::VectorXd gradient = log_likelihood(*dense_process(kernel, data, unpacked(theta, 3, 3))).gradient;
    for (Eigen::Index k = 0; k < theta.size(); ++k) {
      constexpr double step = 1e-5;
      const auto value = [&](double change) {
        Eigen::VectorXd moved = theta;
        moved(k) += change;
        return log_likelihood(*dense_process(kernel, data, unpacked(moved, 3, 3))).value;
      };
      EXPECT_NEAR(gradient(k), (value(step) - value(-step)) / (2.0 * step), 1e-6 * gradient.norm()) << k;
    }
  }
}

/// Leaving an observation out and predicting it is what the closed form says.
TEST(DenseProcess, LeavesOneOut) {
  TaskData data = toy({0, 1, 2}, true);
  const HyperParameters parameters = unpacked(vector_of(shared_theta), 3, 3);
  const LeaveOneOut left = leave_one_out(*dense_process(Kernel::matern_5_2, data, parameters));
  for (const Eigen::Index i : {0, 57, 111}) {
    for (const Eigen::Index t : {0, 1}) {
      TaskData without = data;
      without.targets(i, t) = std::numeric_limits<double>::quiet_NaN();
      const Prediction at = predict(*dense_process(Kernel::matern_5_2, without, parameters), data.inputs.row(i));
      EXPECT_NEAR(left.mean(i, t), at.mean(0, t), 1e-9);
      const double noise = parameters.noise_sd(t);
      EXPECT_NEAR(left.variance(i, t), at.covariance(t, t) + noise * noise + jitter, 1e-9);
    }
  }
}

/// The likelihood that searches and averages ask for is that of the dense process, with values missing, too.
TEST(OneTask, HasTheLikelihoodOfTheDenseProcess) {
  const HyperParameters parameters = unpacked(vector_of(single_theta), 3, 1);
  for (const Kernel kernel : {Kernel::squared_exponential, Kernel::matern_3_2, Kernel::matern_5_2}) {
    for (const bool third_at_28 : {false, true}) {
      const TaskData data = toy({2}, third_at_28);
      const double dense = log_likelihood(*dense_process(kernel, data, parameters)).value;
      EXPECT_NEAR(log_likelihood(one_task(kernel, data), parameters), dense, 1e-10 * std::abs(dense));
    }
  }
}

TEST(OneTask, HasNoLikelihoodWhereTheCovarianceIsSingular) {
  TaskData data = toy({0});
  data.inputs.setZero();
  HyperParameters parameters = unpacked(vector_of(single_theta), 3, 1);
  parameters.L(0, 0) = 1e9;
  parameters.noise_sd(0) = 1e-3;
  EXPECT_FALSE(dense_process(Kernel::squared_exponential, data, parameters));
  EXPECT_EQ(log_likelihood(one_task(Kernel::squared_exponential, data), parameters),
            -std::numeric_limits<double>::infinity());
}

TEST(HyperParameters, ArePackedAndUnpacked) {
  const Eigen::VectorXd theta = vector_of(shared_theta);
  EXPECT_LT((packed(unpacked(theta, 3, 3)) - theta).norm(), 1e-14);
}

}  // namespace
}  // namespace thinwall::regression::process_test
