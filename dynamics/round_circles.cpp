#include "dynamics/round_circles.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <set>

namespace thinwall::dynamics {

namespace {

using Eigen::Index;

/// Adds the steps, by the numbers of their first lines, on which a curve turns too much.
void add_steps(const Eigen::VectorXcd& curve, std::set<Index>& steps) {
  constexpr double largest_turn = 20.0 * std::numbers::pi / 180.0;
  const double seen = 0.003 * curve.cwiseAbs().maxCoeff();
  for (Index line = 1; line + 1 < curve.size(); ++line) {
    const std::complex<double> before = curve(line) - curve(line - 1), after = curve(line + 1) - curve(line);
    const double a = std::abs(before), b = std::abs(after);
    if (std::max(a, b) <= seen || std::abs(std::arg(after * std::conj(before))) <= largest_turn) continue;
    const bool undamped = std::abs(before.imag()) <= 1e-9 * a && std::abs(after.imag()) <= 1e-9 * b;
    if (undamped) continue;
    if (2.0 * a > b) steps.insert(line - 1);
    if (2.0 * b > a) steps.insert(line);
  }
}

}  // namespace

std::vector<double> lines_to_add(const Eigen::VectorXd& hz, const Eigen::MatrixXcd& curves) {
  std::set<Index> steps;
  for (Index entry = 0; entry < curves.cols(); ++entry) add_steps(curves.col(entry), steps);
  std::vector<double> middles;
  middles.reserve(steps.size());
  for (const Index line : steps) middles.push_back(0.5 * (hz(line) + hz(line + 1)));
  return middles;
}

}  // namespace thinwall::dynamics
