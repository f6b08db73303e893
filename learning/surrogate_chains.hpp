#pragma once
// Draws from a density that is dear to evaluate, by chains that move with a cheap one that is close to it.

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace thinwall::learning {

/// The ln of a density up to a constant.
using LogDensity = std::function<double(const Eigen::VectorXd& x)>;

/// The run of the chains.
struct ChainOptions {
  int chains = 4;
  int draws = 200;       ///< that are kept of each
  int left_out = 50;     ///< before these
  int cheap_steps = 20;  ///< of the cheap density between two draws
  unsigned seed = 1;     ///< chain k has its own generator, of seed + k
};

/// The draws of each chain, a column each, and how many of the steps were taken.
struct Chains {
  std::vector<Eigen::MatrixXd> draws;  ///< unknowns × draws
  double accepted = 0.0;               ///< share of the dear density's steps
  double cheap_accepted = 0.0;         ///< share of the cheap density's
};

/// Metropolis chains after Liu (2001, ch. 9.4.3, "surrogate transition"): some steps of random-walk Metropolis on
/// `cheap` make one proposal x', which is accepted with
///
///     min(1, π(x') π̂(x) / (π(x) π̂(x')))
///
/// so that the chain has the density π whatever the surrogate π̂; a close one makes nearly every proposal accepted and
/// the draws nearly independent. A plain step on π before each proposal leads away from places where π̂ is much too low,
/// at which the proposals would leave the chain for long. A cheap step is x + s L ξ, L Lᵀ the `covariance`, ξ standard
/// normal; s, 2.4/√n at first (Roberts, Gelman & Gilks 1997), adapts in the draws that are left out (Haario et al. 2001
/// in its simplest form), to a third of the steps accepted, and stays then. Chains begin at `mode` + 1.5 L ξ and run on
/// the threads; they depend on the seed alone. Throws InputError for options below 1, sizes that differ or a covariance
/// that is not positive definite. Cost: 2 chains × (draws + left_out) of the dear density.
[[nodiscard]] Chains surrogate_chains(const LogDensity& dear, const LogDensity& cheap, const Eigen::VectorXd& mode,
                                      const Eigen::MatrixXd& covariance, const ChainOptions& options);

}  // namespace thinwall::learning
