#pragma once
// Draws from a density that is dear to evaluate, by chains that move with a cheap one that is close to it.

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace thinwall::learning {

/// The ln of a density up to a constant.
using LogDensity = std::function<double(const Eigen::VectorXd& x)>;

/// A mean and a covariance: where a density has a maximum, and how wide it is there.
struct Region {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

/// The run of the chains.
struct ChainOptions {
  int chains = 4;
  int draws = 200;        ///< that are kept of each
  int left_out = 50;      ///< before these
  int cheap_steps = 100;  ///< of the cheap density between two draws
  unsigned seed = 1;      ///< chain k has its own generator, of seed + k
};

/// The draws of each chain, a column each, and how many of the steps were taken.
struct Chains {
  std::vector<Eigen::MatrixXd> draws;  ///< unknowns × draws
  double accepted = 0.0;               ///< share of the dear density's steps
  double cheap_accepted = 0.0;         ///< share of the cheap density's small steps
};

/// Metropolis chains after Liu (2001, ch. 9.4.3, "surrogate transition"): some steps on `cheap` make one proposal x',
/// which is accepted with
///
///     min(1, π(x') π̂(x) / (π(x) π̂(x')))
///
/// so that the chain has the density π whatever the surrogate π̂; a close one makes nearly every proposal accepted and
/// the draws nearly independent. A plain step on π before every fourth proposal leads away from places where π̂ is much
/// too low, at which the proposals would leave the chain for long.
///
/// Most of the cheap steps are x + s L ξ, ξ standard normal, L Lᵀ the covariance of a region that is drawn; s, 2.4/√n
/// at first (Roberts, Gelman & Gilks 1997), adapts in the draws that are left out (Haario et al. 2001 in its simplest
/// form), to a third of the steps accepted, and stays then. One in ten, at random, is a draw from the normal
/// distributions of the regions, a little wider, which takes chains from one maximum to another across what lies
/// between (an independence sampler, Tierney 1994). Chain k begins about region k mod their number, at 1.5 of its
/// deviations; the chains run on the threads and depend on the seed alone. Throws InputError for options below 1, no
/// region, sizes that differ or a covariance that is not positive definite. Cost: 1.25 chains × (draws + left_out) of
/// the dear density.
[[nodiscard]] Chains surrogate_chains(const LogDensity& dear, const LogDensity& cheap,
                                      const std::vector<Region>& regions, const ChainOptions& options);

}  // namespace thinwall::learning
