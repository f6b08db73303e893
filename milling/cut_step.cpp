#include "milling/cut_step.hpp"

#include <algorithm>
#include <cmath>

#include "milling/product_rule.hpp"

namespace thinwall::milling {

namespace {

// ∫₀^t e^{Λ(t−s)} B ℓ_j(s) ds for all j, states × 3 n; the integrand is entire, so Gauss's rule converges to round-off.
Eigen::MatrixXd force_to_state(const ContactState& state, const Eigen::VectorXd& node, double step_s, double end,
                               const GaussRule& rule) {
  Eigen::MatrixXd moment = Eigen::MatrixXd::Zero(state.size(), 3 * node.size());
  for (Eigen::Index q = 0; q < rule.node.size(); ++q) {
    const double s = end * rule.node(q);
    Eigen::MatrixXd impulse = state.B;
    advance(free_flight(state, (end - s) * step_s), impulse);
    const Eigen::VectorXd polynomial = lagrange_polynomials(node, s) * (end * step_s * rule.weight(q));
    for (Eigen::Index j = 0; j < node.size(); ++j) moment.middleCols(3 * j, 3) += polynomial(j) * impulse;
  }
  return moment;
}

}  // namespace

int nodes_of_step(double rate_times_step) {
  // c_n = (n!)⁴ / ((2n+1) ((2n)!)³), built up from c_1 = 1/24.
  double c = 1.0 / 24.0;
  for (int n = 1; n < 10; ++n) {
    if (n >= 2 && c * std::pow(2.0 * rate_times_step, 2 * n) <= 1e-9) return n;
    const double next = n + 1.0;
    c *= std::pow(next, 4) * (2.0 * n + 1.0) / ((2.0 * next + 1.0) * std::pow(2.0 * next * (2.0 * next - 1.0), 3));
  }
  return 10;
}

CutStep cut_step(const ContactState& state, double step_s, int nodes) {
  const Eigen::Index p = state.directions();
  CutStep step;
  step.node = gauss_legendre(nodes).node;
  step.E.resize(p * nodes, state.size());
  step.K.resize(p * nodes, 3 * nodes);
  // Points per e-folding or radian of the fastest pole, on top of the degree of the polynomials.
  const int points = nodes + 6 + std::min(40, static_cast<int>(std::ceil(fastest_pole(state) * step_s)));
  const GaussRule rule = gauss_legendre(points);
  for (int j = 0; j < nodes; ++j) {
    Eigen::MatrixXd observed = state.C.transpose();
    const FreeFlight to_node = free_flight(state, step.node(j) * step_s);
    // C e^{Λt} is the transposed flow, whose rotation turns the other way.
    advance({to_node.cosine, -to_node.sine, to_node.decay}, observed);
    step.E.middleRows(p * j, p) = observed.transpose();
    step.K.middleRows(p * j, p) = state.C * force_to_state(state, step.node, step_s, step.node(j), rule);
  }
  step.L = force_to_state(state, step.node, step_s, 1.0, rule);
  step.flight = free_flight(state, step_s);
  return step;
}

}  // namespace thinwall::milling
