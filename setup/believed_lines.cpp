#include "setup/believed_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "dynamics/believable_band.hpp"
#include "setup/measured.hpp"

namespace thinwall::setup {

namespace {

using dynamics::LineDoubt;
using Eigen::Index;

/// Fewer lines than a fit needs (io/frf/resample.hpp) are no band.
constexpr Index least_band = 14;

const char* reason(LineDoubt doubt) {
  switch (doubt) {
    case LineDoubt::scatter:
      return "neighbouring lines scatter, as an integrated accelerometer's do";
    case LineDoubt::coherence:
      return "the coherence is below 0.9";
    case LineDoubt::growth:
      return "they rise towards 0 Hz by 40 dB a decade, as an integrator's error does and no held structure";
    case LineDoubt::energy:
      return "they give energy, which no passive structure does";
    case LineDoubt::none:
      break;
  }
  return "";
}

/// The lines of an axis from one frequency to another; round-off of a bound leaves no line out.
std::vector<Index> lines_within(const dynamics::FrequencyAxis& axis, double from_hz, double to_hz) {
  std::vector<Index> lines;
  for (Index line = 0; line < axis.size(); ++line) {
    const double hz = axis.hz(line);
    if (hz >= from_hz * (1.0 - 1e-12) && hz <= to_hz * (1.0 + 1e-12)) lines.push_back(line);
  }
  return lines;
}

void keep(const std::vector<Index>& lines, io::MeasuredFrf& frf) {
  frf.axis.hz = Eigen::VectorXd(frf.axis.hz(lines));
  frf.H = Eigen::VectorXcd(frf.H(lines));
  if (frf.coherence.size() > 0) frf.coherence = Eigen::VectorXd(frf.coherence(lines));
}

/// An end of the band: what is doubted, and the bound that the set-up gives there.
struct End {
  const char* key;
  const char* side;
  double believed_hz;
  LineDoubt doubt;
  std::optional<double> given_hz;
};

std::string warning_of(const End& end, const MeasuredFrf& measured, bool left_out) {
  const std::string lines = std::isfinite(end.believed_hz)
                                ? fmt::format("lines {} {:.4g} Hz", end.side, end.believed_hz)
                                : std::string("all lines");
  const std::string what =
      fmt::format("{} ({} by {}): {}", measured.file.string(), measured.response, measured.force, lines);
  if (left_out)
    return fmt::format("{} are left out, for {}; give `{}` of this FRF to bound its band yourself", what,
                       reason(end.doubt), end.key);
  return fmt::format("{} are used, but hardly to be believed, for {}", what, reason(end.doubt));
}

/// The warning that lines are left out because FRFs beside this one have none there.
std::string neighbours_warning(const MeasuredFrf& measured, const dynamics::FrequencyAxis& axis, double from_hz,
                               double to_hz) {
  constexpr double hair = 1e-12;
  const bool below = axis.hz(0) < from_hz * (1.0 - hair);
  const bool above = axis.hz(axis.size() - 1) > to_hz * (1.0 + hair);
  return fmt::format("{} ({} by {}): lines {}{}{} are left out, too, for the FRFs beside it have none there",
                     measured.file.string(), measured.response, measured.force,
                     below ? fmt::format("below {:.4g} Hz", from_hz) : "", below && above ? " and " : "",
                     above ? fmt::format("above {:.4g} Hz", to_hz) : "");
}

}  // namespace

FrfContent with_believed_lines(FrfContent content, const MeasuredFrf& measured, bool held) {
  io::MeasuredFrf& frf = content.frf;
  if (frf.axis.size() == 0) return content;
  const bool driving = measured.response == measured.force;
  const dynamics::BelievableBand band =
      dynamics::believable_band(frf.axis, frf.H, frf.coherence, {driving, held, measured.noise.value_or(0.0)});
  const bool enough = std::ssize(lines_within(frf.axis, band.from_hz, band.to_hz)) >= least_band;
  const double first = frf.axis.hz(0), last = frf.axis.hz(frf.axis.size() - 1);
  double from_hz = measured.from_hz.value_or(first), to_hz = measured.to_hz.value_or(last);
  for (const End& end : {End{"from", "below", band.from_hz, band.below, measured.from_hz},
                         End{"to", "above", band.to_hz, band.above, measured.to_hz}}) {
    if (end.doubt == LineDoubt::none) continue;
    const bool lower = end.side == std::string_view("below");
    const bool inside = !end.given_hz || (lower ? *end.given_hz < end.believed_hz : *end.given_hz > end.believed_hz);
    if (!inside) continue;
    const bool left_out = enough && !end.given_hz;
    content.warnings.push_back(warning_of(end, measured, left_out));
    if (left_out) (lower ? from_hz : to_hz) = end.believed_hz;
  }
  const std::vector<Index> lines = lines_within(frf.axis, from_hz, to_hz);
  if (std::ssize(lines) == frf.axis.size()) return content;
  if (lines.empty())
    throw core::InputError(fmt::format(
        "\"{}\" has no line within the bounds that are given, {:g} to {:g} Hz: its lines go from {:g} to "
        "{:g} Hz; correct its from and to",
        measured.file.string(), measured.from_hz.value_or(0.0), measured.to_hz.value_or(INFINITY), first, last));
  keep(lines, frf);
  content.lines_left_out = true;
  return content;
}

dynamics::FrequencyAxis within_lines_of(const std::vector<MeasuredFrf>& files, const dynamics::FrequencyAxis& axis) {
  double from_hz = 0.0, to_hz = INFINITY;
  for (const MeasuredFrf& file : files) {
    if (!file.content || !file.content->lines_left_out) continue;
    const Eigen::VectorXd& hz = file.content->frf.axis.hz;
    from_hz = std::max(from_hz, hz(0));
    to_hz = std::min(to_hz, hz(hz.size() - 1));
  }
  const std::vector<Index> lines = lines_within(axis, from_hz, to_hz);
  if (std::ssize(lines) == axis.size()) return axis;
  if (lines.size() < 2)
    throw core::InputError(
        fmt::format("the lines of \"{}\" and of the FRFs beside it that are left, {:g} to {:g} Hz, "
                    "hold fewer than two of the lines that are asked for, {:g} to {:g} Hz; change "
                    "their from and to, or response.from and response.to",
                    files.front().file.string(), from_hz, to_hz, axis.hz(0), axis.hz(axis.size() - 1)));
  return {Eigen::VectorXd(axis.hz(lines))};
}

void take_common_band(std::vector<MeasuredFrf>& files) {
  double from_hz = 0.0, to_hz = INFINITY;
  for (const MeasuredFrf& file : files) {
    const Eigen::VectorXd& hz = receptance_of(file).axis.hz;
    if (hz.size() == 0) return;
    from_hz = std::max(from_hz, hz(0));
    to_hz = std::min(to_hz, hz(hz.size() - 1));
  }
  for (MeasuredFrf& file : files) {
    const dynamics::FrequencyAxis& axis = receptance_of(file).axis;
    const std::vector<Index> lines = lines_within(axis, from_hz, to_hz);
    if (std::ssize(lines) == axis.size()) continue;
    if (lines.size() < 2)
      throw core::InputError(fmt::format(
          "\"{}\" ({} by {}) has fewer than two lines from {:g} to {:g} Hz, where the FRFs beside it have lines: its "
          "own go from {:g} to {:g} Hz; correct their from and to, or measure all of them over one band",
          file.file.string(), file.response, file.force, from_hz, to_hz, axis.hz(0), axis.hz(axis.size() - 1)));
    FrfContent content = *file.content;
    content.warnings.push_back(neighbours_warning(file, axis, from_hz, to_hz));
    keep(lines, content.frf);
    content.lines_left_out = true;
    file.content = std::make_shared<const FrfContent>(std::move(content));
  }
}

}  // namespace thinwall::setup
