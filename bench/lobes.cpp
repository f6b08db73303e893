// Time of two stability charts, a thin plate alone and backed by a robot: 400 speeds each, 15 modes, 3 × 3 receptance.

#include "milling/lobes.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace {

using thinwall::milling::RelativeStructure;

// Made-up modes in the manner of a clamped plate: 212 Hz to 5 kHz, motion through the thickness (x) with a little along
// the edge, 1 % damping.
RelativeStructure plate(double backing_stiffness_scale) {
  constexpr int modes = 15;
  RelativeStructure s;
  s.poles.resize(modes);
  s.phi.resize(3, modes);
  s.b.resize(3, modes);
  for (int k = 0; k < modes; ++k) {
    const double hz = 212.0 * std::pow(5000.0 / 212.0, k / (modes - 1.0)) * (k == 0 ? backing_stiffness_scale : 1.0);
    const double omega = 2.0 * std::numbers::pi * hz;
    const double zeta = backing_stiffness_scale > 1.0 ? 0.05 : 0.01;
    s.poles(k) = {-zeta * omega, omega * std::sqrt(1.0 - zeta * zeta)};
    const Eigen::Vector3d shape(1.5 + 0.5 * std::sin(3.0 * k), 0.1 * std::cos(2.0 * k), 0.05 * std::sin(5.0 * k));
    s.phi.col(k) = shape.cast<std::complex<double>>();
    s.b.col(k) = shape / std::complex<double>(0.0, 2.0 * s.poles(k).imag());
  }
  return s;
}

void chart(const char* name, const RelativeStructure& structure) {
  using namespace thinwall::milling;
  MillingProcess process;
  process.cutter = {6, 0.016};
  process.coefficients = {2.0e9, 0.8e9, 0.3e9, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, 0.2e-3, MillingDirection::down);
  process.frame = {Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
  const auto start = std::chrono::steady_clock::now();
  const Lobes lobes = stability_lobes(structure, process, spindle_speeds(1000.0, 3000.0, 400), {});
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  double steps = 0.0;
  for (const LobeRow& row : lobes.rows) steps += row.nodes / 400.0;
  std::printf(
      "%-8s %6.2f s  minimum %.4f mm at %.0f rpm, worst estimate %.2e, %d at limit, %d not converged, mean nodes "
      "%.0f\n",
      name, time.count(), lobes.minimum_depth_m * 1e3, lobes.at_spindle_speed_rpm, lobes.worst_error_estimate,
      lobes.rows_at_limit, lobes.rows_not_converged, steps);
}

}  // namespace

int main() {
  chart("plate", plate(1.0));
  chart("backed", plate(1.3));
}
