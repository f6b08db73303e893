#include "dynamics/frequency_axis.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

#include "core/error.hpp"

namespace thinwall::dynamics {

namespace {

void require_range(double from_hz, double to_hz, int lines, bool from_zero) {
  const bool starts_well = from_zero ? from_hz >= 0.0 : from_hz > 0.0;
  if (starts_well && from_hz < to_hz && std::isfinite(to_hz) && lines >= 2) return;
  std::ostringstream text;
  text << "frequency axis from " << from_hz << " Hz to " << to_hz << " Hz with " << lines << " lines: give "
       << (from_zero ? "0 <= from < to" : "0 < from < to") << " and at least 2 lines";
  throw core::InputError(text.str());
}

/// The advice of an error message: the band that both axes cover, or the statement that there is none.
std::string overlap(const FrequencyAxis& a, const FrequencyAxis& b) {
  if (a.size() == 0 || b.size() == 0) return "one of them is empty";
  const double from = std::max(a.hz(0), b.hz(0)), to = std::min(a.hz(a.size() - 1), b.hz(b.size() - 1));
  std::ostringstream text;
  text.precision(10);
  if (from <= to) {
    text << "bring both to one axis first; both cover " << from << " to " << to << " Hz";
  } else {
    text << "they do not overlap: one ends at " << to << " Hz, the other begins at " << from << " Hz";
  }
  return text.str();
}

}  // namespace

double FrequencyAxis::omega_rad_s(Eigen::Index line) const {
  return 2.0 * std::numbers::pi * hz(line);
}

FrequencyAxis linear_axis(double from_hz, double to_hz, int lines) {
  require_range(from_hz, to_hz, lines, true);
  return {Eigen::VectorXd::LinSpaced(lines, from_hz, to_hz)};
}

FrequencyAxis logarithmic_axis(double from_hz, double to_hz, int lines) {
  require_range(from_hz, to_hz, lines, false);
  FrequencyAxis axis{Eigen::VectorXd::LinSpaced(lines, std::log(from_hz), std::log(to_hz)).array().exp().matrix()};
  axis.hz(0) = from_hz;
  axis.hz(lines - 1) = to_hz;
  return axis;
}

bool equal(const FrequencyAxis& a, const FrequencyAxis& b) {
  return a.size() == b.size() &&
         ((a.hz - b.hz).array().abs() <= 1e-12 * a.hz.array().abs().max(b.hz.array().abs())).all();
}

void require_equal(const FrequencyAxis& a, const FrequencyAxis& b) {
  std::ostringstream text;
  text.precision(12);
  if (a.size() != b.size()) {
    text << "two responses with " << a.size() << " and " << b.size()
         << " frequency lines cannot be joined: " << overlap(a, b);
    throw core::InputError(text.str());
  }
  for (Eigen::Index line = 0; line < a.size(); ++line) {
    const double bound = 1e-12 * std::max(std::abs(a.hz(line)), std::abs(b.hz(line)));
    if (std::abs(a.hz(line) - b.hz(line)) <= bound) continue;
    text << "two responses differ in frequency at line " << line + 1 << ": " << a.hz(line) << " Hz against "
         << b.hz(line) << " Hz (relative bound 1e-12); " << overlap(a, b);
    throw core::InputError(text.str());
  }
}

}  // namespace thinwall::dynamics
