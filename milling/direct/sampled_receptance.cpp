#include "milling/direct/sampled_receptance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/error.hpp"
#include "milling/cut/product_rule.hpp"

namespace thinwall::milling {

namespace {

using Eigen::Index;
using std::complex;

using std::numbers::pi;

/// ∫ e^{−iω s} ℓ_j(s) ds over each element's polynomials, s from the start of the period; one a node.
Eigen::VectorXcd node_moments(const ContactGrid& grid, const std::vector<ProductRule>& rules, double seconds_per_rad,
                              double omega) {
  Eigen::VectorXcd moments(grid.node_rad.size());
  for (std::size_t e = 0; e < grid.elements.size(); ++e) {
    const CutElement& element = grid.elements[e];
    const double length = (element.to_rad - element.from_rad) * seconds_per_rad;
    const complex<double> turn = std::polar(length, -omega * element.to_rad * seconds_per_rad);
    moments.segment(element.first_node, element.nodes) = turn * rules[e].end({0.0, omega * length}).transpose();
  }
  return moments;
}

/// Angles where e^{iωT} of a resonance and its neighbours within the half-power width lie on the half circle.
void add_aliases(const Resonance& r, double period_s, std::vector<double>& stops) {
  for (const double off : {-3.0, -1.5, -0.75, -0.35, 0.0, 0.35, 0.75, 1.5, 3.0}) {
    const double turns = (r.frequency_hz + off * r.half_width_hz) * period_s;
    const double theta = 2.0 * pi * std::abs(turns - std::round(turns));
    if (theta > 0.0 && theta < pi) stops.push_back(theta);
  }
}

std::vector<double> stops_at_resonances(const SampledReceptance& receptance, double period_s) {
  std::vector<double> stops{0.0, pi};
  for (double theta = 0.2; theta < pi; theta += 0.2) stops.push_back(theta);
  for (const Resonance& r : resonances(receptance)) add_aliases(r, period_s, stops);
  std::sort(stops.begin(), stops.end());
  stops.erase(std::unique(stops.begin(), stops.end(), [](double a, double b) { return b - a < 1e-4; }), stops.end());
  stops.back() = pi;
  return stops;
}

/// Harmonics fade out over the upper half of those that are taken, so that the sum changes smoothly with θ.
double share_of(double omega, double highest) {
  const double beyond = 2.0 * std::abs(omega) / highest - 1.0;
  return beyond <= 0.0 ? 1.0 : beyond >= 1.0 ? 0.0 : std::pow(std::cos(0.5 * pi * beyond), 2);
}

}  // namespace

void require_usable(const SampledReceptance& r) {
  const Index lines = r.frequency_hz.size();
  const auto fail = [](const std::string& what) { throw core::InputError("receptance at the cut: " + what); };
  if (lines < 6) fail(std::to_string(lines) + " frequency lines, at least 6 are needed");
  if (static_cast<std::size_t>(lines) != r.H.size())
    fail(std::to_string(lines) + " frequencies for " + std::to_string(r.H.size()) + " matrices, must be as many");
  if (!(r.frequency_hz(0) >= 0.0)) fail("the first line lies below 0 Hz");
  for (Index i = 0; i < lines; ++i) {
    if (i > 0 && !(r.frequency_hz(i) > r.frequency_hz(i - 1)))
      fail("line " + std::to_string(i + 1) + " does not lie above the one before; sort the lines");
    if (!r.H[static_cast<std::size_t>(i)].allFinite())
      fail("line " + std::to_string(i + 1) + " at " + std::to_string(r.frequency_hz(i)) + " Hz is not finite");
  }
}

LineWeights line_weights(const SampledReceptance& r, double hz, const Continuation& beyond) {
  const Index lines = r.frequency_hz.size();
  const double first_hz = r.frequency_hz(0);
  const double last_hz = r.frequency_hz(lines - 1);
  const auto ratio = [hz](double oscillator_hz, double end_hz) {
    const double square = oscillator_hz * oscillator_hz;
    return Eigen::VectorXd::Constant(1, (square - end_hz * end_hz) / (square - hz * hz));
  };
  if (hz < first_hz) {
    return {0, beyond.below_hz > 0.0 ? ratio(beyond.below_hz, first_hz) : Eigen::VectorXd::Ones(1), true};
  }
  if (hz >= last_hz) return {lines - 1, ratio(beyond.above_hz, last_hz), false};
  const auto* begin = r.frequency_hz.data();
  const Index above = std::upper_bound(begin, begin + lines, hz) - begin;
  const Index first = std::clamp<Index>(above - 3, 0, lines - 6);
  return {first, lagrange_polynomials(r.frequency_hz.segment<6>(first), hz), false};
}

Eigen::Matrix3cd interpolated(const SampledReceptance& r, double omega_rad_s, const Continuation& beyond) {
  const LineWeights of = line_weights(r, std::abs(omega_rad_s) / (2.0 * pi), beyond);
  Eigen::Matrix3cd H = Eigen::Matrix3cd::Zero();
  for (Index i = 0; i < of.weight.size(); ++i) H += of.weight(i) * r.H[static_cast<std::size_t>(of.first + i)];
  if (of.real_part) H = H.real().cast<complex<double>>().eval();
  return omega_rad_s < 0.0 ? Eigen::Matrix3cd(H.conjugate()) : H;
}

std::vector<Resonance> resonances(const SampledReceptance& r) {
  const Index lines = r.frequency_hz.size();
  const auto size = [&](Index line) { return r.H[static_cast<std::size_t>(line)].norm(); };
  std::vector<Resonance> found;
  for (Index i = 1; i + 1 < lines; ++i) {
    const double top = size(i);
    if (top < size(i - 1) || top <= size(i + 1)) continue;
    const double half_power = top / std::numbers::sqrt2;
    const auto outside = [&](Index line) { return size(line) <= half_power || size(line) > top; };
    Index low = i;
    Index high = i;
    while (low > 0 && !outside(low)) --low;
    while (high + 1 < lines && !outside(high)) ++high;
    if (size(low) > half_power || size(high) > half_power) continue;
    found.push_back({r.frequency_hz(i), 0.5 * (r.frequency_hz(high) - r.frequency_hz(low)), top});
  }
  return found;
}

namespace {

/// The sum over the harmonics at one angle: visit(ω, seen, force) for each, so that
///
///     Z = (1 − e^{−iθ})/T Σ seen H(ω) force
class Harmonics {
 public:
  Harmonics(const SampledReceptance& receptance, const ContactGrid& grid, double spindle_speed_rpm, double reach)
      : grid_(grid),
        seconds_per_rad_(30.0 / (pi * spindle_speed_rpm)),
        highest_(reach * 2.0 * pi * receptance.frequency_hz(receptance.frequency_hz.size() - 1)) {
    for (const CutElement& e : grid.elements)
      rules_.emplace_back(e.nodes, highest_ * (e.to_rad - e.from_rad) * seconds_per_rad_);
  }

