#pragma once
// A cut whose flip lobes are known, and the lines of structures with noise.

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "milling/chart/sampled_stability.hpp"
#include "milling/direct/stability.hpp"
#include "single_mode.hpp"

namespace thinwall::milling::testing {

class Draws {
 public:
  explicit Draws(unsigned seed) : engine_(seed) {}
  double uniform(double from, double to) { return std::uniform_real_distribution<double>(from, to)(engine_); }
  double logarithmic(double from, double to) { return std::exp(uniform(std::log(from), std::log(to))); }
  double normal() { return normal_(engine_); }

 private:
  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
};

/// The receptance of poles at even lines, `most` of them at most.
inline SampledReceptance lines_of(const RelativeStructure& poles, double from_hz, double to_hz, double spacing_hz,
                                  Eigen::Index most = 6000) {
  const auto count = std::clamp<Eigen::Index>(static_cast<Eigen::Index>((to_hz - from_hz) / spacing_hz) + 1, 14, most);
  SampledReceptance lines{Eigen::VectorXd::LinSpaced(count, from_hz, to_hz), {}};
  for (const double hz : lines.frequency_hz) lines.H.push_back(receptance(poles, 2.0 * std::numbers::pi * hz));
  return lines;
}

/// A row up to its first crossing.
inline StabilityOptions first_only() {
  StabilityOptions options;
  options.follow = 1.0;
  options.depth_limit_m = 0.2;
  return options;
}

/// Multiplies the entries of the plane by 1 + noise (x + iy), x and y normal.
inline void add_noise(SampledReceptance& lines, double noise, Draws& draw) {
  for (Eigen::Matrix3cd& H : lines.H) {
    for (auto& entry : H.topLeftCorner<2, 2>().reshaped())
      entry *= 1.0 + noise * std::complex<double>(draw.normal(), draw.normal());
  }
}

/// A light cut of two teeth into a mode at 1000 Hz, with another one far above.
struct FlipLobes {
  RelativeStructure poles = relative_structure(
      modal_model({{1000.0, 0.01, 0.127, Eigen::Vector3d::UnitY()}, {3300.0, 0.02, 0.0465, Eigen::Vector3d::UnitY()}}),
      "P");
  MillingProcess process;

  FlipLobes() {
    process.cutter = {2, 0.012};
    process.coefficients = {8e8, 2.4e8};
    process.engagement = engagement_of(process.cutter, 0.001, MillingDirection::down);
  }
  [[nodiscard]] LobeRow row(double rpm) const { return limiting_depth(poles, process, rpm, first_only()); }
  /// The speed between two at which the limit changes from one kind of lobe to the other: the nose of a flip lobe.
  [[nodiscard]] double nose_rpm(double from, double to) const {
    const Bifurcation kind = row(from).kind;
    while (to - from > 1e-9 * to) {
      const double middle = 0.5 * (from + to);
      (row(middle).kind == kind ? from : to) = middle;
    }
    return 0.5 * (from + to);
  }
  /// Fits of noisy lines of the poles.
  [[nodiscard]] FittedStructure fit(double noise, Draws& draw) const {
    SampledReceptance lines = lines_of(poles, 200.0, 8000.0, 10.0);
    add_noise(lines, noise, draw);
    return fitted_structure({lines, {}}, process.frame);
  }
};

}  // namespace thinwall::milling::testing
