#include "fem/error/edge_exponent.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

#include "linalg/bracketed_root.hpp"

namespace thinwall::fem {

double clamped_edge_exponent(double poisson_ratio) {
  assert(poisson_ratio >= -1.0 && poisson_ratio <= 0.5);
  if (poisson_ratio <= 0.0) return 1.0;
  const double kappa = 3.0 - 4.0 * poisson_ratio;
  const auto f = [kappa](double lambda) {
    return std::pow(std::sin(0.5 * std::numbers::pi * lambda), 2) -
           (0.25 * (kappa + 1.0) * (kappa + 1.0) - lambda * lambda) / kappa;
  };
  return linalg::bracketed_root(f, {0.5, f(0.5), 1.0, f(1.0)}, {}, "the exponent of a clamped edge");
}

}  // namespace thinwall::fem
