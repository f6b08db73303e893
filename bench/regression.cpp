// Gaussian processes under the clock: 24 numbers at 112 postures, learned with the search for their hyper-parameters,
// each alone, in groups of three as Lei 2022 does, and all together.

#include <chrono>
#include <cmath>
#include <cstdio>
#include <vector>

#include "regression/averaged_process.hpp"
#include "regression/gaussian_process.hpp"

namespace thinwall::regression {

namespace {

/// The grid of the paper: four by four places of the tip and seven angles of the table, scaled to −1 … 1.
Eigen::MatrixXd postures() {
  Eigen::MatrixXd places(112, 3);
  Eigen::Index row = 0;
  for (int x = 0; x < 4; ++x) {
    for (int y = 0; y < 4; ++y) {
      for (int k = 0; k < 7; ++k) places.row(row++) << 2.0 * x / 3.0 - 1.0, 2.0 * y / 3.0 - 1.0, k / 3.0 - 1.0;
    }
  }
  return places;
}

/// Tasks that mix four smooth functions of the place, with 5 to 40 % of noise.
TaskData mixed(Eigen::Index tasks) {
  TaskData data{postures(), {}};
  const Eigen::ArrayXd x = data.inputs.col(0), y = data.inputs.col(1), k = data.inputs.col(2);
  Eigen::MatrixXd sources(data.places(), 4);
  sources << (1.3 * x + 0.4 * y).sin(), (x * y + k).cos(), (1.7 * k - 0.6 * x).sin() * (0.5 * y).exp(), x.square() + k;
  data.targets.resize(data.places(), tasks);
  double drawn = 0.5;
  for (Eigen::Index t = 0; t < tasks; ++t) {
    const double at = 1.0 + static_cast<double>(t);
    data.targets.col(t) = sources * Eigen::Vector4d(std::sin(at), std::cos(2.1 * at), std::sin(3.7 * at), 0.5);
    for (double& value : data.targets.col(t)) {
      drawn = 3.99 * drawn * (1.0 - drawn);
      value += (0.05 + 0.35 * (t % 3) / 2.0) * (drawn - 0.5);
    }
  }
  return standardised(data).data;
}

void timed(const char* what, const TaskData& data, Eigen::Index of_group, const SearchOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  double sum = 0.0;
  int reached = 0, starts = 0;
  for (Eigen::Index first = 0; first < data.tasks(); first += of_group) {
    const Fit found = fit({data.inputs, data.targets.middleCols(first, of_group)}, options);
    sum += found.log_likelihood;
    for (const double value : found.of_starts) reached += value > found.log_likelihood - 1e-4 ? 1 : 0;
    starts += static_cast<int>(found.of_starts.size());
  }
  const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf("%-28s  %7.2f s  ln p %11.4f  %3d of %3d starts reach the best\n", what, s, sum, reached, starts);
  std::fflush(stdout);
}

void timed_average(const TaskData& data) {
  const auto start = std::chrono::steady_clock::now();
  for (Eigen::Index t = 0; t < data.tasks(); ++t) (void)AveragedProcess({data.inputs, data.targets.col(t)});
  const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf("%-28s  %7.2f s\n", "24 averages, one thread", s);
}

}  // namespace

}  // namespace thinwall::regression

int main() {
  using namespace thinwall::regression;
  const TaskData data = mixed(24);
  timed("24 processes of one task", data, 1, {});
  timed("8 processes of three tasks", data, 3, {});
  timed_average(data);
  timed("1 process of 24 tasks", data, 24, {});
}
