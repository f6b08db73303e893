#pragma once
// What the errors of the components make of a coupled response: scatter of measurements, truncation of reductions.

#include <cstdint>
#include <string>
#include <vector>

#include "coupling/frf_noise.hpp"
#include "coupling/sensitivity.hpp"

namespace thinwall::coupling {

/// What is known of one component's errors, in the shape of its H, one matrix a line; empty: exact in that respect.
struct ComponentError {
  Deviations noise{};                          ///< independent from entry to entry, line to line
  std::vector<Eigen::MatrixXcd> truncation{};  ///< model less truth, signed: of a reduction at lines where the full
                                               ///< model is known, or of rotations by differences
};

/// Of a coupled response, line by line over its entries; for a plot's bands.
struct ErrorBudget {
  dynamics::DofTable responses, forces;
  Deviations noise;                          ///< of real and imaginary part alike
  std::vector<Eigen::MatrixXcd> truncation;  ///< signed
};

/// First order, dG = P dY Q (coupling/sensitivity.hpp). FRFs that are independent with deviations σ_kl give
///
///     σ²(G_ij) = Σ_kl |P_ik|² σ_kl² |Q_lj|²
///
/// for real and imaginary part, uncorrelated, for a complex factor turns circular noise into circular noise; and a
/// truncation P ΔY Q. An entry is outside of k deviations with probability e^{−k²/2}, as far as first order goes: the
/// noise must be small beside the kernel's smallest singular value (sampled_scatter() tells). `errors`: one a
/// component, in order. Throws InputError as couple(), or for errors of another shape. Cost lines · n³.
[[nodiscard]] ErrorBudget error_budget(const std::vector<dynamics::ResponseModel>& components,
                                       const std::vector<Contact>& contacts, const std::vector<ComponentError>& errors,
                                       const CouplingOptions& options = {});

/// Covariance E[v vᴴ] of some entries v = (G_i1j1, G_i2j1, …), column by column over `responses` × `forces` (DOF
/// names), first order, one matrix a line, (m/N)²: 2σ² on its diagonal. Entries of one G scatter together, which
/// decides what a cut feels. E[v vᵀ] = 0. Errors and arguments as error_budget(), and InputError for unknown names.
[[nodiscard]] std::vector<Eigen::MatrixXcd> entry_covariance(const std::vector<dynamics::ResponseModel>& components,
                                                             const std::vector<Contact>& contacts,
                                                             const std::vector<ComponentError>& errors,
                                                             const std::vector<std::string>& responses,
                                                             const std::vector<std::string>& forces,
                                                             const CouplingOptions& options = {});

/// What G does when components are drawn again and again: its mean, and the covariance [rr ri; ri ii] of the real and
/// imaginary part of every entry. Where it is not σ² I₂ of error_budget(), first order does not hold.
struct SampledScatter {
  dynamics::DofTable responses, forces;
  std::vector<Eigen::MatrixXcd> mean;
  std::vector<Eigen::MatrixXd> rr, ri, ii;
};

/// Couples `samples` ≥ 2 draws H + σ (a + ib) (with_noise(), seeds from `seed` on); truncations take no part. A
/// deviation from n draws is itself known to 1/√(2n). Errors as error_budget(); NumericalError where a draw makes the
/// kernel singular. Cost: `samples` couplings.
[[nodiscard]] SampledScatter sampled_scatter(const std::vector<dynamics::ResponseModel>& components,
                                             const std::vector<Contact>& contacts,
                                             const std::vector<ComponentError>& errors, int samples, std::uint64_t seed,
                                             const CouplingOptions& options = {});

}  // namespace thinwall::coupling
