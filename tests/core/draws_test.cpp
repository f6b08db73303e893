// Draws of the normal distribution, and the middle of drawn values.

#include "core/draws.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace thinwall::core::draws_test {
namespace {

/// Mean 0 and variance 1 within four of their standard errors, and a fourth moment of 3.
TEST(NormalDraw, HasTheMomentsOfTheNormalDistribution) {
  std::mt19937 random(1);
  constexpr int draws = 40000;
  double sum = 0.0, squares = 0.0, fourth = 0.0;
  for (int i = 0; i < draws; ++i) {
    const double z = normal_draw(random);
    sum += z;
    squares += z * z;
    fourth += z * z * z * z;
  }
  EXPECT_NEAR(sum / draws, 0.0, 4.0 / std::sqrt(draws));
  EXPECT_NEAR(squares / draws, 1.0, 4.0 * std::sqrt(2.0 / draws));
  EXPECT_NEAR(fourth / draws, 3.0, 4.0 * std::sqrt(96.0 / draws));
}

TEST(MiddleOfDraws, LeavesOutAsManyAtEitherEnd) {
  std::vector<double> values;
  for (int i = 199; i >= 1; --i) values.push_back(i);
  EXPECT_EQ(middle_95_percent(values), std::pair(5.0, 195.0));
  values.push_back(200.0);  // 0.025 · 201 = 5.025
  EXPECT_NEAR(middle_95_percent(values).first, 5.025, 1e-12);
  EXPECT_NEAR(middle_95_percent(values).second, 195.975, 1e-12);
  EXPECT_EQ(middle_95_percent({3.0, 1.0, 2.0}), std::pair(1.0, 3.0)) << "as few have no tails";
  EXPECT_EQ(middle_95_percent({7.0}), std::pair(7.0, 7.0));
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(middle_95_percent({1.0, infinity, infinity}), std::pair(1.0, infinity));
}

}  // namespace
}  // namespace thinwall::core::draws_test
