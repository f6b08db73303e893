#include "milling/classical/zeroth_order.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "linalg/bracketed_root.hpp"
#include "linalg/complex_eigenvalues.hpp"
#include "milling/classical/multi_frequency.hpp"

namespace thinwall::milling {

namespace {

using Eigen::Index;
using std::complex;

using std::numbers::pi;

/// The structure under its mean cut, in the directions that yield.
struct MeanCut {
  RelativeStructure structure;  // tool axes
  Eigen::Matrix3Xd yielding;
  Eigen::Matrix3d A;

  /// λ(ω), eigenvalues of G A_0.
  [[nodiscard]] std::vector<complex<double>> eigenvalues(double omega) const {
    const Eigen::MatrixXcd loop = yielding.transpose() * receptance(structure, omega) * A * yielding;
    const std::optional<Eigen::VectorXcd> values = linalg::complex_eigenvalues(loop);
    if (!values) {
      throw core::NumericalError("zeroth-order solution: an eigen-solution failed at " + std::to_string(omega) +
                                 " rad/s; check the structure at the cut");
    }
    return {values->begin(), values->end()};
  }
};

MeanCut mean_cut(const RelativeStructure& structure, const MillingProcess& process) {
  require_valid(validate(process));
  MeanCut cut{in_tool_axes(structure, process.frame), {}, directional_harmonics(process, 0).front().real()};
  cut.yielding = yielding_directions(cut.structure);
  return cut;
}

/// Frequencies from above 0 to `highest`: steps of a fifth of the distance to the nearest pole, at most `longest`.
std::vector<double> frequencies(const RelativeStructure& s, double highest, double longest) {
  std::vector<double> all;
  double omega = 1e-6 * s.poles.cwiseAbs().minCoeff();
  while (omega < highest) {
    all.push_back(omega);
    omega += std::min(longest, 0.2 * (s.poles.array() - complex<double>(0.0, omega)).abs().minCoeff());
  }
  all.push_back(highest);
  return all;
}

double least_depth(const MeanCut& cut, double omega) {
  double least = INFINITY;
  for (const complex<double> lambda : cut.eigenvalues(omega)) {
    if (lambda.real() < 0.0) least = std::min(least, -0.5 / lambda.real());
  }
  return least;
}

ZerothOrderPoint point_of(double omega, complex<double> lambda) {
  const double depth = -0.5 / lambda.real();
  const double phase = -std::arg(1.0 + 1.0 / (depth * lambda));
  return {omega, depth, phase < 0.0 ? phase + 2.0 * pi : phase};
}

/// The frequency beyond which no depth up to the limit is on the boundary, or thirty times the fastest pole.
double highest_frequency(const MeanCut& cut, double depth_limit_m) {
  const double fastest = cut.structure.poles.cwiseAbs().maxCoeff();
  double highest = 1.2 * fastest;
  while (highest < 30.0 * fastest &&
         2.0 * depth_limit_m * cut.A.norm() * receptance(cut.structure, highest).norm() > 1.0)
    highest *= 1.2;
  return highest;
}

complex<double> nearest(const std::vector<complex<double>>& values, complex<double> to) {
  return *std::min_element(values.begin(), values.end(),
                           [&](complex<double> a, complex<double> b) { return std::abs(a - to) < std::abs(b - to); });
}

struct ZerothOrderCrossing {
  double omega_rad_s = 0.0;
  double depth_m = 0.0;
  int unstable_change = 0;
};

/// Crossings of the paths of ν = −(1 − e^{−iωT}) λ over the positive real axis between two near frequencies, down to
/// the depth limit.
void add_between(const MeanCut& cut, double period, double depth_limit_m, double from, double to,
                 std::vector<ZerothOrderCrossing>& found) {
  const auto nu = [&](double omega) {
    std::vector<complex<double>> values = cut.eigenvalues(omega);
    for (complex<double>& v : values) v *= std::polar(1.0, -omega * period) - 1.0;
    return values;
  };
  const auto ends = nu(to);
  for (const complex<double> start : nu(from)) {
    const complex<double> end = nearest(ends, start);
    const bool crosses = (start.imag() > 0.0) != (end.imag() > 0.0);
    if (!crosses || std::max(start.real(), end.real()) * depth_limit_m < 0.5) continue;
    const auto on_path = [&](double omega) {
      return nearest(nu(omega), start + (omega - from) / (to - from) * (end - start));
    };
    const auto phase = [&](double omega) { return std::arg(on_path(omega)); };
    if (std::abs(std::arg(start) - std::arg(end)) > pi) continue;  // over the negative axis
    const double omega = linalg::bracketed_root(phase, {from, std::arg(start), to, std::arg(end)}, {.relative = 1e-14},
                                                "zeroth-order solution: the frequency of a crossing");
    const double depth = 1.0 / on_path(omega).real();
    if (depth > 0.0 && depth <= depth_limit_m) found.push_back({omega, depth, start.imag() > 0.0 ? 2 : -2});
  }
}

}  // namespace

double lobe_speed_rpm(const ZerothOrderPoint& point, int lobe, int teeth) {
  return 60.0 * point.omega_rad_s / (teeth * (point.phase_rad + 2.0 * pi * lobe));
}

std::vector<ZerothOrderPoint> zeroth_order_boundary(const RelativeStructure& structure, const MillingProcess& process,
                                                    double highest_rad_s) {
  const MeanCut cut = mean_cut(structure, process);
  std::vector<ZerothOrderPoint> points;
  for (const double omega : frequencies(cut.structure, highest_rad_s, INFINITY)) {
    for (const complex<double> lambda : cut.eigenvalues(omega)) {
      if (lambda.real() < 0.0) points.push_back(point_of(omega, lambda));
    }
  }
  return points;
}

ZerothOrderPoint zeroth_order_minimum(const RelativeStructure& structure, const MillingProcess& process) {
  const MeanCut cut = mean_cut(structure, process);
  const std::vector<double> omega =
      frequencies(cut.structure, 2.0 * cut.structure.poles.cwiseAbs().maxCoeff(), INFINITY);
  std::vector<double> depth;
  depth.reserve(omega.size());
  for (const double w : omega) depth.push_back(least_depth(cut, w));
  const auto least = static_cast<std::size_t>(std::min_element(depth.begin(), depth.end()) - depth.begin());
  if (!std::isfinite(depth[least])) {
    throw core::NumericalError(
        "zeroth-order solution: the mean cut is stable at any depth; take the direct method for this engagement");
  }
  double low = omega[least == 0 ? 0 : least - 1];
  double high = omega[std::min(least + 1, omega.size() - 1)];
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  // The depth is flat at its minimum: 1e-9 of the frequency leaves it exact to round-off.
  while (high - low > 1e-9 * high) {
    const double third = golden * (high - low);
    if (least_depth(cut, high - third) < least_depth(cut, low + third)) high = low + third;
    else low = high - third;
  }
  const double at = 0.5 * (low + high);
  const auto values = cut.eigenvalues(at);
  return point_of(at, *std::min_element(values.begin(), values.end(),
                                        [](complex<double> a, complex<double> b) { return a.real() < b.real(); }));
}

FoundCrossings zeroth_order_crossings(const CutAtSpeed& cut, int harmonics, const StabilityOptions& options) {
  const MeanCut mean{cut.structure, cut.yielding, directional_harmonics(cut.process, 0).front().real()};
  const double period = tooth_period_s(cut.process.cutter, cut.spindle_speed_rpm);
  std::vector<ZerothOrderCrossing> crossings;
  const std::vector<double> omega =
      frequencies(cut.structure, highest_frequency(mean, options.depth_limit_m), 0.2 / period);
  for (std::size_t i = 1; i < omega.size(); ++i)
    add_between(mean, period, options.depth_limit_m, omega[i - 1], omega[i], crossings);
  std::sort(crossings.begin(), crossings.end(),
            [](const ZerothOrderCrossing& a, const ZerothOrderCrossing& b) { return a.depth_m < b.depth_m; });
  FoundCrossings found;
  found.searched_m = options.depth_limit_m;
  if (crossings.empty()) return found;
  found.searched_m = std::min(options.depth_limit_m, options.follow * crossings.front().depth_m);
  const GainOnCircle gain = multi_frequency_gain(cut, directional_harmonics(cut.process, harmonics),
                                                 std::min(options.depth_limit_m, 8.0 * surely_stable_depth_m(cut)));
  for (const ZerothOrderCrossing& c : crossings) {
    if (c.depth_m > found.searched_m) break;
    const double turns = c.omega_rad_s * period / (2.0 * pi);
    Crossing better{c.depth_m, 2.0 * pi * std::abs(turns - std::round(turns)), 0, {}};
    const bool kept = to_axis(gain, 1.0 / c.depth_m, better);
    const double estimate = kept ? std::min(1.0, 1e-11 + std::abs(better.depth_m / c.depth_m - 1.0)) : 1.0;
    found.points.push_back({c.depth_m, c.omega_rad_s / (2.0 * pi), Bifurcation::hopf, c.unstable_change, estimate});
  }
  return found;
}

}  // namespace thinwall::milling
