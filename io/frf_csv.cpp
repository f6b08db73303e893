#include "io/frf_csv.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/nearest_name.hpp"
#include "core/units.hpp"
#include "io/csv_text.hpp"

namespace thinwall::io {

namespace {

using Complex = std::complex<double>;

struct NamedQuantity {
  std::string name;
  FrfQuantity quantity;
  core::Dimension dimension;  ///< length/force, per time for each derivative
};

const std::vector<NamedQuantity>& named_quantities() {
  static const std::vector<NamedQuantity> quantities{
      {"receptance", FrfQuantity::receptance, core::parse_unit("m/N").dimension},
      {"mobility", FrfQuantity::mobility, core::parse_unit("m/s/N").dimension},
      {"accelerance", FrfQuantity::accelerance, core::parse_unit("m/s^2/N").dimension}};
  return quantities;
}

struct NamedFrequency {
  std::string name;
  double in_hz;
};

const std::vector<NamedFrequency>& named_frequencies() {
  static const std::vector<NamedFrequency> frequencies{{"Hz", 1.0}, {"kHz", 1e3}, {"rad/s", 0.5 / std::numbers::pi}};
  return frequencies;
}

/// The entry called `word`, or InputError with the nearest name.
template <typename Entry>
const Entry& find(const std::vector<Entry>& entries, const std::string& word, const std::string& meaning) {
  std::vector<std::string> names;
  std::string list;
  for (const Entry& entry : entries) {
    if (entry.name == word) return entry;
    names.push_back(entry.name);
    list += (list.empty() ? "" : ", ") + entry.name;
  }
  throw core::InputError("the " + meaning + " \"" + word + "\" is none of " + list + core::did_you_mean(word, names));
}

/// The unit's factor to SI, provided it is a unit of the quantity.
double unit_in_si(const std::string& unit, const NamedQuantity& quantity) {
  constexpr double standard_gravity = 9.80665;  // an accelerometer's "g", never a gram
  if (unit == "g/N" && quantity.quantity == FrfQuantity::accelerance) return standard_gravity;
  const core::Quantity parsed = core::parse_unit(unit);
  if (parsed.dimension == quantity.dimension) return parsed.value;
  for (const NamedQuantity& other : named_quantities()) {
    if (parsed.dimension == other.dimension) {
      throw core::InputError("\"" + unit + "\" is a unit of " + other.name + ", but the quantity is " + quantity.name +
                             "; make them agree");
    }
  }
  throw core::InputError("\"" + unit + "\" is no unit of " + quantity.name +
                         "; write for example m/N, m/s/N or m/s^2/N");
}

std::string range_text(double from, double to) {
  return core::number_text(from) + " to " + core::number_text(to) + " Hz";
}

double checked_frequency_hz(const CsvText& text, const CsvLine& line, const FrfFormat& format, const CsvLine* before) {
  const double value = number(text, line, 0);
  const auto fail = [&](const std::string& cause) {
    throw core::DataError(location(text, line) + ": frequency " + line.fields[0] + " " + cause);
  };
  if (value < 0.0) fail("is negative; keep the lines from 0 Hz upwards");
  if (value == 0.0 && format.quantity != FrfQuantity::receptance) {
    fail("has no receptance: the conversion divides by it; remove the line");
  }
  if (before != nullptr) {
    const double earlier = number(text, *before, 0);
    if (value == earlier) fail("stands on line " + std::to_string(before->number) + " already; keep one of them");
    if (value < earlier) fail("follows " + before->fields[0] + "; sort the lines by rising frequency");
  }
  return value * format.unit_in_hz;
}

Complex to_receptance(Complex value, double omega, const FrfFormat& format) {
  switch (format.quantity) {
    case FrfQuantity::mobility:
      return format.unit_in_si * value / Complex(0.0, omega);
    case FrfQuantity::accelerance:
      return -format.unit_in_si * value / (omega * omega);
    case FrfQuantity::receptance:
      break;
  }
  return format.unit_in_si * value;
}

bool equal_axes(const dynamics::FrequencyAxis& a, const dynamics::FrequencyAxis& b) {
  return a.size() == b.size() &&
         ((a.hz - b.hz).array().abs() <= 1e-12 * a.hz.array().abs().max(b.hz.array().abs())).all();
}

/// The Lagrange polynomial through all the points (x_i, y_i), at x.
Complex interpolate(std::span<const double> x_i, std::span<const Complex> y_i, double x) {
  Complex sum = 0.0;
  for (std::size_t i = 0; i < x_i.size(); ++i) {
    double weight = 1.0;
    for (std::size_t j = 0; j < x_i.size(); ++j) {
      if (j != i) weight *= (x - x_i[j]) / (x_i[i] - x_i[j]);
    }
    sum += weight * y_i[i];
  }
  return sum;
}

}  // namespace

FrfFormat frf_format(const std::string& quantity, const std::string& unit, const std::string& frequency) {
  const NamedQuantity& named = find(named_quantities(), quantity, "FRF quantity");
  return {named.quantity, unit_in_si(unit, named), find(named_frequencies(), frequency, "frequency unit").in_hz};
}

MeasuredFrf read_frf(const std::filesystem::path& path, const FrfFormat& format) {
  const CsvText text = read_csv_text(path);
  require_columns(text, 3, "frequency, real part, imaginary part");
  if (text.lines.size() < 2) throw core::DataError(path.string() + ": holds one line; a response needs two at least");
  MeasuredFrf frf;
  frf.source = path.string();
  const auto count = static_cast<Eigen::Index>(text.lines.size());
  frf.axis.hz.resize(count);
  frf.H.resize(count);
  const CsvLine* before = nullptr;
  for (Eigen::Index i = 0; i < count; ++i) {
    const CsvLine& line = text.lines[static_cast<std::size_t>(i)];
    frf.axis.hz(i) = checked_frequency_hz(text, line, format, before);
    const Complex value{number(text, line, 1), number(text, line, 2)};
    frf.H(i) = to_receptance(value, 2.0 * std::numbers::pi * frf.axis.hz(i), format);
    if (!std::isfinite(frf.H(i).real()) || !std::isfinite(frf.H(i).imag())) {
      throw core::DataError(location(text, line) +
                            ": the receptance is beyond the range of a double at this frequency");
    }
    before = &line;
  }
  return frf;
}

Eigen::VectorXcd resample(const MeasuredFrf& frf, const dynamics::FrequencyAxis& axis) {
  if (equal_axes(frf.axis, axis)) return frf.H;
  const std::span<const double> x(frf.axis.hz.data(), static_cast<std::size_t>(frf.axis.size()));
  const std::span<const Complex> y(frf.H.data(), x.size());
  const double slack = 1e-9 * x.back();
  if (axis.hz.minCoeff() < x.front() - slack || axis.hz.maxCoeff() > x.back() + slack) {
    throw core::DataError(frf.source + ": measured from " + range_text(x.front(), x.back()) + ", asked for " +
                          range_text(axis.hz.minCoeff(), axis.hz.maxCoeff()) +
                          "; narrow the frequency range of the case or measure further");
  }
  const std::size_t points = std::min<std::size_t>(4, x.size());
  Eigen::VectorXcd H(axis.size());
  for (Eigen::Index line = 0; line < axis.size(); ++line) {
    const auto above = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), axis.hz(line)) - x.begin());
    const std::size_t first = std::min(above - std::min(above, points / 2), x.size() - points);
    H(line) = interpolate(x.subspan(first, points), y.subspan(first, points), axis.hz(line));
  }
  return H;
}

}  // namespace thinwall::io
