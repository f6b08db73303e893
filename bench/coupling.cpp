// Time of the receptance coupling: a part's tip (3 × 3) held by a robot (3 × 3) in 50 postures, 10 000 lines.
//   bench_coupling [THREADS] [POSTURES] [LINES]      2, 50 and 10 000 if left out
// The part's modal sum is there before the clock starts; the robot's response of each posture, by its modes, is timed
// beside the coupling. Joined in one direction and in three, rigidly, the nine entries of the part. Seconds by the wall
// clock, and of processor time over the threads, which is what a machine shared with others allows to compare.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <numbers>
#include <vector>

#include "bench/stages.hpp"
#include "core/parallel.hpp"
#include "coupling/receptance.hpp"
#include "dynamics/conversion.hpp"

namespace {

using namespace thinwall;

/// `modes` modes from 150 Hz to 4 kHz with shapes in all three directions, 1 %.
dynamics::ModalModel structure(const std::string& point, int modes, double mass, double turn) {
  dynamics::SpatialModel model;
  const Eigen::Index n = modes;
  Eigen::VectorXd omega(n);
  model.T.resize(3, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    omega(k) = 2.0 * std::numbers::pi * (20.0 + 130.0 * static_cast<double>(k + 1));
    const double angle = turn + static_cast<double>(k);
    model.T.col(k) << std::cos(angle), std::sin(angle), std::cos(2.0 * angle);
  }
  model.T /= std::sqrt(mass);
  model.M = Eigen::MatrixXd::Identity(n, n);
  model.K = omega.cwiseAbs2().asDiagonal();
  model.C = (0.02 * omega).asDiagonal();
  model.dofs = dynamics::translations(point);
  return dynamics::to_modal(model);
}

void measure(int postures, const dynamics::ResponseModel& part, const std::vector<dynamics::ModalModel>& robots,
             int directions, double component_error) {
  coupling::Contact contact{"P", "R", {}};
  for (int i = 0; i < directions; ++i) {
    coupling::ContactSpring spring;
    spring.direction = Eigen::Vector3d::Unit(i);
    contact.springs.push_back(spring);
  }
  double synthesis_s = 0.0, coupling_s = 0.0, processor_s = 0.0, condition = 0.0;
  bench::Stopwatch watch;
  for (int i = 0; i < postures; ++i) {
    const auto robot = dynamics::to_response(robots[static_cast<std::size_t>(i)], part.axis);
    synthesis_s += watch.lap();
    const std::clock_t before = std::clock();
    const auto coupled =
        coupling::couple(part, robot, {contact}, {.component_error = component_error, .points = {"P"}});
    condition = std::max(condition, coupled.kernel_condition.maxCoeff());
    processor_s += static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
    coupling_s += watch.lap();
  }
  std::printf("%d direction%s, %s: coupling %.3f s, processor time %.3f s; the robot's responses %.3f s\n", directions,
              directions > 1 ? "s" : " ", component_error > 0.0 ? "with error bounds" : "responses only   ", coupling_s,
              processor_s / core::thread_count(), synthesis_s);
  if (!(condition < 1e6)) std::printf("  the kernel's condition reached %.1e\n", condition);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    core::set_thread_count(argc > 1 ? std::max(1, std::atoi(argv[1])) : 2);
    const int postures = argc > 2 ? std::max(1, std::atoi(argv[2])) : 50;
    const int lines = argc > 3 ? std::max(2, std::atoi(argv[3])) : 10000;
    const auto axis = dynamics::linear_axis(0.5, 5000.0, lines);
    const auto part = dynamics::to_response(structure("P", 30, 1.0, 0.3), axis);
    std::vector<dynamics::ModalModel> robots;
    for (int i = 0; i < postures; ++i) robots.push_back(structure("R", 6, 50.0, 0.1 * i));
    std::printf("%d postures, %d lines, nine entries, %d threads\n", postures, lines, core::thread_count());
    for (const int directions : {1, 3}) {
      for (const double component_error : {0.0, 0.01}) measure(postures, part, robots, directions, component_error);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_coupling: %s\n", error.what());
    return 1;
  }
}
