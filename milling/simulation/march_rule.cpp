#include "milling/simulation/march_rule.hpp"

#include "milling/cut/product_rule.hpp"

namespace thinwall::milling {

namespace {

/// h ∫ e^{Λ h (c − s)} ℓ_j(s) ds B for the complex moments of the poles, states × forces.
Eigen::MatrixXd driven(const ContactState& structure, const Eigen::MatrixXd& B, const Eigen::VectorXcd& moments,
                       double step_s) {
  const Eigen::Index n = structure.decay.size();
  const Eigen::Index reals = structure.real_pole.size();
  const auto re = B.topRows(n);
  const auto im = B.middleRows(n, n);
  const Eigen::VectorXd a = step_s * moments.real();
  const Eigen::VectorXd b = step_s * moments.imag();
  Eigen::MatrixXd result(structure.size(), B.cols());
  result.topRows(n) = a.head(n).asDiagonal() * re;
  result.topRows(n) -= b.head(n).asDiagonal() * im;
  result.middleRows(n, n) = a.head(n).asDiagonal() * im;
  result.middleRows(n, n) += b.head(n).asDiagonal() * re;
  result.bottomRows(reals) = a.tail(reals).asDiagonal() * B.bottomRows(reals);
  return result;
}

Eigen::VectorXcd poles_of(const ContactState& structure) {
  const Eigen::Index n = structure.decay.size();
  Eigen::VectorXcd poles(n + structure.real_pole.size());
  for (Eigen::Index k = 0; k < n; ++k) poles(k) = {structure.decay(k), structure.frequency(k)};
  poles.tail(structure.real_pole.size()) = structure.real_pole.matrix().cast<std::complex<double>>();
  return poles;
}

/// C Λ: the velocity of a state.
Eigen::MatrixXd velocity_map(const ContactState& structure, const Eigen::MatrixXd& motion) {
  return motion * state_matrix(structure);
}

/// The states' share of a map with 8 rows, `upper` at the middle and `lower` at the end.
Eigen::MatrixXd stacked(const Eigen::MatrixXd& upper, const Eigen::MatrixXd& lower) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(8, upper.cols());
  rows.topRows(upper.rows()) = upper;
  rows.middleRows(4, lower.rows()) = lower;
  return rows;
}

/// M e^{Λ t}.
Eigen::MatrixXd after(const Eigen::MatrixXd& map, const ContactState& structure, double time_s) {
  Eigen::MatrixXd flight = Eigen::MatrixXd::Identity(structure.size(), structure.size());
  advance(free_flight(structure, time_s), flight);
  return map * flight;
}

}  // namespace

MarchPorts ports_of(const ContactState& structure, const Eigen::Matrix3d& residual) {
  return {structure.B, structure.motion, residual};
}

MarchPorts ports_of(const ContactState& structure, const Eigen::Matrix3d& residual, const ForcePair& pair) {
  MarchPorts ports{Eigen::MatrixXd(structure.size(), 4), Eigen::MatrixXd(4, structure.size()), Eigen::MatrixXd(4, 4)};
  ports.B << structure.B, structure.pair_force;
  ports.motion << structure.motion, structure.pair_motion.transpose();
  ports.residual << residual, pair.at_cut, pair.from_cut.transpose(), pair.residual;
  return ports;
}

template <int N>
MarchRule<N> march_rule(const ContactState& structure, const MarchPorts& ports, double step_s, double step_rad) {
  const Eigen::Vector3d nodes(0.0, 0.5, 1.0);
  const ProductRule product(nodes, fastest_pole(structure) * step_s);
  const ModeMoments moments = product.moments(poles_of(structure) * step_s);
  const Eigen::MatrixXd velocity = velocity_map(structure, ports.motion);
  const double seconds_per_rad = step_s / step_rad;
  MarchRule<N> rule;
  rule.flight = free_flight(structure, step_s);
  rule.displacement.from_state =
      stacked(after(ports.motion, structure, 0.5 * step_s), after(ports.motion, structure, step_s));
  rule.slope.from_state =
      seconds_per_rad * stacked(after(velocity, structure, 0.5 * step_s), after(velocity, structure, step_s));
  rule.update.resize(structure.size(), 3 * N);
  for (int j = 0; j < 3; ++j) rule.update.middleCols(N * j, N) = driven(structure, ports.B, moments.end.col(j), step_s);
  for (int node = 0; node < 2; ++node) {
    const auto at = static_cast<std::size_t>(node);
    const Eigen::VectorXd slopes = lagrange_slopes(nodes, node + 1);
    for (int j = 0; j < 3; ++j) {
      const auto from = static_cast<std::size_t>(j);
      const bool same = j == node + 1;
      const Eigen::MatrixXd x = driven(structure, ports.B, moments.inside[at + 1].col(j), step_s);
      rule.displacement.from_force[at][from] = ports.motion * x;
      if (same) rule.displacement.from_force[at][from] += ports.residual;
      rule.slope.from_force[at][from] = seconds_per_rad * velocity * x + slopes(j) / step_rad * ports.residual;
      if (same) rule.slope.from_force[at][from] += seconds_per_rad * ports.motion * ports.B;
    }
  }
  return rule;
}

template MarchRule<3> march_rule<3>(const ContactState&, const MarchPorts&, double, double);
template MarchRule<4> march_rule<4>(const ContactState&, const MarchPorts&, double, double);

StartMap start_map(const ContactState& structure, const Eigen::Matrix3d& residual, double rad_per_s) {
  return {stacked(structure.motion, velocity_map(structure, structure.motion) / rad_per_s), residual,
          structure.motion * structure.B / rad_per_s};
}

}  // namespace thinwall::milling
