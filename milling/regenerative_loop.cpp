#include "milling/regenerative_loop.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <vector>

#include "milling/product_rule.hpp"

namespace thinwall::milling {

namespace {

using Eigen::Index;
using std::complex;

/// What unit modal forces at the nodes do to one mode: at the nodes, and at the end of the period.
struct ModeHistory {
  Eigen::VectorXcd flow;     ///< e^{λ t_i}
  Eigen::MatrixXcd at_node;  ///< nodes × nodes
  Eigen::RowVectorXcd at_end;
};

ModeHistory mode_history(complex<double> pole, const ContactGrid& grid, double seconds_per_rad) {
  const Index n = grid.node_rad.size();
  const double period = grid.period_rad * seconds_per_rad;
  ModeHistory history{Eigen::VectorXcd(n), Eigen::MatrixXcd::Zero(n, n), Eigen::RowVectorXcd(n)};
  for (Index i = 0; i < n; ++i) history.flow(i) = std::exp(pole * (grid.node_rad(i) * seconds_per_rad));
  double last_length = -1.0;
  ModeMoments moments;
  for (const CutElement& e : grid.elements) {
    const double length = (e.to_rad - e.from_rad) * seconds_per_rad;
    if (std::abs(length - last_length) > 1e-12 * length) {
      moments = shared_product_rule(e.nodes, std::abs(pole) * length).moments(pole * length);
      moments.inside *= length;
      moments.end *= length;
      last_length = length;
    }
    history.at_node.block(e.first_node, e.first_node, e.nodes, e.nodes) = moments.inside;
    const double end = e.to_rad * seconds_per_rad;
    for (Index i = e.first_node + e.nodes; i < n; ++i) {
      history.at_node.row(i).segment(e.first_node, e.nodes) =
          std::exp(pole * (grid.node_rad(i) * seconds_per_rad - end)) * moments.end;
    }
    history.at_end.segment(e.first_node, e.nodes) = std::exp(pole * (period - end)) * moments.end;
  }
  return history;
}

/// A row of the contacts' displacement: `chip` at a node.
struct Seen {
  Index row;
  int node;
  double weight;
};

/// Which nodes each contact sees in this period (its own, less the past within it), and in the previous one.
struct Sight {
  std::vector<Seen> now, before;
};

Sight sight(const ContactGrid& grid) {
  Sight result;
  for (std::size_t k = 0; k < grid.contacts.size(); ++k) {
    const auto row = static_cast<Index>(k);
    result.now.push_back({row, grid.contacts[k].node, 1.0});
    for (const Past& past : grid.contacts[k].past) {
      if (past.previous_period) result.before.push_back({row, past.node, past.weight});
      else result.now.push_back({row, past.node, -past.weight});
    }
  }
  return result;
}

void add_mode(const RelativeStructure& structure, Index k, const ContactGrid& grid, const std::vector<Seen>& seen,
              const ModeHistory& history, const Eigen::RowVectorXcd& modal_force, double share, Eigen::MatrixXcd& E,
              Eigen::MatrixXd& K) {
  const Index contacts = K.cols();
  for (const Seen& s : seen) {
    const auto& chip = grid.contacts[static_cast<std::size_t>(s.row)].chip;
    const complex<double> motion = s.weight * (chip.transpose() * structure.phi.col(k)).value();
    E(s.row, k) += motion * history.flow(s.node);
    for (Index l = 0; l < contacts; ++l) {
      const int from = grid.contacts[static_cast<std::size_t>(l)].node;
      K(s.row, l) += 2.0 * share * (motion * history.at_node(s.node, from) * modal_force(l)).real();
    }
  }
}

void add_residual(const RelativeStructure& structure, const ContactGrid& grid, const std::vector<Seen>& seen,
                  Eigen::MatrixXd& K) {
  if (structure.R.isZero(0.0)) return;
  for (const Seen& s : seen) {
    const Eigen::RowVector3d row =
        s.weight * grid.contacts[static_cast<std::size_t>(s.row)].chip.transpose() * structure.R;
    for (Index l = 0; l < K.cols(); ++l) {
      const Contact& from = grid.contacts[static_cast<std::size_t>(l)];
      if (from.node == s.node) K(s.row, l) += row * from.force;
    }
  }
}

const Eigen::MatrixXcd& before(const Eigen::MatrixXcd& now, const Eigen::MatrixXcd& previous) {
  return previous.size() > 0 ? previous : now;
}
const Eigen::MatrixXd& before(const Eigen::MatrixXd& now, const Eigen::MatrixXd& previous) {
  return previous.size() > 0 ? previous : now;
}

}  // namespace

RegenerativeLoop regenerative_loop(const RelativeStructure& structure, const ContactGrid& grid,
                                   double spindle_speed_rpm) {
  const double seconds_per_rad = 30.0 / (std::numbers::pi * spindle_speed_rpm);
  const Index poles = structure.poles.size();
  const auto contacts = static_cast<Index>(grid.contacts.size());
  RegenerativeLoop loop;
  loop.period_s = grid.period_rad * seconds_per_rad;
  loop.flow = (structure.poles * loop.period_s).array().exp();
  loop.share = structure.poles.imag().unaryExpr([](double w) { return w != 0.0 ? 1.0 : 0.5; });
  loop.E = Eigen::MatrixXcd::Zero(contacts, poles);
  loop.K = Eigen::MatrixXd::Zero(contacts, contacts);
  loop.L.resize(poles, contacts);
  if (!grid.one_delay) {
    loop.E_previous = loop.E;
    loop.K_previous = loop.K;
  }
  const Sight seen = sight(grid);
  Eigen::RowVectorXcd modal_force(contacts);
  for (Index k = 0; k < poles; ++k) {
    const ModeHistory history = mode_history(structure.poles(k), grid, seconds_per_rad);
    for (Index l = 0; l < contacts; ++l) {
      const Contact& c = grid.contacts[static_cast<std::size_t>(l)];
      modal_force(l) = (c.force.transpose() * structure.b.col(k)).value();
      loop.L(k, l) = history.at_end(c.node) * modal_force(l);
    }
    add_mode(structure, k, grid, seen.now, history, modal_force, loop.share(k), loop.E, loop.K);
    if (!grid.one_delay)
      add_mode(structure, k, grid, seen.before, history, modal_force, loop.share(k), loop.E_previous, loop.K_previous);
  }
  add_residual(structure, grid, seen.now, loop.K);
  if (!grid.one_delay) add_residual(structure, grid, seen.before, loop.K_previous);
  return loop;
}

Eigen::MatrixXd period_map(const RegenerativeLoop& loop, double depth_m) {
  const Index poles = loop.flow.size();
  const Index contacts = loop.K.rows();
  const Index states = poles + (loop.share.array() == 1.0).count();
  // Real columns and rows of the modes: Re z of all, Im z of pairs.
  Eigen::MatrixXd E(contacts, states), E_previous(contacts, states), L(states, contacts);
  Eigen::MatrixXd map = Eigen::MatrixXd::Zero(states + contacts, states + contacts);
  const Eigen::MatrixXcd& E_before = before(loop.E, loop.E_previous);
  Index im = poles;
  for (Index k = 0; k < poles; ++k) {
    const double twice = 2.0 * loop.share(k);
    E.col(k) = twice * loop.E.col(k).real();
    E_previous.col(k) = twice * E_before.col(k).real();
    L.row(k) = loop.L.row(k).real();
    map(k, k) = loop.flow(k).real();
    if (loop.share(k) != 1.0) continue;
    E.col(im) = -twice * loop.E.col(k).imag();
    E_previous.col(im) = -twice * E_before.col(k).imag();
    L.row(im) = loop.L.row(k).imag();
    map(im, im) = loop.flow(k).real();
    map(im, k) = loop.flow(k).imag();
    map(k, im) = -loop.flow(k).imag();
    ++im;
  }
  // c = (I + wK)⁻¹ (E z − h)
  Eigen::MatrixXd c(contacts, states + contacts);
  c << E, -Eigen::MatrixXd::Identity(contacts, contacts);
  const Eigen::MatrixXd system = Eigen::MatrixXd::Identity(contacts, contacts) + depth_m * loop.K;
  c = Eigen::PartialPivLU<Eigen::MatrixXd>(system).solve(c).eval();
  map.topRows(states).noalias() -= depth_m * (L * c);
  map.bottomLeftCorner(contacts, states) = E_previous;
  map.bottomRows(contacts).noalias() -= depth_m * (before(loop.K, loop.K_previous) * c);
  return map;
}

Eigen::MatrixXcd loop_gain(const RegenerativeLoop& loop, complex<double> mu) {
  const complex<double> past = 1.0 / mu;
  const Eigen::VectorXcd gain = loop.share.array() / (mu - loop.flow.array());
  const Eigen::VectorXcd conjugate_gain = loop.share.array() / (mu - loop.flow.conjugate().array());
  Eigen::MatrixXcd Z;
  if (loop.K_previous.size() == 0) {
    Z = loop.K.cast<complex<double>>();
    Z.noalias() += loop.E * (gain.asDiagonal() * loop.L);
    Z.noalias() += loop.E.conjugate() * (conjugate_gain.asDiagonal() * loop.L.conjugate());
    Z *= 1.0 - past;
  } else {
    Z = loop.K.cast<complex<double>>() - past * loop.K_previous;
    Z.noalias() += (loop.E - past * loop.E_previous) * (gain.asDiagonal() * loop.L);
    Z.noalias() +=
        (loop.E.conjugate() - past * loop.E_previous.conjugate()) * (conjugate_gain.asDiagonal() * loop.L.conjugate());
  }
  return Z;
}

Eigen::MatrixXcd loop_gain_slope(const RegenerativeLoop& loop, complex<double> mu) {
  // dZ/dμ = K⁻/μ² + Σ (E − E⁻/μ) g' L + Σ E⁻ (g/μ²) L + the same of the conjugates, g = share/(μ − Φ)
  const complex<double> past = 1.0 / mu;
  const Eigen::MatrixXcd& E_before = before(loop.E, loop.E_previous);
  Eigen::MatrixXcd slope = past * past * before(loop.K, loop.K_previous).cast<complex<double>>();
  const auto add = [&](const auto& flow, const auto& E, const auto& E_past, const auto& L) {
    const Eigen::ArrayXcd resonance = 1.0 / (mu - flow.array());
    const Eigen::ArrayXcd g = loop.share.array() * resonance;
    const Eigen::ArrayXcd g_slope = -g * resonance;
    if (loop.E_previous.size() == 0) {
      slope.noalias() += E * (((1.0 - past) * g_slope + past * past * g).matrix().asDiagonal() * L);
    } else {
      slope.noalias() += E * (g_slope.matrix().asDiagonal() * L);
      slope.noalias() += E_past * ((past * past * g - past * g_slope).matrix().asDiagonal() * L);
    }
  };
  add(loop.flow, loop.E, E_before, loop.L);
  add(loop.flow.conjugate(), loop.E.conjugate(), E_before.conjugate(), loop.L.conjugate());
  return complex<double>(0.0, 1.0) * mu * slope;
}

}  // namespace thinwall::milling
