#include "milling/cut/step_coefficients.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/gauss_rule.hpp"
#include "milling/cut/cut_cycle.hpp"
#include "milling/cut/edge.hpp"
#include "milling/cut/product_rule.hpp"

namespace thinwall::milling {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// The cut while its steps are filled.
struct SteppedCut {
  CutCycle cycle;
  EdgeShape shape;
  const Eigen::Matrix2Xd& in_plane;
  double step_rad = 0.0;
  Eigen::VectorXd height = {};  ///< at which a delay that changes along the edge is taken, shares of the depth
  StepCoefficients result = {};
};

std::vector<MatrixXd>& delayed_by(double delay_rad, SteppedCut& cut) {
  const double delay = delay_rad / cut.step_rad;
  for (DelayedTerm& term : cut.result.delayed) {
    if (std::abs(term.delay - delay) < 1e-9 * delay) return term.coefficient;
  }
  const std::vector<MatrixXd> nothing(cut.result.present.size(), MatrixXd::Zero(3, cut.in_plane.cols()));
  cut.result.delayed.push_back({delay, nothing});
  return cut.result.delayed.back().coefficient;
}

/// An edge with one delay, s rad after its tip entered.
void add_edge(const Sweep& sweep, double s, double weight, std::size_t slot, SteppedCut& cut) {
  const Heights h = heights_in_cut(sweep, s);
  const Eigen::Matrix3d D =
      edge_matrix(cut.shape, sweep.coefficients, sweep.entry_phi_rad + s, sweep.lag_rad, h.low, h.high);
  const MatrixXd A = weight * D.leftCols<2>() * cut.in_plane;
  cut.result.present[slot] += A;
  delayed_by(sweep.pitch_rad, cut)[slot] += A;
}

/// An edge whose delay changes along it.
void add_edge_of_many_delays(const Sweep& sweep, double s, double weight, std::size_t slot, SteppedCut& cut) {
  const Heights h = heights_in_cut(sweep, s);
  const int points = 8 + static_cast<int>(std::ceil(2.0 * sweep.lag_rad * (h.high - h.low)));
  for (const EdgeWeight& e : edge_weights(cut.shape, points, h.low, h.high)) {
    const Eigen::Matrix3d D =
        directional_matrix_on(sweep.coefficients, e.kappa_rad, sweep.entry_phi_rad + s - e.height * sweep.lag_rad);
    const MatrixXd A = weight * e.weight * D.leftCols<2>() * cut.in_plane;
    cut.result.present[slot] += A;
    const Eigen::VectorXd share = lagrange_polynomials(cut.height, e.height);
    for (Index k = 0; k < share.size(); ++k) {
      delayed_by(sweep.delay_rad(cut.height(k)), cut)[slot] += share(k) * A;
    }
  }
}

/// All edges in the cut at a moment, rotation since the start of the cycle, which repeats itself.
void add_moment(double theta, double weight, std::size_t slot, SteppedCut& cut) {
  for (const Sweep& sweep : cut.cycle.sweeps) {
    each_pass(cut.cycle, sweep, theta, [&](double s) {
      if (sweep.one_delay()) add_edge(sweep, s, weight, slot, cut);
      else add_edge_of_many_delays(sweep, s, weight, slot, cut);
    });
  }
}

/// The mean over a step that begins `from` < period, Gauss's sum over what it shares with each smooth stretch.
void add_mean(double from, const core::GaussRule& gauss, const std::vector<CutStretch>& stretches, std::size_t slot,
              SteppedCut& cut) {
  for (const double later : {0.0, cut.cycle.period_rad}) {
    for (const CutStretch& s : stretches) {
      const double begin = std::max(from, s.from_rad + later);
      const double length = std::min(from + cut.step_rad, s.to_rad + later) - begin;
      if (length <= 0.0) continue;
      for (Index q = 0; q < gauss.node.size(); ++q)
        add_moment(begin + gauss.node(q) * length, gauss.weight(q) * length / cut.step_rad, slot, cut);
    }
  }
}

}  // namespace

StepRule semi_discretization(int order) {
  return {false, 0, order};
}

StepRule full_discretization(int order) {
  return {true, order, 1};
}

bool regenerates_in_plane(const MillingProcess& process) {
  const Envelope& envelope = process.cutter.envelope;
  return envelope.straight() && envelope.taper_rad == 0.0 && process.damping.C == 0.0;
}

StepCoefficients step_coefficients(const MillingProcess& process, const Eigen::Matrix2Xd& in_plane, int steps,
                                   StepRule rule, double depth_m) {
  if (!regenerates_in_plane(process)) {
    throw core::InputError(
        "semi- and full-discretization: a cylinder without process damping, this cut has more; take the direct method");
  }
  SteppedCut cut{cut_cycle(process, depth_m), edge_shape(process.cutter, depth_m), in_plane};
  cut.step_rad = cut.cycle.period_rad / steps;
  cut.height = core::gauss_legendre(6).node;
  cut.result.present.assign(static_cast<std::size_t>(rule.full ? 2 * steps : steps),
                            MatrixXd::Zero(3, in_plane.cols()));
  const std::vector<CutStretch> stretches = cut_stretches(cut.cycle);
  const core::GaussRule gauss = core::gauss_legendre(4 + static_cast<int>(std::ceil(6.0 * cut.step_rad)));
  constexpr double inside = 1e-9;
  for (int i = 0; i < steps; ++i) {
    // The cycle starts when the first tooth enters.
    const double after_entry = i * cut.step_rad - process.engagement.entry_rad;
    const double from = after_entry - cut.cycle.period_rad * std::floor(after_entry / cut.cycle.period_rad);
    const auto slot = static_cast<std::size_t>(i);
    if (rule.full) {
      add_moment(from + inside * cut.step_rad, 1.0, 2 * slot, cut);
      add_moment(from + (1.0 - inside) * cut.step_rad, 1.0, 2 * slot + 1, cut);
    } else {
      add_mean(from, gauss, stretches, slot, cut);
    }
  }
  return cut.result;
}

}  // namespace thinwall::milling
