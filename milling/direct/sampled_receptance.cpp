#include "milling/direct/sampled_receptance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/error.hpp"
#include "milling/cut/product_rule.hpp"

namespace thinwall::milling {

using Eigen::Index;
using std::numbers::pi;

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

SampledReceptance every_second_line(const SampledReceptance& r, Index from) {
  const Index lines = (r.frequency_hz.size() - from + 1) / 2;
  SampledReceptance half{r.frequency_hz(Eigen::seqN(from, lines, 2)), {}};
  for (Index i = 0; i < lines; ++i) half.H.push_back(r.H[static_cast<std::size_t>(from + 2 * i)]);
  return half;
}

LineWeights line_weights(const SampledReceptance& r, double hz) {
  const Index lines = r.frequency_hz.size();
  if (hz < r.frequency_hz(0) || hz > r.frequency_hz(lines - 1)) return {};
  const auto* begin = r.frequency_hz.data();
  const Index above = std::upper_bound(begin, begin + lines, hz) - begin;
  const Index first = std::clamp<Index>(above - 3, 0, lines - 6);
  return {first, lagrange_polynomials(r.frequency_hz.segment<6>(first), hz)};
}

Eigen::Matrix3cd interpolated(const SampledReceptance& r, double omega_rad_s) {
  const LineWeights of = line_weights(r, std::abs(omega_rad_s) / (2.0 * pi));
  Eigen::Matrix3cd H = Eigen::Matrix3cd::Zero();
  for (Index i = 0; i < of.weight.size(); ++i) H += of.weight(i) * r.H[static_cast<std::size_t>(of.first + i)];
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

}  // namespace thinwall::milling
