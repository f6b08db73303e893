#include "milling/classical/multi_frequency.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/gauss_rule.hpp"
#include "milling/direct/critical_depths.hpp"
#include "milling/direct/row_search.hpp"

namespace thinwall::milling {

namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using std::complex;

using std::numbers::pi;
constexpr complex<double> i_unit(0.0, 1.0);

/// dG/dω.
Eigen::Matrix3cd receptance_slope(const RelativeStructure& s, double omega) {
  Eigen::Matrix3cd slope = Eigen::Matrix3cd::Zero();
  for (Index k = 0; k < s.poles.size(); ++k) {
    const Eigen::Matrix3cd residue = s.phi.col(k) * s.b.col(k).transpose();
    slope -= i_unit * residue / std::pow(i_unit * omega - s.poles(k), 2);
    if (s.poles(k).imag() != 0.0)
      slope -= i_unit * residue.conjugate() / std::pow(i_unit * omega - std::conj(s.poles(k)), 2);
  }
  return slope;
}

/// The terms of which the gain is made at any angle.
struct HarmonicLoop {
  RelativeStructure structure;
  Eigen::Matrix3Xd yielding;
  double period_s = 0.0;
  Index first = 0;     ///< the lowest harmonic, −K − 1
  MatrixXcd to_times;  ///< harmonics to values at equal times, unitary
  MatrixXcd force;     ///< 3 harmonics × p times: Â after the way back

  [[nodiscard]] Index count() const { return -2 * first; }

