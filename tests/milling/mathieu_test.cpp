// The delayed Mathieu equation on the engine's own grids, which know nothing of milling.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/gauss_rule.hpp"
#include "milling/direct/cut_at_speed.hpp"

namespace thinwall::milling::mathieu_test {
namespace {

/// x'' + c x' + x = −(δ − b − 1 + ε cos t) x − b [x − x(t − 2π)], which is x'' + c x' + (δ + ε cos t) x = b x(t − 2π):
/// at every node a contact without past and one with. The oscillator has the stiffness 1, so that δ − b may be
/// negative. All multipliers of the period 2π.
Eigen::VectorXcd mathieu(double damping, double delta, double epsilon, double b) {
  constexpr double turn = 2.0 * std::numbers::pi;
  constexpr int elements = 4, nodes = 12;
  RelativeStructure oscillator;
  oscillator.poles.resize(1);
  oscillator.poles(0) = {-0.5 * damping, std::sqrt(1.0 - 0.25 * damping * damping)};
  oscillator.phi = Eigen::Vector3cd(1.0, 0.0, 0.0);
  oscillator.b = Eigen::Vector3cd(1.0, 0.0, 0.0) / std::complex<double>(0.0, 2.0 * oscillator.poles(0).imag());
  DiscreteCut d;
  d.grid.period_rad = turn;
  d.grid.one_delay = false;
  d.grid.node_rad.resize(elements * nodes);
  const core::GaussRule rule = core::gauss_legendre(nodes);
  for (int e = 0; e < elements; ++e) {
    d.grid.elements.push_back({e * turn / elements, (e + 1) * turn / elements, e * nodes, nodes});
    for (int i = 0; i < nodes; ++i) {
      const int node = e * nodes + i;
      d.grid.node_rad(node) = (e + rule.node(i)) * turn / elements;
      const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
      const double now = delta - b - 1.0 + epsilon * std::cos(d.grid.node_rad(node));
      d.grid.contacts.push_back({node, now * x, x, {}});
      d.grid.contacts.push_back({node, b * x, x, {{node, true, x}}});
    }
  }
  d.loop = regenerative_loop(oscillator, d.grid, 30.0 / std::numbers::pi);  // a radian a second
  return multipliers(d, 1.0);
}

TEST(DelayedMathieu, MultipliersWithDamping) {
  // Computed outside of this project, to the digits that are given.
  EXPECT_NEAR(mathieu(0.1, 3.0, 0.2, -0.15).cwiseAbs().maxCoeff(), 0.35141726095, 1e-11);
  EXPECT_NEAR(mathieu(0.1, 3.0, 2.0, -0.15).cwiseAbs().maxCoeff(), 0.512052284098, 1e-12);
}

TEST(DelayedMathieu, BoundariesAreStraightLines) {
  // Without damping a multiplier is 1 where δ − b is a_2k/4 or b_2k/4, characteristic values of Mathieu's equation at
  // q = 2ε, and −1 where δ + b is one of odd order: ε = 1, ten digits. The lowest of each, a_0/4 and b_1/4, lie below
  // zero, where the equation without cos t would diverge.
  const auto distance = [](double delta, double b, double multiplier) {
    return (mathieu(0.0, delta, 1.0, b).array() - multiplier).abs().minCoeff();
  };
  for (const double b : {-0.3, -0.1, 0.2}) {
    for (const double line : {-0.3784892213, 0.9180581766, 1.2931662833})
      EXPECT_LT(distance(line + b, b, 1.0), 1e-9) << line << b;
    for (const double line : {-0.3476691253, 0.5947999701, 2.2851569344, 2.3425806209})
      EXPECT_LT(distance(line - b, b, -1.0), 1e-9) << line << ", " << b;
  }
}

}  // namespace
}  // namespace thinwall::milling::mathieu_test
