// Time of the identification of many postures: bench_identification [POSTURES [LINES]]
//
// A posture is a 4 × 4 matrix of seven modes that are not reciprocal, with noise of 1 % and nothing said of it: poles
// without a guess, weights by scatter, residues of rank one. Postures are shared among the threads.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "core/parallel.hpp"
#include "identification/fit_response.hpp"
#include "tests/identification/random_structure.hpp"

namespace {

using namespace thinwall;

constexpr int modes = 7, sides = 4;

dynamics::ResponseModel posture(unsigned seed, int lines, std::vector<identification::FittedMode>& truth) {
  identification::testing::Draw draw(seed);
  truth = identification::testing::random_modes(draw, modes, sides, sides, 0.06);
  const auto measured = identification::testing::lines_of(truth, lines, 0.01, draw);
  dynamics::DofTable dofs;
  for (int i = 0; i < sides; ++i)
    dofs.push_back({std::to_string(i + 1), Eigen::Vector3d::UnitX(), dynamics::DofKind::translation});
  return {{measured.hz}, dofs, dofs, measured.H};
}

/// The largest relative error of a pole; infinity where their number is another.
double error_of(const identification::ModalFit& fit, const std::vector<identification::FittedMode>& truth) {
  if (fit.modes.size() != truth.size()) return std::numeric_limits<double>::infinity();
  double error = 0.0;
  for (std::size_t r = 0; r < truth.size(); ++r)
    error = std::max(error, std::abs(fit.modes[r].pole() - truth[r].pole()) / std::abs(truth[r].pole()));
  return error;
}

}  // namespace

int main(int argc, char** argv) {
  const auto postures = static_cast<std::size_t>(argc > 1 ? std::atoi(argv[1]) : 112);
  const int lines = argc > 2 ? std::atoi(argv[2]) : 2000;
  std::vector<std::vector<identification::FittedMode>> truth(postures);
  std::vector<dynamics::ResponseModel> measured(postures);
  for (std::size_t i = 0; i < postures; ++i) measured[i] = posture(static_cast<unsigned>(i) + 1, lines, truth[i]);
  std::vector<double> error(postures);
  const auto begin = std::chrono::steady_clock::now();
  core::parallel_for(postures, [&](std::size_t i) {
    error[i] = error_of(identification::fit_response(measured[i], {}).found.fit, truth[i]);
  });
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::sort(error.begin(), error.end());
  const auto right = std::lower_bound(error.begin(), error.end(), 0.1) - error.begin();
  std::printf("%zu postures of %d x %d entries and %d lines on %d threads: %.1f s\n", postures, sides, sides, lines,
              core::thread_count(), seconds);
  std::printf("%td with all modes and no other; median of the largest error of a pole %.2g\n", right,
              error[postures / 2]);
  return 0;
}
