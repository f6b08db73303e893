#include "core/gauss_rule.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace thinwall::core::gauss_rule_test {
namespace {

/// The largest relative error of (a + 1) ∫ (1 − s)^a (1 − s)^d ds = (a + 1) / (a + d + 1) up to the degree.
double worst_error(int count, int a, int degree) {
  const GaussRule rule = gauss_jacobi(count, a);
  double worst = 0.0;
  for (int d = 0; d <= degree; ++d) {
    const double found = rule.weight.dot((1.0 - rule.node.array()).pow(d).matrix());
    worst = std::max(worst, std::abs(found * (a + d + 1.0) / (a + 1.0) - 1.0));
  }
  return worst;
}

TEST(GaussRule, IsExactToItsDegreeForEachWeight) {
  for (int a = 0; a <= 2; ++a) {
    for (int count = 1; count <= 40; ++count)
      EXPECT_LT(worst_error(count, a, 2 * count - 1), 2e-13) << count << " " << a;
    for (int count = 1; count <= 4; ++count) EXPECT_GT(worst_error(count, a, 2 * count), 1e-6) << count << " " << a;
  }
}

TEST(GaussRule, HasFourNodesAsTheTablesGiveThem) {
  // Abramowitz & Stegun, table 25.4, moved from (−1, 1).
  const double inner = std::sqrt(3.0 / 7.0 - 2.0 / 7.0 * std::sqrt(1.2));
  const double outer = std::sqrt(3.0 / 7.0 + 2.0 / 7.0 * std::sqrt(1.2));
  const std::vector<double> x{-outer, -inner, inner, outer};
  const std::vector<double> w{18.0 - std::sqrt(30.0), 18.0 + std::sqrt(30.0), 18.0 + std::sqrt(30.0),
                              18.0 - std::sqrt(30.0)};
  const GaussRule rule = gauss_legendre(4);
  for (int i = 0; i < 4; ++i) {
    const auto at = static_cast<std::size_t>(i);
    EXPECT_NEAR(rule.node(i), 0.5 + 0.5 * x[at], 1e-15);
    EXPECT_NEAR(rule.weight(i), w[at] / 72.0, 1e-15);
  }
}

TEST(GaussRule, HasDistinctNodesInsideAndPositiveWeights) {
  for (int a = 0; a <= 2; ++a) {
    for (int count = 1; count <= 300; count += 7) {
      const GaussRule rule = gauss_jacobi(count, a);
      EXPECT_GT(rule.node(0), 0.0);
      EXPECT_LT(rule.node(count - 1), 1.0);
      for (int i = 1; i < count; ++i) EXPECT_GT(rule.node(i), rule.node(i - 1) + 0.1 / (count * count));
      EXPECT_GT(rule.weight.minCoeff(), 0.0);
      EXPECT_NEAR(rule.weight.sum(), 1.0, 1e-13);
    }
  }
}

}  // namespace
}  // namespace thinwall::core::gauss_rule_test
