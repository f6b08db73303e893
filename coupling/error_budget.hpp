#pragma once
// The error of a coupled response that follows from errors of the components: scatter of measurements and truncation of
// reductions.

#include <cstdint>
#include <string>
#include <vector>

#include "coupling/frf_noise.hpp"
#include "coupling/sensitivity.hpp"

namespace thinwall::coupling {

/// The known errors of one component, in the shape of its H, one matrix for each frequency line; empty if it is exact
/// in that respect.
struct ComponentError {
  Deviations noise{};  ///< independent between entries and lines
  /// Model less truth, signed: of a reduction at lines where the full model is known, or of rotations by differences.
  std::vector<Eigen::MatrixXcd> truncation{};
};

/// The errors of a coupled response over its lines and entries, for the bands of a plot.
struct ErrorBudget {
  dynamics::DofTable responses, forces;
  Deviations noise;                          ///< the same for real and imaginary part
  std::vector<Eigen::MatrixXcd> truncation;  ///< signed
};

/// The errors of a coupled response to first order, dG = P dY Q (coupling/sensitivity.hpp; docs/theory/coupling.md, Eq.
/// 21). Independent FRFs with deviations σ_kl give
///
///     σ²(G_ij) = Σ_kl |P_ik|² σ_kl² |Q_lj|²
///
/// for the real and for the imaginary part, uncorrelated, because multiplication by a complex factor leaves circular
/// noise circular. The truncation is P ΔY Q. An entry deviates by more than k deviations with probability e^{−k²/2}.
/// First order holds if the noise is small beside the kernel's smallest singular value; sampled_scatter() shows whether
/// it is. `errors`: one for each component, in order. Throws InputError as couple() does, or for errors of another
/// shape. Cost lines · n³.
[[nodiscard]] ErrorBudget error_budget(const std::vector<dynamics::ResponseModel>& components,
                                       const std::vector<Contact>& contacts, const std::vector<ComponentError>& errors,
                                       const CouplingOptions& options = {});

/// The covariance E[v vᴴ] of selected entries v = (G_i1j1, G_i2j1, …), column by column over `responses` × `forces`
/// (DOF names), to first order, one matrix for each line, (m/N)²; its diagonal is 2σ². Entries of one G have correlated
/// errors, and the correlation matters for their effect on a cut. E[v vᵀ] = 0. Arguments and errors are those of
/// error_budget(); throws InputError for unknown names too.
[[nodiscard]] std::vector<Eigen::MatrixXcd> entry_covariance(const std::vector<dynamics::ResponseModel>& components,
                                                             const std::vector<Contact>& contacts,
                                                             const std::vector<ComponentError>& errors,
                                                             const std::vector<std::string>& responses,
                                                             const std::vector<std::string>& forces,
                                                             const CouplingOptions& options = {});

/// The statistics of G over repeated draws of the components: its mean, and the covariance [rr ri; ri ii] of the real
/// and imaginary part of every entry. If this differs from σ² I₂ of error_budget(), first order does not hold.
struct SampledScatter {
  dynamics::DofTable responses, forces;
  std::vector<Eigen::MatrixXcd> mean;
  std::vector<Eigen::MatrixXd> rr, ri, ii;
};

/// The scatter of G over `samples` ≥ 2 couplings of draws H + σ (a + ib) (with_noise(), with seeds from `seed` on);
/// truncations are left out. A deviation estimated from n draws has itself the relative deviation 1/√(2n). Throws as
/// error_budget() does, and NumericalError if a draw makes the kernel singular. Cost: `samples` couplings.
[[nodiscard]] SampledScatter sampled_scatter(const std::vector<dynamics::ResponseModel>& components,
                                             const std::vector<Contact>& contacts,
                                             const std::vector<ComponentError>& errors, int samples, std::uint64_t seed,
                                             const CouplingOptions& options = {});

}  // namespace thinwall::coupling
