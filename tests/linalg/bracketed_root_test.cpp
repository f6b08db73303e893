#include "linalg/bracketed_root.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"

namespace thinwall::linalg::bracketed_root_test {
namespace {

TEST(BracketedRoot, FindsSmoothFlatAndKinkedRootsInFewValues) {
  int values = 0;
  const auto root = [&](auto f, double a, double b) {
    values = 0;
    return bracketed_root(
        [&](double x) {
          ++values;
          return f(x);
        },
        {a, f(a), b, f(b)}, {.relative = 1e-13}, "x");
  };
  EXPECT_NEAR(root([](double x) { return std::cos(x) - x; }, 0.0, 1.0), 0.7390851332151607, 1e-13);
  EXPECT_LT(values, 16);
  EXPECT_NEAR(root([](double x) { return std::exp(20.0 * (x - 0.3)) - 1.0; }, 0.0, 1.0), 0.3, 1e-13);
  EXPECT_LT(values, 60);
  EXPECT_NEAR(root([](double x) { return x < 0.5 ? 100.0 * (x - 0.5) : 0.01 * (x - 0.5); }, 0.0, 3.0), 0.5, 1e-12);
  EXPECT_LT(values, 150);  // a bisection in three
  EXPECT_EQ(bracketed_root([](double x) { return x; }, {0.0, 0.0, 1.0, 1.0}, {}, "x"), 0.0);
}

TEST(BracketedRoot, EndsAtAValueThatCountsAsZeroAndFindsAJump) {
  const auto line = [](double x) { return x - 0.25; };
  const double near = bracketed_root(line, {0.0, -0.25, 4.0, 3.75}, {.relative = 1e-15, .value = 1e-3}, "x");
  EXPECT_NEAR(near, 0.25, 1e-3);
  const auto jump = [](double x) { return x < 0.7 ? -2.0 : 1.0; };
  EXPECT_NEAR(bracketed_root(jump, {0.0, -2.0, 1.0, 1.0}, {.relative = 1e-6, .value = 1e-6}, "x"), 0.7, 1e-6);
}

TEST(BracketedRoot, SaysSoWhenTheFunctionIsNotFinite) {
  EXPECT_THROW((void)bracketed_root([](double) { return std::nan(""); }, {0.0, -1.0, 1.0, 1.0}, {}, "x"),
               core::NumericalError);
}

}  // namespace
}  // namespace thinwall::linalg::bracketed_root_test
