// Speed of the simulation in the time domain, one core but for the map: steps a second of circular paths, straight and
// helical; growth of a small vibration; a map of peak-to-peak values over speed and depth on all threads.
//
//     bench_simulation            prints a table; the bars stand in docs/benchmarks.md

#include "milling/simulation/simulation.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "core/parallel.hpp"
#include "milling/simulation/exact_path.hpp"
#include "milling/simulation/growth.hpp"

namespace {

using namespace thinwall::milling;

/// Modes from 300 Hz to 5 kHz in the plane of the cut.
RelativeStructure structure_of(int modes) {
  RelativeStructure s{Eigen::VectorXcd(modes), Eigen::Matrix3Xcd(3, modes), Eigen::Matrix3Xcd(3, modes)};
  for (int k = 0; k < modes; ++k) {
    const double omega = 2.0 * std::numbers::pi * 300.0 * std::pow(16.0, (k + 0.5) / modes);
    s.poles(k) = {-0.015 * omega, omega};
    const Eigen::Vector3d shape(std::cos(1.0 + 2.0 * k), std::sin(1.0 + 2.0 * k), 0.0);
    s.phi.col(k) = shape.cast<std::complex<double>>();
    s.b.col(k) = shape / std::complex<double>(0.0, 2.0 * omega * 0.5);
  }
  return s;
}

MillingProcess process_of(int teeth, double helix_rad) {
  MillingProcess process;
  process.cutter = {teeth, 0.016};
  if (helix_rad > 0.0) process.cutter.helices_rad.assign(static_cast<std::size_t>(teeth), helix_rad);
  process.coefficients = {6.0e8, 2.0e8, 0.0, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, 2e-3, MillingDirection::down);
  return process;
}

template <class Body>
double seconds(const Body& body) {
  const auto start = std::chrono::steady_clock::now();
  body();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void steps_a_second(const char* what, int modes, int teeth, double helix_rad) {
  const RelativeStructure structure = structure_of(modes);
  const MillingProcess process = process_of(teeth, helix_rad);
  const SimulatedPoint point{9000.0, 0.5e-3, 1e-4};
  SimulationOptions options;
  options.settling_turns = 2000;
  options.recorded_turns = 1;
  const MarchGrid grid = march_grid(process, point.depth_m, point.feed_per_tooth_m, options.steps);
  const double steps = 2001.0 * grid.periods_a_turn * grid.steps();
  const double s = seconds([&] { (void)simulate(structure, process, process.coefficients, point, options); });
  std::printf("%-58s %6.0f steps a turn  %8.2e steps/s\n", what, steps / 2001.0, steps / s);
}

void exact_steps_a_second() {
  const MillingProcess process = process_of(2, 0.0);
  SimulationOptions options;
  options.settling_turns = 300;
  options.recorded_turns = 1;
  const double s = seconds([&] {
    (void)simulate_exact_path(structure_of(2), process, process.coefficients, {9000.0, 0.5e-3, 1e-4},
                              shoulder(process.cutter, 2e-3, MillingDirection::down), options, {720, 10});
  });
  std::printf("%-58s %6d steps a turn  %8.2e steps/s\n", "exact paths, 2 modes, 2 straight teeth, 10 earlier passes",
              720, 301.0 * 720.0 / s);
}

void growth() {
  const RelativeStructure structure = structure_of(20);
  const MillingProcess process = process_of(3, std::numbers::pi / 6.0);
  const double s = seconds([&] { (void)simulated_growth(structure, process, 9000.0, 0.5e-3); });
  std::printf("%-58s %31.0f ms\n", "|mu| with its error, 20 modes, 3 teeth, helix 30 degrees", 1e3 * s);
}

void map() {
  const RelativeStructure structure = structure_of(2);
  const MillingProcess process = process_of(2, 0.0);
  constexpr std::size_t speeds = 60, depths = 40;
  SimulationOptions options;
  options.steps.steps_in_cut = 50;
  options.settling_turns = 150;
  options.recorded_turns = 50;
  std::vector<double> range(speeds * depths);
  const double s = seconds([&] {
    thinwall::core::parallel_for(range.size(), [&](std::size_t i) {
      const double rpm = 4000.0 + 16000.0 * static_cast<double>(i % speeds) / (speeds - 1);
      const double depth = 1e-4 * static_cast<double>(1 + i / speeds);
      range[i] =
          simulate(structure, process, process.coefficients, {rpm, depth, 1e-4}, options).displacement_m.range().x();
    });
  });
  std::printf("%-58s %31.2f s\n", "map of 60 x 40 points, 200 turns each, 2 modes, all threads", s);
}

}  // namespace

int main() {
  steps_a_second("circular paths, 2 modes, 2 straight teeth", 2, 2, 0.0);
  steps_a_second("circular paths, 20 modes, 3 teeth, helix 30 degrees", 20, 3, std::numbers::pi / 6.0);
  exact_steps_a_second();
  growth();
  map();
}
