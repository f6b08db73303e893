#include "core/gauss_rule.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace thinwall::core {

namespace {

/// A polynomial at one place.
struct ValueAndSlope {
  double value;
  double slope;
};

/// P_n^{(a, 0)}(x) by the recurrence, with the factors of each step divided by those of P_{k−1}, so that for a = 0 it
/// is Legendre's to the last bit.
ValueAndSlope jacobi_polynomial(int n, int a, double x) {
  double before = 1.0;
  double value = 0.5 * ((a + 2.0) * x + a);
  for (int k = 2; k <= n; ++k) {
    const double c = 2.0 * k + a;
    const double shifted = x + a * a / (c * (c - 2.0));
    const double of_before = 2.0 * (k + a - 1.0) * (k - 1.0) / (c - 2.0);
    before = std::exchange(value, ((c - 1.0) * shifted * value - of_before * before) / (2.0 * k * (k + a) / c));
  }
  const double c = 2.0 * n + a;
  return {value, n * ((x - a / c) * value - 2.0 * (n + a) / c * before) / (x * x - 1.0)};
}

}  // namespace

GaussRule gauss_jacobi(int count, int a) {
  GaussRule rule{Eigen::VectorXd(count), Eigen::VectorXd(count)};
  for (int i = 0; i < count; ++i) {
    // Within Newton's reach of the root.
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5 * (a + 1.0)));
    double slope = 0.0;
    for (int iteration = 0; iteration < 20; ++iteration) {
      const ValueAndSlope at = jacobi_polynomial(count, a, x);
      slope = at.slope;
      const double step = at.value / slope;
      x -= step;
      if (std::abs(step) < 1e-15) break;
    }
    rule.node(i) = 0.5 * (1.0 + x);
    rule.weight(i) = (a + 1.0) / ((1.0 - x * x) * slope * slope);
  }
  return rule;
}

GaussRule gauss_legendre(int count) {
  return gauss_jacobi(count, 0);
}

}  // namespace thinwall::core
