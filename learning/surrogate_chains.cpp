#include "learning/surrogate_chains.hpp"

#include <cmath>
#include <random>

#include "core/dense_factorisations.hpp"
#include "core/draws.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"

namespace thinwall::learning {

namespace {

using Eigen::Index;

/// A uniform number in (0, 1), the same on every machine.
double uniform(std::mt19937& random) {
  return (static_cast<double>(random()) + 0.5) / (static_cast<double>(std::mt19937::max()) + 1.0);
}

/// A place with both densities.
struct Place {
  Eigen::VectorXd x;
  double dear = 0.0, cheap = 0.0;
};

/// One chain on its way.
struct Chain {
  const LogDensity& dear;
  const LogDensity& cheap;
  const Eigen::MatrixXd& L;
  std::mt19937 random;
  double scale = 0.0;
  Place at = {};
  long cheap_tried = 0, cheap_taken = 0, tried = 0, taken = 0;

  [[nodiscard]] Eigen::VectorXd step() {
    Eigen::VectorXd xi(L.rows());
    for (double& entry : xi) entry = core::normal_draw(random);
    return L * xi;
  }

  [[nodiscard]] bool accept(double log_ratio) { return std::log(uniform(random)) < log_ratio; }

  /// Random-walk Metropolis on the cheap density; the share of steps that were taken.
  double walk(Place& place, int steps) {
    int moved = 0;
    for (int i = 0; i < steps; ++i) {
      const Eigen::VectorXd x = place.x + scale * step();
      const double there = cheap(x);
      if (!accept(there - place.cheap)) continue;
      place = {x, place.dear, there};
      ++moved;
    }
    cheap_tried += steps;
    cheap_taken += moved;
    return static_cast<double>(moved) / steps;
  }

  /// A step of random-walk Metropolis on the dear density.
  void step_dear() {
    Place proposed{at.x + scale * step(), 0.0, 0.0};
    proposed.dear = dear(proposed.x);
    proposed.cheap = cheap(proposed.x);
    if (accept(proposed.dear - at.dear)) at = proposed;
  }

  /// One draw; the share of cheap steps that were taken.
  double advance(int steps) {
    step_dear();
    Place proposed = at;
    const double share = walk(proposed, steps);
    if (proposed.x == at.x) return share;
    ++tried;
    proposed.dear = dear(proposed.x);
    if (accept(proposed.dear - at.dear + at.cheap - proposed.cheap)) {
      at = proposed;
      ++taken;
    }
    return share;
  }
};

void require_usable(const Eigen::VectorXd& mode, const Eigen::MatrixXd& covariance, const ChainOptions& options) {
  const bool well = options.chains > 0 && options.draws > 0 && options.left_out >= 0 && options.cheap_steps > 0;
  if (!well) throw core::InputError("chains: their number, draws and steps must be above 0; raise them");
  if (covariance.rows() != mode.size() || covariance.cols() != mode.size())
    throw core::InputError("chains: the covariance must have as many rows and columns as there are unknowns");
}

}  // namespace

Chains surrogate_chains(const LogDensity& dear, const LogDensity& cheap, const Eigen::VectorXd& mode,
                        const Eigen::MatrixXd& covariance, const ChainOptions& options) {
  require_usable(mode, covariance, options);
  const Eigen::LLT<Eigen::MatrixXd> factors(covariance);
  if (factors.info() != Eigen::Success) throw core::InputError("chains: the covariance is not positive definite");
  const Eigen::MatrixXd L = factors.matrixL();
  const auto count = static_cast<std::size_t>(options.chains);
  Chains result{std::vector<Eigen::MatrixXd>(count, Eigen::MatrixXd(mode.size(), options.draws)), 0.0, 0.0};
  std::vector<double> accepted(count), cheap_accepted(count);
  core::Progress progress("draws of the posterior", count * static_cast<std::size_t>(options.draws + options.left_out));
  core::parallel_for(count, [&](std::size_t c) {
    Chain chain{dear, cheap, L, std::mt19937(options.seed + static_cast<unsigned>(c)),
                2.4 / std::sqrt(static_cast<double>(mode.size()))};
    const Eigen::VectorXd start = mode + 1.5 * chain.step();
    chain.at = {start, dear(start), cheap(start)};
    for (int i = -options.left_out; i < options.draws; ++i) {
      const double share = chain.advance(options.cheap_steps);
      if (i < 0) chain.scale *= std::exp(0.5 * (share - 0.33));
      if (i == 0) chain.tried = chain.taken = 0;
      if (i >= 0) result.draws[c].col(i) = chain.at.x;
      progress.step();
    }
    accepted[c] = static_cast<double>(chain.taken) / static_cast<double>(std::max(1L, chain.tried));
    cheap_accepted[c] = static_cast<double>(chain.cheap_taken) / static_cast<double>(chain.cheap_tried);
  });
  for (std::size_t c = 0; c < count; ++c) {
    result.accepted += accepted[c] / static_cast<double>(count);
    result.cheap_accepted += cheap_accepted[c] / static_cast<double>(count);
  }
  return result;
}

}  // namespace thinwall::learning
