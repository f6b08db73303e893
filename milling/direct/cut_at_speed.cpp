#include "milling/direct/cut_at_speed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "linalg/real_eigenvalues.hpp"
#include "milling/cut/edge.hpp"
#include "milling/direct/chatter_frequency.hpp"
#include "milling/direct/dominant_eigenvalue.hpp"
#include "milling/direct/vanishing_powers.hpp"

namespace thinwall::milling {

namespace {

using Eigen::Index;
using std::complex;

/// ‖mean directional matrix‖ over a turn at a depth, the arcs' added up, N/m².
double mean_stiffness(const MillingProcess& process, double depth_m) {
  double sum = 0.0;
  for (const Engagement& arc : arcs(process))
    sum += process.cutter.teeth * arc.arc_rad() / (2.0 * std::numbers::pi) * arc_mean(process, arc, depth_m).norm();
  return sum;
}

/// ‖φ‖ ‖b‖ / |Re λ| of each mode, m/N.
Eigen::ArrayXd peaks(const RelativeStructure& s) {
  return s.phi.colwise().norm().transpose().array() * s.b.colwise().norm().transpose().array() /
         s.poles.real().cwiseAbs().array();
}

constexpr double nodes_per_rad = 0.35;  // that resolve a wave
constexpr double error_over_gain =
    0.005;  // of a mode that is not resolved, times the share of the cut in which it swings

/// The loop gain 2 w ‖D̄‖ ‖φ‖ ‖b‖ / |Re λ| of each mode at its resonance; `stiffness` is ‖D̄‖.
Eigen::ArrayXd loop_gains(const CutAtSpeed& cut, double stiffness, double depth_m) {
  return 2.0 * depth_m * stiffness * peaks(cut.structure);
}

/// The loop gain of each mode by itself or with one that is so close that both swing at one frequency, whichever is
/// more,
///
///     √(g_jk g_kj),      g_jk = 2 w/T ∫ |b_jᵀ D φ_k| dt / |Re λ_j|,
///
/// as the teeth push a mode by b and feel it by φ at the same moment: no harmonic of its stiffness exceeds the mean of
/// the modulus. The mean of D on a short piece of an arc stands for D there.
Eigen::ArrayXd own_gains(const CutAtSpeed& cut, double depth_m) {
  constexpr int pieces = 8;  // of an arc
  const RelativeStructure& s = cut.structure;
  const Index modes = s.poles.size();
  Eigen::ArrayXXd g = Eigen::ArrayXXd::Zero(modes, modes);
  for (const Engagement& arc : arcs(cut.process)) {
    const double piece_rad = arc.arc_rad() / pieces;
    const double share = cut.process.cutter.teeth * piece_rad / (2.0 * std::numbers::pi);
    for (int i = 0; i < pieces; ++i) {
      const double from_rad = arc.entry_rad + i * piece_rad;
      const Eigen::Matrix3d D = share * arc_mean(cut.process, {from_rad, from_rad + piece_rad}, depth_m);
      g += (s.b.transpose() * (D * s.phi)).cwiseAbs2().cwiseSqrt().array();
    }
  }
  const Eigen::ArrayXd half_width = s.poles.real().array().abs();
  g.colwise() *= 2.0 * depth_m / half_width;
  Eigen::ArrayXd gains = g.matrix().diagonal().array();
  for (Index j = 0; j < modes; ++j) {
    for (Index k = 0; k < modes; ++k) {
      const bool close = std::abs(s.poles(j).imag() - s.poles(k).imag()) <= 2.0 * (half_width(j) + half_width(k));
      if (close) gains(j) = std::max(gains(j), std::sqrt(g(j, k) * g(k, j)));
    }
  }
  return gains;
}

/// |λ| of the fastest mode whose figure is at least so much, rad/s.
double fastest_of(const CutAtSpeed& cut, const Eigen::ArrayXd& figures, double least) {
  double fastest = 0.0;
  for (Index i = 0; i < figures.size(); ++i) {
    if (figures(i) >= least) fastest = std::max(fastest, std::abs(cut.structure.poles(i)));
  }
  return fastest;
}

/// The gain from which a mode is resolved: that with which it could regenerate, or a share of the highest gain.
double least_gain(const Eigen::ArrayXd& gains, double share) {
  constexpr double regenerates = 0.5;
  return std::min(share * gains.maxCoeff(), regenerates);
}

/// The grid that resolves a wave of this phase in the cut, rad.
Resolution of_wave(double phase_rad) {
  const int elements = std::max(1, static_cast<int>(std::ceil(phase_rad / 14.0)));
  return {elements, static_cast<int>(std::ceil(3.0 + nodes_per_rad * phase_rad / elements))};
}

/// The phase of a wave through the longest stretch of a tooth in the cut, rad.
double phase_in_cut(const CutAtSpeed& cut, double omega_rad_s, double depth_m) {
  return omega_rad_s * longest_stretch_rad(cut.process, depth_m) * 30.0 / (std::numbers::pi * cut.spindle_speed_rpm);
}

/// The errors that a grid would have for each mode if it did not resolve it: a tooth that enters excites the mode,
/// which swings for 1/|Re λ| of the stretch T in the cut; only this wave is missed, for motion that the teeth force at
/// lower frequencies is smooth.
Eigen::ArrayXd errors_if_unresolved(const CutAtSpeed& cut, double depth_m) {
  const double T = phase_in_cut(cut, 1.0, depth_m);
  const Eigen::ArrayXd swings = 1.0 / (T * cut.structure.poles.real().cwiseAbs().array());
  return error_over_gain * swings.min(1.0) * loop_gains(cut, mean_stiffness(cut.process, depth_m), depth_m);
}

/// The multipliers at a depth; none if the map is not finite or its eigenvalues do not settle. Within a long period,
/// as a revolution of a cutter with unequal pitches, chatter may grow by more than the digits of a double: I + wK is
/// then singular to round-off at all depths about.
std::optional<Eigen::VectorXcd> found_multipliers(const DiscreteCut& d, double depth_m) {
  core::check_interrupt();
  Eigen::MatrixXd map = period_map(d.loop, depth_m);
  // If I + wK is singular to round-off, a depth that a search may well come upon, a multiplier is infinite; a hair
  // beside it is large, and no other changes.
  constexpr double hair = 1e-9;
  if (!map.allFinite()) map = period_map(d.loop, (1.0 + hair) * depth_m);
  if (!map.allFinite()) return std::nullopt;
  return linalg::real_eigenvalues(std::move(map));
}

}  // namespace

CutAtSpeed cut_at_speed(const RelativeStructure& structure, const MillingProcess& process, double spindle_speed_rpm) {
  (void)tooth_period_s(process.cutter, spindle_speed_rpm);  // refuses a bad speed
  CutAtSpeed cut{in_tool_axes(structure, process.frame), process, {}, spindle_speed_rpm};
  const Envelope& envelope = process.cutter.envelope;
  cut.yielding = yielding_directions(cut.structure, !envelope.straight() || envelope.taper_rad != 0.0);
  return cut;
}

DiscreteCut discrete(const CutAtSpeed& cut, Resolution resolution, double depth_m) {
  DiscreteCut d{contact_grid(cut.process, cut.yielding, resolution, depth_m), {}};
  d.loop = regenerative_loop(cut.structure, d.grid, cut.spindle_speed_rpm);
  return d;
}

GainOnCircle gain_of(const DiscreteCut& d) {
  return {d.loop.K.rows(), [&d](double theta) { return loop_gain(d.loop, on_circle(theta)); },
          [&d](double theta, const Eigen::VectorXcd& l, const Eigen::VectorXcd& r) {
            return loop_gain_slope(d.loop, on_circle(theta), l, r);
          },
          stops_between(d.loop.flow)};
}

double fastest_that_matters(const CutAtSpeed& cut, double stiffness, double depth_m) {
  constexpr double share = 0.05;
  const Eigen::ArrayXd gains = loop_gains(cut, stiffness, depth_m);
  if (gains.size() == 0) return 0.0;  // all that yields is a static compliance
  return fastest_of(cut, gains, least_gain(gains, share));
}

Resolution resolving(const CutAtSpeed& cut, double depth_m) {
  return of_wave(phase_in_cut(cut, fastest_that_matters(cut, mean_stiffness(cut.process, depth_m), depth_m), depth_m));
}

Resolution resolving_alone(const CutAtSpeed& cut, double depth_m) {
  constexpr double share = 0.2;
  const Eigen::ArrayXd gains = own_gains(cut, depth_m);
  if (gains.size() == 0) return of_wave(0.0);
  return of_wave(phase_in_cut(cut, fastest_of(cut, gains, least_gain(gains, share)), depth_m));
}

Resolution searching(const CutAtSpeed& cut, double depth_m) {
  return cut.process.cutter.depends_on_depth() ? resolving_alone(cut, depth_m) : resolving(cut, depth_m);
}

double unresolved(const CutAtSpeed& cut, Resolution resolution, double depth_m) {
  depth_m = std::min(depth_m, cut.process.cutter.envelope.height_m);  // a search goes a little beyond
  const Eigen::ArrayXd errors = errors_if_unresolved(cut, depth_m);
  const double resolved_rad = resolution.elements * resolution.nodes / nodes_per_rad;
  double largest = 0.0;
  for (Index i = 0; i < errors.size(); ++i) {
    const double r = phase_in_cut(cut, std::abs(cut.structure.poles(i)), depth_m) / resolved_rad;
    if (r > 1.0) largest = std::max(largest, errors(i) * std::min(1.0, std::exp(10.0 * (r - 1.4))));
  }
  return largest;
}

Resolution estimating(const CutAtSpeed& cut, double depth_m, const StabilityOptions& options) {
  constexpr double share = 0.25;  // of the tolerance, that modes which are not resolved may take
  const double fastest = fastest_of(cut, errors_if_unresolved(cut, depth_m), share * options.error_tolerance);
  const double phase = phase_in_cut(cut, fastest, depth_m);
  const int elements = std::max(1, static_cast<int>(std::ceil(phase / 20.0)));
  const int nodes = std::max(5, static_cast<int>(std::ceil(nodes_per_rad * phase / elements)));
  return {std::min(elements, std::max(1, options.most_nodes / nodes)), nodes};
}

bool coarser(Resolution a, Resolution b) {
  return a.elements * a.nodes < b.elements * b.nodes;
}

Resolution finer(Resolution r) {
  return r.nodes < 14 ? Resolution{r.elements, r.nodes + 3} : Resolution{2 * r.elements, r.nodes - 3};
}

Resolution finer(Resolution r, Resolution least) {
  const Resolution next = finer(r);
  return coarser(next, least) ? least : next;
}

double surely_stable_depth_m(const CutAtSpeed& cut) {
  const double peak = peaks(cut.structure).sum();
  double depth = std::min(cut.process.cutter.envelope.height_m, 1e-3);
  if (!cut.process.cutter.envelope.straight()) {
    // Towards the tip of a ball the mean grows as 1/√depth, so that these steps halve the error's logarithm.
    for (int i = 0; i < 12; ++i)
      depth = std::min(cut.process.cutter.envelope.height_m, 0.25 / (mean_stiffness(cut.process, depth) * peak));
  }
  return 0.25 / (mean_stiffness(cut.process, depth) * peak);
}

Eigen::VectorXcd multipliers(const DiscreteCut& d, double depth_m) {
  if (const std::optional<Eigen::VectorXcd> found = found_multipliers(d, depth_m)) return *found;
  throw core::NumericalError("stability: the multipliers at a depth of " + std::to_string(depth_m) +
                             " m were not found; check the structure at the cut, or ask for smaller depths");
}

int unstable(const DiscreteCut& d, double depth_m) {
  const std::optional<Eigen::VectorXcd> found = found_multipliers(d, depth_m);
  if (!found) return std::numeric_limits<int>::max();
  return static_cast<int>((found->cwiseAbs().array() > 1.0).count());
}

bool exceeds(const DiscreteCut& d, double depth_m, double modulus) {
  constexpr double tolerance = 1e-6;
  const Eigen::MatrixXd map = period_map(d.loop, depth_m);
  if (map.allFinite()) {
    const auto product = [&map](const Eigen::Ref<const Eigen::VectorXd>& in, Eigen::Ref<Eigen::VectorXd> out) {
      core::check_interrupt();
      out.noalias() = map * in;
    };
    const DominantEigenvalue largest = dominant_eigenvalue(product, map.rows(), tolerance);
    if (largest.converged) return std::abs(largest.value) > modulus;
  }
  const std::optional<Eigen::VectorXcd> found = found_multipliers(d, depth_m);
  return !found || (found->cwiseAbs().array() > modulus).any();
}

bool stable(const DiscreteCut& d, double depth_m) {
  return powers_vanish(period_map(d.loop, depth_m)) || unstable(d, depth_m) == 0;
}

double chatter_frequency_hz(const CutAtSpeed& cut, const ContactGrid& grid, double theta, const Eigen::VectorXcd& c) {
  double fastest = 0.0;
  for (const complex<double> pole : cut.structure.poles) fastest = std::max(fastest, std::abs(pole));
  const auto at = [&](double omega) { return receptance(cut.structure, omega); };
  const double period_s = grid.period_rad * 30.0 / (std::numbers::pi * cut.spindle_speed_rpm);
  return chatter_frequency_hz(grid, period_s, at, 1.5 * fastest, theta, c);
}

Eigen::VectorXcd modulation(const DiscreteCut& d, double depth_m, complex<double> mu) {
  Eigen::MatrixXcd loop = depth_m * loop_gain(d.loop, mu);
  loop.diagonal().array() += 1.0 + 1e-10;
  const Eigen::PartialPivLU<Eigen::MatrixXcd> lu(loop);
  Eigen::VectorXcd c = Eigen::VectorXcd::Ones(loop.rows());
  for (int i = 0; i < 3; ++i) c = lu.solve(c).normalized().eval();
  return c;
}

}  // namespace thinwall::milling
