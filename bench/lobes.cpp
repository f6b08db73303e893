// Times of stability charts: the two-DOF benchmark, a plate backed by a robot with 20 modes, at one point and along a
// path, a map of |mu|; beside a dense semi-discretization as the literature writes it.

#include "milling/chart/lobes.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <numbers>

#include "bench/dense_semi_discretization.hpp"
#include "milling/chart/lobe_field.hpp"
#include "milling/chart/sampled_stability.hpp"
#include "milling/chart/stability_map.hpp"

namespace {

using namespace thinwall::milling;
using Eigen::Index;

constexpr thinwall::bench::TwoDofMill two_dof{2.0 * std::numbers::pi * 922.0, 0.011, 0.03993, 6e8, 2e8, 2, 0.1};

/// Median seconds of three calls.
template <class Work>
double seconds(const Work& work) {
  std::array<double, 3> all{};
  for (double& s : all) {
    const auto start = std::chrono::steady_clock::now();
    work();
    s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  std::sort(all.begin(), all.end());
  return all[1];
}

void add_mode(RelativeStructure& s, double hz, double zeta, double mass, const Eigen::Vector3d& shape) {
  const double omega = 2.0 * std::numbers::pi * hz;
  const Index k = s.poles.size();
  s.poles.conservativeResize(k + 1);
  s.phi.conservativeResize(3, k + 1);
  s.b.conservativeResize(3, k + 1);
  s.poles(k) = {-zeta * omega, omega * std::sqrt(1.0 - zeta * zeta)};
  s.phi.col(k) = shape.cast<std::complex<double>>();
  s.b.col(k) = shape / std::complex<double>(0.0, 2.0 * s.poles(k).imag() * mass);
}

RelativeStructure two_modes() {
  RelativeStructure s;
  add_mode(s, 922.0, two_dof.zeta, two_dof.mass, Eigen::Vector3d::UnitX());
  add_mode(s, 922.0, two_dof.zeta, two_dof.mass, Eigen::Vector3d::UnitY());
  return s;
}

MillingProcess two_teeth() {
  MillingProcess process;
  process.cutter = {two_dof.teeth, 0.01};
  process.coefficients = {two_dof.K_t, two_dof.K_r, 0.0, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, two_dof.immersion * 0.01, MillingDirection::down);
  return process;
}

/// Made-up modes in the manner of a clamped plate with a robot behind it: 17 of the plate from 275 Hz to 5 kHz, motion
/// through the thickness (x) with a little along the edge, one of the robot, two of the tool. `along`: place on a path,
/// 0 to 1, over which the plate's shapes have one to four waves.
RelativeStructure plate_robot_tool(double along = 0.0) {
  RelativeStructure s;
  for (int k = 0; k < 17; ++k) {
    const double hz = 275.0 * std::pow(5000.0 / 275.0, k / 16.0);
    add_mode(s, hz, k < 2 ? 0.05 : 0.01, 1.0,
             {1.5 + 0.5 * std::sin(3.0 * k + 2.0 * std::numbers::pi * along * (1 + k % 4)), 0.1 * std::cos(2.0 * k),
              0.05 * std::sin(5.0 * k)});
  }
  add_mode(s, 38.0, 0.02, 40.0, Eigen::Vector3d::UnitX());
  add_mode(s, 1650.0, 0.02, 0.5, Eigen::Vector3d::UnitX());
  add_mode(s, 1710.0, 0.02, 0.5, Eigen::Vector3d::UnitY());
  return s;
}

MillingProcess six_teeth() {
  MillingProcess process;
  process.cutter = {6, 0.016};
  process.coefficients = {2.0e9, 0.8e9, 0.3e9, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, 0.2e-3, MillingDirection::down);
  process.frame = {Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
  return process;
}

void boundary_of_two_dof() {
  const std::vector<double> rpm = spindle_speeds(5000.0, 25000.0, 400);
  StabilityOptions options;
  options.depth_limit_m = 0.01;
  Lobes lobes;
  const double time = seconds([&] { lobes = stability_lobes(two_modes(), two_teeth(), rpm, options); });
  options.error_tolerance = 1e-9;
  const Lobes exact = stability_lobes(two_modes(), two_teeth(), rpm, options);
  double error = 0.0;
  for (std::size_t i = 0; i < rpm.size(); ++i)
    error = std::max(error, std::abs(lobes.rows[i].limiting_depth_m / exact.rows[i].limiting_depth_m - 1.0));
  std::printf("two DOFs, a/D 0.1, all branches at 400 speeds      %8.3f s   depth error %.1e, worst estimate %.1e\n",
              time, error, lobes.worst_error_estimate);
}

void plate(const char* what, double follow) {
  StabilityOptions options;
  options.follow = follow;
  Lobes lobes;
  const double time = seconds(
      [&] { lobes = stability_lobes(plate_robot_tool(), six_teeth(), spindle_speeds(1000.0, 3000.0, 400), options); });
  std::size_t crossings = 0;
  for (const LobeRow& row : lobes.rows) crossings += row.crossings.size();
  std::printf("%-50s %8.3f s   %zu crossings, worst estimate %.1e, %d not converged\n", what, time, crossings,
              lobes.worst_error_estimate, lobes.rows_not_converged);
}

void path_along_plate() {
  constexpr int positions = 50;
  std::vector<RelativeStructure> structures;
  structures.reserve(positions);
  for (int i = 0; i < positions; ++i) structures.push_back(plate_robot_tool(i / (positions - 1.0)));
  const auto start = std::chrono::steady_clock::now();  // once: it is long enough
  const LobeField field = lobe_field(structures, six_teeth(), spindle_speeds(1000.0, 3000.0, 400), {});
  const double time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const auto weakest = std::min_element(field.minimum_depth_m.begin(), field.minimum_depth_m.end());
  std::printf("the same at 50 positions, limit at 400 speeds       %8.3f s   weakest position %td, %d not converged\n",
              time, weakest - field.minimum_depth_m.begin() + 1, field.rows_not_converged);
}

/// Two modes of a tool as lines 2 Hz apart up to 5998 Hz, tool axes.
SampledReceptance tool_lines() {
  RelativeStructure tool;
  add_mode(tool, 1650.0, 0.02, 0.5, Eigen::Vector3d::UnitX());
  add_mode(tool, 1710.0, 0.02, 0.5, Eigen::Vector3d::UnitY());
  SampledReceptance lines{Eigen::VectorXd::LinSpaced(2990, 20.0, 5998.0), {}};
  for (const double hz : lines.frequency_hz) lines.H.push_back(receptance(tool, 2.0 * std::numbers::pi * hz));
  return lines;
}

/// Four teeth with a helix of 30° on the plate at three places, without and with a measured tool: the
/// processor's time a row, whatever else it does.
void helix_along_plate() {
  MillingProcess process;
  process.cutter = {4, 0.010};
  process.cutter.helices_rad.assign(4, std::numbers::pi / 6.0);
  process.coefficients = {6e8, 2e8, 0.0, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, 1e-3, MillingDirection::down);
  process.frame = {Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
  StabilityOptions options;
  options.depth_limit_m = 0.01;
  const std::vector<RelativeStructure> structures{plate_robot_tool(0.0), plate_robot_tool(0.5), plate_robot_tool(1.0)};
  const std::vector<double> rpm = spindle_speeds(6000.0, 16000.0, 40);
  const auto timed = [&](const char* what, const std::function<LobeField()>& field_of) {
    const std::clock_t start = std::clock();
    const LobeField field = field_of();
    const double time = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    std::printf("%-50s %8.1f ms of the processor a row, %d not converged\n", what,
                1e3 * time / static_cast<double>(structures.size() * rpm.size()), field.rows_not_converged);
  };
  timed("four helical teeth, 20 modes, along a path", [&] { return lobe_field(structures, process, rpm, options); });
  const FittedStructure tool = fitted_structure({tool_lines(), {}}, process.frame);
  timed("the same and a measured tool, its fit not counted",
        [&] { return lobe_field(tool, structures, process, rpm, options); });
}

void map_of_two_dof() {
  const std::vector<double> rpm = spindle_speeds(5000.0, 25000.0, 400);
  std::vector<double> depths;
  for (int i = 1; i <= 200; ++i) depths.push_back(4e-3 * i / 200);
  StabilityMap map;
  const double time = seconds([&] { map = stability_map(two_modes(), two_teeth(), rpm, depths, {}); });
  std::printf("|mu| map 400 x 200, two DOFs                       %8.3f s   worst estimate %.1e\n", time,
              map.worst_error_estimate);
  constexpr int m = 40;
  const std::vector<double> some = spindle_speeds(5000.0, 25000.0, 20);
  double worst = 0.0;
  const double dense = seconds([&] {
    for (const double speed : some) (void)dense_semi_discretization(two_dof, speed, 2e-3, m);
  });
  for (const double speed : some) {
    const double exact = multiplier_at(two_modes(), two_teeth(), speed, 2e-3, {}).modulus;
    worst = std::max(worst, std::abs(dense_semi_discretization(two_dof, speed, 2e-3, m) - exact));
  }
  std::printf(
      "dense semi-discretization, m = %d                  %8.0f s   one thread, 80000 points from %zu; |mu| wrong by "
      "up "
      "to %.1e; %.0f times the map's\n",
      m, dense / static_cast<double>(some.size()) * 80000.0, some.size(), worst,
      dense / static_cast<double>(some.size()) * 80000.0 / time);
}

}  // namespace

int main() {
  boundary_of_two_dof();
  plate("plate, robot, tool, 20 modes, limit at 400 speeds", 1.0);
  plate("the same, all branches to 20 times the limit", 20.0);
  path_along_plate();
  helix_along_plate();
  map_of_two_dof();
}