  /// Z, from one receptance a harmonic in front of the force, in the basis of equal times.
  [[nodiscard]] MatrixXcd gain(double theta) const {
    const Index p = yielding.cols();
    MatrixXcd motion(p * count(), force.cols());
    for (Index k = 0; k < count(); ++k) {
      const double omega = (theta + 2.0 * pi * static_cast<double>(first + k)) / period_s;
      motion.middleRows(p * k, p).noalias() =
          (yielding.transpose() * receptance(structure, omega)) * force.middleRows(3 * k, 3);
    }
    return (1.0 - std::polar(1.0, -theta)) * (to_times * motion);
  }
  /// lᵀ (dZ/dθ) r.
  [[nodiscard]] complex<double> slope(double theta, const Eigen::VectorXcd& l, const Eigen::VectorXcd& r) const {
    const complex<double> past = std::polar(1.0, -theta);
    const Eigen::VectorXcd seen = to_times.transpose() * l, acting = force * r;
    const Index p = yielding.cols();
    complex<double> sum = 0.0;
    for (Index k = 0; k < count(); ++k) {
      const double omega = (theta + 2.0 * pi * static_cast<double>(first + k)) / period_s;
      const Eigen::Matrix3cd change =
          i_unit * past * receptance(structure, omega) + (1.0 - past) / period_s * receptance_slope(structure, omega);
      sum += ((yielding * seen.segment(p * k, p)).transpose() * change * acting.segment(3 * k, 3)).value();
    }
    return sum;
  }
};

GainOnCircle gain_of(const std::shared_ptr<const HarmonicLoop>& loop) {
  return {
      loop->to_times.rows(), [loop](double theta) { return loop->gain(theta); },
      [loop](double theta, const Eigen::VectorXcd& l, const Eigen::VectorXcd& r) { return loop->slope(theta, l, r); },
      stops_between((loop->structure.poles * loop->period_s).array().exp())};
}

/// Values at N equal times of harmonics k + ½, which are real for k and −1 − k alike; p of each.
MatrixXcd equal_times(Index first, Index p) {
  const Index count = -2 * first;
  MatrixXcd U = MatrixXcd::Zero(p * count, p * count);
  for (Index j = 0; j < count; ++j) {
    for (Index k = 0; k < count; ++k) {
      const double phase =
          2.0 * pi * (static_cast<double>(first + k) + 0.5) * static_cast<double>(j) / static_cast<double>(count);
      U.block(p * j, p * k, p, p)
          .diagonal()
          .setConstant(std::polar(1.0 / std::sqrt(static_cast<double>(count)), phase));
    }
  }
  return U;
}

HarmonicLoop harmonic_loop(const CutAtSpeed& cut, const std::vector<Eigen::Matrix3cd>& harmonics, double depth_m) {
  HarmonicLoop loop;
  loop.structure = cut.structure;
  loop.yielding = cut.yielding;
  loop.period_s = tooth_period_s(cut.process.cutter, cut.spindle_speed_rpm);
  const double fastest = fastest_that_matters(cut, harmonics.front().norm(), depth_m);
  const auto h = static_cast<Index>(harmonics.size()) - 1;
  loop.first = -1 - h - static_cast<Index>(std::ceil(2.0 * fastest * loop.period_s / (2.0 * pi)));
  const Index p = cut.yielding.cols();
  if (p * loop.count() > 1200) {
    throw core::InputError("multi-frequency solution: " + std::to_string(p * loop.count()) +
                           " unknowns at the slowest speed, must be at most 1200; take the direct method, or a higher "
                           "speed");
  }
  MatrixXcd A = MatrixXcd::Zero(3 * loop.count(), p * loop.count());
  for (Index k = 0; k < loop.count(); ++k) {
    for (Index l = std::max<Index>(0, k - h); l < std::min(loop.count(), k + h + 1); ++l) {
      const Eigen::Matrix3cd& A_r = harmonics[static_cast<std::size_t>(std::abs(k - l))];
      A.block(3 * k, p * l, 3, p) = (k < l ? Eigen::Matrix3cd(A_r.conjugate()) : A_r) * cut.yielding;
    }
  }
  loop.to_times = equal_times(loop.first, p);
  loop.force = A * loop.to_times.adjoint();
  return loop;
}

/// The cut of these harmonics at Gauss nodes over the whole period: each direction that yields is a contact.
ContactGrid harmonic_grid(const CutAtSpeed& cut, const std::vector<Eigen::Matrix3cd>& harmonics, Resolution r) {
  ContactGrid grid;
  grid.period_rad = cut.process.cutter.pitch_rad();
  grid.node_rad.resize(Index{r.elements} * r.nodes);
  const core::GaussRule rule = core::gauss_legendre(r.nodes);
  const double length = grid.period_rad / r.elements;
  for (int e = 0; e < r.elements; ++e) {
    grid.elements.push_back({e * length, (e + 1) * length, e * r.nodes, r.nodes});
    for (int i = 0; i < r.nodes; ++i) {
      const int node = e * r.nodes + i;
      const double theta = (e + rule.node(i)) * length;
      grid.node_rad(node) = theta;
      Eigen::Matrix3d A = harmonics.front().real();
      for (std::size_t k = 1; k < harmonics.size(); ++k)
        A += 2.0 * (harmonics[k] * std::polar(1.0, 2.0 * pi * static_cast<double>(k) * theta / grid.period_rad)).real();
      for (Index d = 0; d < cut.yielding.cols(); ++d)
        grid.contacts.push_back(
            {node, A * cut.yielding.col(d), cut.yielding.col(d), {{node, true, cut.yielding.col(d)}}});
    }
  }
  return grid;
}

/// The harmonic of the largest motion, Hz.
double chatter_frequency(const HarmonicLoop& loop, const Crossing& crossing) {
  const Index p = loop.yielding.cols();
  const Eigen::VectorXcd q = loop.to_times.adjoint() * crossing.mode;
  Index largest = 0;
  Eigen::Map<const MatrixXcd>(q.data(), p, loop.count()).colwise().norm().maxCoeff(&largest);
  return std::abs(crossing.theta_rad / (2.0 * pi) + static_cast<double>(loop.first + largest)) / loop.period_s;
}

}  // namespace

std::vector<Eigen::Matrix3cd> directional_harmonics(const MillingProcess& process, int highest) {
  MillingProcess straight = process;
  straight.cutter.helices_rad.clear();
  if (!equal_teeth(process) || !elementary(straight)) {
    throw core::InputError(
        "zeroth-order and multi-frequency solution: equal teeth on a cylinder, one arc, no process damping; take the "
        "direct method for this cut");
  }
  // Gauss's rule of 16 nodes is exact to round-off for the product of A and a harmonic over 8 rad of phase.
  const double fastest = 2.0 + highest * process.cutter.teeth;
  const int elements = static_cast<int>(std::ceil(longest_stretch_rad(process) * fastest / 8.0));
  const ContactGrid grid = contact_grid(process, Eigen::Matrix3d::Identity(), {elements, 16});
  std::vector<Eigen::Matrix3cd> harmonics(static_cast<std::size_t>(highest) + 1, Eigen::Matrix3cd::Zero());
  for (const EdgeContact& c : grid.contacts) {
    const auto e = std::find_if(grid.elements.begin(), grid.elements.end(),
                                [&](const CutElement& x) { return c.node < x.first_node + x.nodes; });
    const double share =
        core::gauss_legendre(e->nodes).weight(c.node - e->first_node) * (e->to_rad - e->from_rad) / grid.period_rad;
    const double turn = 2.0 * pi * grid.node_rad(c.node) / grid.period_rad;
    for (std::size_t r = 0; r < harmonics.size(); ++r)
      harmonics[r] += std::polar(share, -static_cast<double>(r) * turn) * (c.force * c.chip.transpose());
  }
  return harmonics;
}

