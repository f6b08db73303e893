// Kernels of the stability search, by Google Benchmark: a speed's grid and loop, the gain on the circle, its search,
// the count of multipliers. Argument: modes.

#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "milling/direct/critical_depths.hpp"
#include "milling/direct/cut_at_speed.hpp"

namespace {

using namespace thinwall::milling;

RelativeStructure structure_of(int modes) {
  RelativeStructure s{Eigen::VectorXcd(modes), Eigen::Matrix3Xcd(3, modes), Eigen::Matrix3Xcd(3, modes)};
  for (int k = 0; k < modes; ++k) {
    const double omega = 2.0 * std::numbers::pi * 300.0 * std::pow(16.0, (k + 0.5) / modes);
    s.poles(k) = {-0.015 * omega, omega};
    const Eigen::Vector3d shape(1.5 + 0.5 * std::sin(3.0 * k), std::cos(2.0 * k), 0.0);
    s.phi.col(k) = shape.cast<std::complex<double>>();
    s.b.col(k) = shape / std::complex<double>(0.0, 2.0 * omega);
  }
  return s;
}

MillingProcess process_of() {
  MillingProcess process;
  process.cutter = {4, 0.016};
  process.coefficients = {2.0e9, 0.8e9, 0.0, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, 1e-3, MillingDirection::down);
  return process;
}

struct Prepared {
  MillingProcess process = process_of();
  CutAtSpeed cut;
  double depth_m;
  Resolution resolution;
  DiscreteCut d;

  explicit Prepared(int modes)
      : cut(cut_at_speed(structure_of(modes), process, 4000.0)),
        depth_m(8.0 * surely_stable_depth_m(cut)),
        resolution(resolving(cut, depth_m)),
        d(discrete(cut, resolution, 0.0)) {}
};

void grid_and_loop(benchmark::State& state) {
  const Prepared p(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(discrete(p.cut, p.resolution, 0.0));
  state.counters["nodes"] = static_cast<double>(p.d.grid.node_rad.size());
}

void gain_on_circle(benchmark::State& state) {
  const Prepared p(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(loop_gain(p.d.loop, std::polar(1.0, 1.0)));
}

void crossings_of_a_speed(benchmark::State& state) {
  const Prepared p(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(CriticalDepths(gain_of(p.d)).up_to(4.0 * p.depth_m));
}

void crossing_to_axis(benchmark::State& state) {
  const Prepared p(static_cast<int>(state.range(0)));
  const GainOnCircle gain = gain_of(p.d);
  const std::vector<Crossing> found = CriticalDepths(gain).up_to(20.0 * p.depth_m);
  if (found.empty()) return state.SkipWithError("no crossing");
  for (auto _ : state) {
    Crossing crossing = found.front();
    benchmark::DoNotOptimize(refine(gain, crossing));
  }
}

void count_of_multipliers(benchmark::State& state) {
  const Prepared p(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(unstable(p.d, p.depth_m));
}

BENCHMARK(grid_and_loop)->Arg(2)->Arg(20);
BENCHMARK(gain_on_circle)->Arg(2)->Arg(20);
BENCHMARK(crossings_of_a_speed)->Arg(2)->Arg(20);
BENCHMARK(crossing_to_axis)->Arg(2)->Arg(20);
BENCHMARK(count_of_multipliers)->Arg(2)->Arg(20);

}  // namespace

BENCHMARK_MAIN();
