#pragma once
// Structures and cuts at random.

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "milling/cut/process.hpp"
#include "milling/direct/cut_at_speed.hpp"
#include "milling/structure/relative_structure.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::milling::testing {

struct RandomCut {
  RelativeStructure structure;
  MillingProcess process;
  double slowest_rpm = 0.0;
  double fastest_rpm = 0.0;
  double deepest_m = 0.0;
};

/// One to three modes in the plane of the cut, teeth, immersion and coefficients at random; speeds from a sixth of the
/// lowest natural frequency to three times the highest a tooth; depths to forty times one that is surely stable.
/// With `close` modes each one but the first is that before, higher by a thousandth to a tenth, at another damping
/// ratio.
inline RandomCut random_cut(unsigned seed, bool close = false) {
  std::mt19937 generator(seed);
  const auto between = [&](double a, double b) {
    return a + (b - a) * static_cast<double>(generator()) / static_cast<double>(std::mt19937::max());
  };
  RandomCut cut;
  const int modes = (close ? 2 : 1) + static_cast<int>(between(0.0, close ? 1.999 : 2.999));
  cut.structure.poles.resize(modes);
  cut.structure.phi.resize(3, modes);
  cut.structure.b.resize(3, modes);
  double lowest_hz = 1e9, highest_hz = 0.0;
  for (int k = 0; k < modes; ++k) {
    double hz = 300.0 * std::pow(6.0, between(0.0, 1.0));
    if (close && k > 0) hz = highest_hz * (1.0 + 1e-3 * std::pow(100.0, between(0.0, 1.0)));
    lowest_hz = std::min(lowest_hz, hz);
    highest_hz = std::max(highest_hz, hz);
    const double omega = 2.0 * std::numbers::pi * hz;
    const double zeta = 0.005 * std::pow(10.0, between(0.0, 1.0));
    cut.structure.poles(k) = {-zeta * omega, omega * std::sqrt(1.0 - zeta * zeta)};
    const double angle = between(0.0, std::numbers::pi);
    const Eigen::Vector3d shape(std::cos(angle), std::sin(angle), 0.0);
    cut.structure.phi.col(k) = shape.cast<std::complex<double>>();
    cut.structure.b.col(k) = shape / std::complex<double>(0.0, 2.0 * cut.structure.poles(k).imag());  // 1 kg
  }
  cut.process.cutter = {1 + static_cast<int>(between(0.0, 3.999)), 0.01};
  cut.process.coefficients = {6e8, 6e8 * between(0.1, 0.8), 0.0, 0.0, 0.0, 0.0};
  const auto direction = between(0.0, 1.0) < 0.5 ? MillingDirection::up : MillingDirection::down;
  cut.process.engagement = engagement_of(cut.process.cutter, 0.01 * std::pow(0.03, between(0.0, 1.0)), direction);
  cut.slowest_rpm = 60.0 * lowest_hz / 6.0 / cut.process.cutter.teeth;
  cut.fastest_rpm = 60.0 * highest_hz * 3.0 / cut.process.cutter.teeth;
  cut.deepest_m = 40.0 * surely_stable_depth_m(cut_at_speed(cut.structure, cut.process, cut.fastest_rpm));
  return cut;
}

/// A finishing cut of a plate by an end mill of 16 mm, with two modes across the surface. At its speeds the teeth pass
/// 1.3 to 1.6 times as often as the lower mode swings, and a lobe of that mode may close a little above its lowest
/// depth.
inline RandomCut light_cut(double first_hz, double first_ratio, double second_hz, double second_ratio, int teeth) {
  RandomCut cut;
  cut.structure = relative_structure(modal_model({{first_hz, first_ratio, 0.7, Eigen::Vector3d::UnitY()},
                                                  {second_hz, second_ratio, 0.35, Eigen::Vector3d::UnitY()}}),
                                     "P");
  cut.process.cutter = {teeth, 0.016};
  cut.process.coefficients = {2220e6, 666e6, 0.0, 0.0, 0.0, 0.0};
  cut.process.engagement = engagement_of(cut.process.cutter, 0.2e-3, MillingDirection::down);
  cut.slowest_rpm = 60.0 / teeth * 1.3 * first_hz;
  cut.fastest_rpm = 60.0 / teeth * 1.6 * first_hz;
  cut.deepest_m = 2e-3;
  return cut;
}

inline RandomCut random_light_cut(unsigned seed) {
  std::mt19937 generator(seed);
  const auto between = [&](double a, double b) {
    return a + (b - a) * static_cast<double>(generator()) / static_cast<double>(std::mt19937::max());
  };
  const double first_hz = between(190.0, 235.0), first_ratio = between(0.005, 0.03), second_hz = between(500.0, 620.0);
  return light_cut(first_hz, first_ratio, second_hz, between(0.005, 0.03), 1 + static_cast<int>(between(0.0, 5.999)));
}

}  // namespace thinwall::milling::testing