GainOnCircle multi_frequency_gain(const CutAtSpeed& cut, const std::vector<Eigen::Matrix3cd>& harmonics,
                                  double depth_m) {
  return gain_of(std::make_shared<const HarmonicLoop>(harmonic_loop(cut, harmonics, depth_m)));
}

Multiplier harmonic_multiplier(const CutAtSpeed& cut, const std::vector<Eigen::Matrix3cd>& harmonics, double depth_m,
                               const StabilityOptions& options) {
  const double period = tooth_period_s(cut.process.cutter, cut.spindle_speed_rpm);
  const double phase = fastest_that_matters(cut, harmonics.front().norm(), depth_m) * period +
                       2.0 * pi * static_cast<double>(harmonics.size() - 1);
  const int elements = std::max(1, static_cast<int>(std::ceil(phase / 14.0)));
  Resolution r{elements, static_cast<int>(std::ceil(4.0 + 0.5 * phase / elements))};
  Multiplier result;
  double change = 1.0;
  for (int level = 0;; ++level, r = finer(r)) {
    DiscreteCut d{harmonic_grid(cut, harmonics, r), {}};
    d.loop = regenerative_loop(cut.structure, d.grid, cut.spindle_speed_rpm);
    const Eigen::VectorXcd all = multipliers(d, depth_m);
    Index largest = 0;
    const double modulus = all.cwiseAbs().maxCoeff(&largest);
    const double change_before = std::exchange(change, std::abs(result.modulus / modulus - 1.0));
    result.modulus = modulus;
    result.nodes = r.elements * r.nodes;
    result.error_estimate = estimate_from(change, change_before);
    const bool enough = level > 1 && result.error_estimate <= options.error_tolerance;
    if (!enough && 3 * result.nodes < 2 * options.most_nodes) continue;
    result.value = {all(largest).real(), std::abs(all(largest).imag())};
    result.status = enough ? StabilityStatus::converged : StabilityStatus::node_limit_reached;
    result.kind = bifurcation_of(result.value);
    result.chatter_frequency_hz =
        chatter_frequency_hz(cut, d.grid, std::arg(result.value), modulation(d, depth_m, result.value * (1.0 + 1e-9)));
    return result;
  }
}

FoundCrossings multi_frequency_crossings(const CutAtSpeed& cut, int harmonics, const StabilityOptions& options) {
  const double depth = std::min(options.depth_limit_m, 8.0 * surely_stable_depth_m(cut));
  const auto loop =
      std::make_shared<const HarmonicLoop>(harmonic_loop(cut, directional_harmonics(cut.process, harmonics), depth));
  const GainOnCircle other =
      multi_frequency_gain(cut, directional_harmonics(cut.process, harmonics == 0 ? 1 : harmonics / 2), depth);
  FoundCrossings found;
  found.nodes = harmonics;
  FirstCrossing first = first_crossing(gain_of(loop), options);
  found.searched_m = follow(first, options);
  for (const Crossing& crossing : first.found) {
    Crossing coarse = crossing;
    const bool kept = to_axis(other, 1.0 / crossing.depth_m, coarse);
    const double estimate = kept ? std::min(1.0, 1e-11 + 2.0 * std::abs(coarse.depth_m / crossing.depth_m - 1.0)) : 1.0;
    found.points.push_back({crossing.depth_m, chatter_frequency(*loop, crossing), bifurcation_at(crossing.theta_rad),
                            crossing.unstable_change, estimate});
  }
  return found;
}

}  // namespace thinwall::milling
