#include "milling/sampled_receptance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/error.hpp"
#include "milling/product_rule.hpp"

namespace thinwall::milling {

namespace {

using Eigen::Index;
using std::complex;

constexpr double pi = std::numbers::pi;

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

Eigen::Matrix3cd interpolated(const SampledReceptance& r, double omega_rad_s, const Continuation& beyond) {
  const double hz = std::abs(omega_rad_s) / (2.0 * pi);
  const Index lines = r.frequency_hz.size();
  const double first_hz = r.frequency_hz(0);
  const double last_hz = r.frequency_hz(lines - 1);
  const auto line = [&](Index i) -> const Eigen::Matrix3cd& { return r.H[static_cast<std::size_t>(i)]; };
  const auto ratio = [hz](double oscillator_hz, double end_hz) {
    const double square = oscillator_hz * oscillator_hz;
    return (square - end_hz * end_hz) / (square - hz * hz);
  };
  Eigen::Matrix3cd H;
  if (hz < first_hz) {
    H = line(0).real().cast<complex<double>>();
    if (beyond.below_hz > 0.0) H *= ratio(beyond.below_hz, first_hz);
  } else if (hz >= last_hz) {
    H = line(lines - 1) * ratio(beyond.above_hz, last_hz);
  } else {
    const auto* begin = r.frequency_hz.data();
    const Index above = std::upper_bound(begin, begin + lines, hz) - begin;
    const Index first = std::clamp<Index>(above - 3, 0, lines - 6);
    const Eigen::VectorXd weight = lagrange_polynomials(r.frequency_hz.segment<6>(first), hz);
    H.setZero();
    for (Index i = 0; i < 6; ++i) H += weight(i) * line(first + i);
  }
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

GainOnCircle harmonic_gain(const SampledReceptance& receptance, const ContactGrid& grid, double spindle_speed_rpm,
                           double reach, const Continuation& beyond) {
  require_usable(receptance);
  if (!grid.one_delay) {
    throw core::InputError(
        "receptance at the cut: unequal teeth or process damping, all delays must be one period; take a modal model");
  }
  const double seconds_per_rad = 30.0 / (pi * spindle_speed_rpm);
  const double period = grid.period_rad * seconds_per_rad;
  const double highest = reach * 2.0 * pi * receptance.frequency_hz(receptance.frequency_hz.size() - 1);
  std::vector<ProductRule> rules;
  for (const CutElement& e : grid.elements)
    rules.emplace_back(e.nodes, highest * (e.to_rad - e.from_rad) * seconds_per_rad);
  const auto contacts = static_cast<Index>(grid.contacts.size());
  const auto gain = [&receptance, &grid, rules, seconds_per_rad, period, highest, contacts, beyond](double theta) {
    Eigen::MatrixXcd Z = Eigen::MatrixXcd::Zero(contacts, contacts);
    Eigen::Matrix3Xcd force(3, contacts);
    Eigen::MatrixX3cd seen(contacts, 3);
    const int last = static_cast<int>(std::floor((highest * period - theta) / (2.0 * pi)));
    // As many on the negative side, so that the sum is real where it has to be.
    const int first = static_cast<int>(std::ceil((-highest * period - theta) / (2.0 * pi)));
    for (int k = first; k <= last; ++k) {
      const double omega = (theta + 2.0 * pi * k) / period;
      const Eigen::VectorXcd moments = share_of(omega, highest) * node_moments(grid, rules, seconds_per_rad, omega);
      for (Index j = 0; j < contacts; ++j) {
        const Contact& c = grid.contacts[static_cast<std::size_t>(j)];
        force.col(j) = moments(c.node) * c.force;
        seen.row(j) = std::polar(1.0, omega * grid.node_rad(c.node) * seconds_per_rad) * c.chip.transpose();
      }
      Z.noalias() += (seen * interpolated(receptance, omega, beyond)) * force;
    }
    const complex<double> past = theta == pi ? complex<double>(-1.0) : std::polar(1.0, -theta);
    return Eigen::MatrixXcd((1.0 - past) / period * Z);
  };
  const auto slope = [gain](double theta) {
    constexpr double h = 1e-5;  // rad; the slope steers Newton's rule and need not be exact
    return Eigen::MatrixXcd((gain(theta + h) - gain(theta - h)) / (2.0 * h));
  };
  return {contacts, gain, slope, stops_at_resonances(receptance, period)};
}

}  // namespace thinwall::milling
