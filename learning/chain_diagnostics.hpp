#pragma once
// The worth of the draws of chains.

#include <Eigen/Core>
#include <vector>

namespace thinwall::learning {

/// Of each unknown.
struct ChainDiagnostics {
  Eigen::VectorXd r_hat;           ///< 1 of chains that have forgotten where they began; above 1.05 they have not
  Eigen::VectorXd effective_size;  ///< independent draws that would tell the mean as well
};

/// Split R̂ and effective sample size (Gelman et al. 2013, Bayesian Data Analysis, Eq. 11.4 and 11.8): each chain is cut
/// into halves; with W the mean variance within them and B/n that of their means,
///
///     R̂ = √((n − 1)/n + (B/n)/W),     n_eff = mn / (1 + 2 Σ ρ_t)
///
/// the sum taken while ρ_{2t} + ρ_{2t+1} is positive (Geyer 1992). An unknown that never moved has R̂ = ∞ and size 1.
/// Throws InputError unless there is a chain, all are of one shape, and have 8 draws. Cost O(unknowns draws²).
[[nodiscard]] ChainDiagnostics diagnose(const std::vector<Eigen::MatrixXd>& chains);

}  // namespace thinwall::learning
