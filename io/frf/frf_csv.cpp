#include "io/frf/frf_csv.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <string>

#include "core/error.hpp"
#include "io/csv_text.hpp"

namespace thinwall::io {

namespace {

using Complex = std::complex<double>;

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

double checked_coherence(const CsvText& text, const CsvLine& line, std::size_t column) {
  const double value = number(text, line, column);
  if (value >= 0.0 && value <= 1.0) return value;
  throw core::DataError(location(text, line) + ": the coherence " + line.fields[column] +
                        " lies outside of 0 to 1; is the column another quantity?");
}

bool has_coherence_column(const CsvText& text) {
  if (text.header.size() != 4) return false;
  std::string name = text.header[3];
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  return name.find("coherence") != std::string::npos;
}

}  // namespace

MeasuredFrf measured_frf(const CsvText& text, const FrfFormat& format) {
  const bool has_coherence = has_coherence_column(text);
  require_columns(text, has_coherence ? 4 : 3, "frequency, real part, imaginary part");
  if (text.lines.size() < 2)
    throw core::DataError(text.path.string() + ": holds one line; a response needs two at least");
  MeasuredFrf frf;
  frf.source = text.path.string();
  const auto count = static_cast<Eigen::Index>(text.lines.size());
  frf.axis.hz.resize(count);
  frf.H.resize(count);
  frf.coherence.resize(has_coherence ? count : 0);
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
    if (has_coherence) frf.coherence(i) = checked_coherence(text, line, 3);
    before = &line;
  }
  return frf;
}

MeasuredFrf read_frf(const std::filesystem::path& path, const FrfFormat& format) {
  return measured_frf(read_csv_text(path), format);
}

void add_coherence(MeasuredFrf& frf, const std::filesystem::path& path, double unit_in_hz) {
  const CsvText text = read_csv_text(path);
  require_columns(text, 2, "frequency, coherence");
  const auto count = static_cast<Eigen::Index>(text.lines.size());
  dynamics::FrequencyAxis axis{Eigen::VectorXd(count)};
  Eigen::VectorXd coherence(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const CsvLine& line = text.lines[static_cast<std::size_t>(i)];
    axis.hz(i) = number(text, line, 0) * unit_in_hz;
    coherence(i) = checked_coherence(text, line, 1);
  }
  if (!dynamics::equal(axis, frf.axis)) {
    throw core::DataError(path.string() + ": the coherence is given at other frequencies than the response in " +
                          frf.source + "; export both from one measurement");
  }
  frf.coherence = coherence;
}

}  // namespace thinwall::io