  [[nodiscard]] double period_s() const { return grid_.period_rad * seconds_per_rad_; }

  /// (1 − e^{−iθ})/T
  [[nodiscard]] complex<double> factor(double theta) const {
    return (1.0 - (theta == pi ? complex<double>(-1.0) : std::polar(1.0, -theta))) / period_s();
  }

  template <typename Visit>
  void at(double theta, Visit visit) const {
    const auto contacts = static_cast<Index>(grid_.contacts.size());
    const double period = period_s();
    Eigen::Matrix3Xcd force(3, contacts);
    Eigen::MatrixX3cd seen(contacts, 3);
    const int last = static_cast<int>(std::floor((highest_ * period - theta) / (2.0 * pi)));
    // As many on the negative side, so that the sum is real where it has to be.
    const int first = static_cast<int>(std::ceil((-highest_ * period - theta) / (2.0 * pi)));
    for (int k = first; k <= last; ++k) {
      const double omega = (theta + 2.0 * pi * k) / period;
      const Eigen::VectorXcd moments = share_of(omega, highest_) * node_moments(grid_, rules_, seconds_per_rad_, omega);
      for (Index j = 0; j < contacts; ++j) {
        const EdgeContact& c = grid_.contacts[static_cast<std::size_t>(j)];
        force.col(j) = moments(c.node) * c.force;
        seen.row(j) = std::polar(1.0, omega * grid_.node_rad(c.node) * seconds_per_rad_) * c.chip.transpose();
      }
      visit(omega, seen, force);
    }
  }

 private:
  const ContactGrid& grid_;
  double seconds_per_rad_;
  double highest_;
  std::vector<ProductRule> rules_;
};

void require_one_delay(const ContactGrid& grid) {
  if (grid.one_delay) return;
  throw core::InputError(
      "receptance at the cut: unequal teeth or process damping, all delays must be one period; take a modal model");
}

}  // namespace

GainOnCircle harmonic_gain(const SampledReceptance& receptance, const ContactGrid& grid, double spindle_speed_rpm,
                           double reach, const Continuation& beyond) {
  require_usable(receptance);
  require_one_delay(grid);
  const Harmonics harmonics(receptance, grid, spindle_speed_rpm, reach);
  const auto contacts = static_cast<Index>(grid.contacts.size());
  const auto gain = [&receptance, harmonics, contacts, beyond](double theta) {
    Eigen::MatrixXcd Z = Eigen::MatrixXcd::Zero(contacts, contacts);
    harmonics.at(theta, [&](double omega, const Eigen::MatrixX3cd& seen, const Eigen::Matrix3Xcd& force) {
      Z.noalias() += (seen * interpolated(receptance, omega, beyond)) * force;
    });
    return Eigen::MatrixXcd(harmonics.factor(theta) * Z);
  };
  const auto slope = [gain](double theta) {
    constexpr double h = 1e-5;  // rad; the slope steers Newton's rule and need not be exact
    return Eigen::MatrixXcd((gain(theta + h) - gain(theta - h)) / (2.0 * h));
  };
  return {contacts, gain, slope, stops_at_resonances(receptance, harmonics.period_s())};
}

std::vector<Eigen::Matrix3cd> gain_gradient(const SampledReceptance& receptance, const ContactGrid& grid,
                                            double spindle_speed_rpm, double reach, const Continuation& beyond,
                                            double theta_rad, const Eigen::VectorXcd& l, const Eigen::VectorXcd& r,
                                            complex<double> factor) {
  require_usable(receptance);
  require_one_delay(grid);
  const Harmonics harmonics(receptance, grid, spindle_speed_rpm, reach);
  std::vector<Eigen::Matrix3cd> gradient(receptance.H.size(), Eigen::Matrix3cd::Zero());
  harmonics.at(theta_rad, [&](double omega, const Eigen::MatrixX3cd& seen, const Eigen::Matrix3Xcd& force) {
    const LineWeights of = line_weights(receptance, std::abs(omega) / (2.0 * pi), beyond);
    Eigen::Matrix3cd g = factor * harmonics.factor(theta_rad) * (seen.transpose() * l) * (force * r).transpose();
    if (omega < 0.0) g = g.conjugate().eval();  // Re(z̄) = Re(z)
    if (of.real_part) g = g.real().cast<complex<double>>().eval();
    for (Index i = 0; i < of.weight.size(); ++i) gradient[static_cast<std::size_t>(of.first + i)] += of.weight(i) * g;
  });
  return gradient;
}

}  // namespace thinwall::milling
