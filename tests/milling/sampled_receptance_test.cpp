#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "milling/direct/cut_at_speed.hpp"
#include "milling/direct/harmonic_gain.hpp"
#include "tests/milling/benchmark.hpp"

namespace thinwall::milling::sampled_receptance_test {
namespace {

using testing::benchmark_process;

TEST(SampledReceptance, RefusesWhatCannotBeUsed) {
  const ContactGrid grid = contact_grid(benchmark_process(0.1), Eigen::Vector3d::UnitX(), {1, 6});
  const SampledReceptance good{Eigen::VectorXd::LinSpaced(7, 1.0, 7.0),
                               std::vector<Eigen::Matrix3cd>(7, Eigen::Matrix3cd::Identity())};
  SampledReceptance bad = good;
  bad.H[3](1, 2) = std::nan("");
  EXPECT_THROW((void)harmonic_gain(bad, grid, 5000.0), core::InputError);
  bad = good;
  bad.frequency_hz(2) = 1.5;
  EXPECT_THROW((void)harmonic_gain(bad, grid, 5000.0), core::InputError);
  bad = good;
  bad.H.pop_back();
  EXPECT_THROW((void)harmonic_gain(bad, grid, 5000.0), core::InputError);
  bad = {Eigen::VectorXd::LinSpaced(5, 1.0, 5.0), std::vector<Eigen::Matrix3cd>(5, Eigen::Matrix3cd::Identity())};
  EXPECT_THROW((void)harmonic_gain(bad, grid, 5000.0), core::InputError);
}

}  // namespace
}  // namespace thinwall::milling::sampled_receptance_test
