#include "reduction/rigid_count.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "reduction/methods/free_interface.hpp"
#include "reduction/methods/static_flexibility.hpp"
#include "reduction/trust/comparison.hpp"
#include "reduction/trust/rigid_sets.hpp"
#include "tests/reduction/reducible_part.hpp"

namespace thinwall::reduction::rigid_count_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Springs of 1 N/m between masses of 1 kg: λ_k = 4 sin²(kπ/2n) of the free one, below 4 of each.
FullModel chain(int n, bool held) {
  FullModel full;
  MatrixXd K = MatrixXd::Zero(n, n);
  for (int i = 0; i + 1 < n; ++i) {
    K(i, i) += 1.0, K(i + 1, i + 1) += 1.0;
    K(i, i + 1) = K(i + 1, i) = -1.0;
  }
  if (held) K(0, 0) += 1.0;
  full.K = K.sparseView();
  full.M = MatrixXd::Identity(n, n).sparseView();
  for (int i = 0; i < n; ++i) full.node_of_row.push_back(i);
  full.rigid = held ? MatrixXd(n, 0) : MatrixXd(VectorXd::Ones(n));
  return full;
}

TEST(RigidCount, IsWhereLambdaJumps) {
  EXPECT_EQ(rigid_count(VectorXd(), 1.0), 0);
  EXPECT_EQ(rigid_count(Eigen::Vector3d(0.0, 1.0, 2.0), 0.0), 1);
  EXPECT_EQ(rigid_count(Eigen::Vector3d(-1e-9, 1e-8, 2.0), 0.0), 2) << "the largest jump upwards, not the first";
  EXPECT_EQ(rigid_count(Eigen::Vector3d(1.0, 2.0, 3.0), 0.0), 0);
  EXPECT_EQ(rigid_count(Eigen::Vector3d(1e-9, 2e-9, 3e-9), 1e-8), 3) << "nothing follows the last but round-off";
  VectorXd many = VectorXd::Zero(20);
  many.tail(5).setOnes();
  EXPECT_EQ(rigid_count(many, 0.0), 0) << "twelve at most";
}

TEST(RigidCount, SaysHowFarFromFreeTheyAre) {
  const ModesWithoutEnergy free = without_energy(Eigen::Vector3d(39.4784176, 1e9, 2e9), 0.0);  // (2π · 1 Hz)²
  EXPECT_EQ(free.count, 1);
  EXPECT_NEAR(free.highest_hz, 1.0, 1e-8);
  EXPECT_EQ(without_energy(Eigen::Vector3d(1.0, 2.0, 3.0), 0.0).highest_hz, 0.0);
}

TEST(RigidBodyModes, OfTheSmallestChainsAreFound) {
  for (const int n : {2, 3, 5}) {
    const FullModel free = chain(n, false), held = chain(n, true);
    const MatrixXd R = rigid_body_modes(free.K, free.M, free.node_of_row);
    ASSERT_EQ(R.cols(), 1) << n;
    EXPECT_LT((R.cwiseAbs() - MatrixXd::Constant(n, 1, 1.0 / std::sqrt(n))).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_EQ(rigid_body_modes(held.K, held.M, held.node_of_row).cols(), 0) << n;
  }
}

/// All is told when every mode is: no mode lies beyond 2 ω_max.
TEST(FreeModesBeyond, EndsWithTheLastModeThereIs) {
  for (const bool held : {true, false}) {
    const FullModel full = chain(650, held);
    const StaticFlexibility flexibility(full);
    const PartModes modes = free_modes_beyond(full, flexibility, 4.0 / (2.0 * M_PI));
    ASSERT_EQ(modes.lambda.size(), 650) << held;
    EXPECT_LT(modes.lambda.maxCoeff(), 4.0 + 1e-9);
  }
}

/// MacNeal's residual coordinates have no mass, and λ beyond all others.
TEST(ModesWithoutEnergy, AreThoseOfCoordinatesWithMass) {
  const Reducible part = small_part(false);
  for (const int modes : {1, 3, 5, 12}) {
    const Reduction reduced = reduce(Method::macneal, part.full, part.interface, {.modes = modes});
    EXPECT_EQ(modes_without_energy(std::get<dynamics::SpatialModel>(reduced.model)).count, 6) << modes;
  }
}

/// Eigen's symmetric solvers see one triangle only.
TEST(NaturalFrequencies, OfAnAsymmetricModelAreThoseOfItsSymmetricPart) {
  const FullModel full = chain(4, true);
  dynamics::SpatialModel upper = dense(full.K, full.M);
  dynamics::SpatialModel middle = upper;
  upper.K(0, 1) *= 1.2, upper.M(0, 1) = 0.2;
  middle.K(0, 1) *= 1.1, middle.M(0, 1) = 0.1;
  middle.K(1, 0) *= 1.1, middle.M(1, 0) = 0.1;
  dynamics::SpatialModel lower = upper;
  lower.K.transposeInPlace();
  lower.M.transposeInPlace();
  const VectorXd expected = natural_frequencies_hz(middle, 0, 0.1);
  for (const auto& model : {upper, lower})
    EXPECT_LT((natural_frequencies_hz(model, 0, 0.1) - expected).norm(), 1e-12 * expected.norm());
}

TEST(StaticFlexibility, SaysHowFarAMotionIsFromFreeThoughItIsLittle) {
  FullModel full = chain(2, false);
  full.rigid(1, 0) += 1e-5;
  try {
    const StaticFlexibility flexibility(full);
    FAIL() << "the spring is stretched";
  } catch (const core::InputError& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.find("0.0000"), std::string::npos) << text;
    EXPECT_NE(text.find("e-06"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace thinwall::reduction::rigid_count_test
