#pragma once
// Comparison of different reduced models of one part.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "reduction/methods/reduce.hpp"
#include "reduction/trust/band.hpp"

namespace thinwall::reduction {

/// The undamped frequencies of a reduced model in Hz, ascending, from the eigenvalues μ = 1/(λ + α) of (K + αM)⁻¹ M, α
/// = (2π · about_hz)². Coordinates without mass (μ = 0) and an indefinite K are therefore allowed. The `rigid`
/// eigenvalues nearest to λ = 0 are left out, and so are complex and negative λ, which only indefinite models have. The
/// result is accurate around and below about_hz (relative error ε α/λ for low frequencies). Cost O(n³).
[[nodiscard]] Eigen::VectorXd natural_frequencies_hz(const ReducedModel& model, int rigid, double about_hz);

/// A row of the comparison.
struct ComparisonRow {
  Method method = Method::craig_bampton;
  int size = 0;                              ///< coordinates, or pairs of poles
  int modes = 0;                             ///< elastic modes kept
  double max_relative_frequency_error = 0;   ///< over frequencies in the band; infinite if some are missing
  double max_relative_receptance_error = 0;  ///< largest relative_error() of the band
  double seconds = 0.0;
  linalg::EigenStatus status = linalg::EigenStatus::converged;
};

/// The comparison of one reduced model with the full one. Cost: lines · n³.
[[nodiscard]] ComparisonRow compared(const Reduction& reduction, const BandTruth& truth, const Band& band);

/// The comparison of all methods that can have `size` coordinates. Guyan's model has the interface's only and is
/// included for comparison; a reduced interface has options.characteristic amplitudes, but no more than the interface
/// has DOFs; modal truncation is included for held parts only. Throws as reduce() and band_truth() do. Cost: all
/// reductions, and lines · size³ for each.
[[nodiscard]] std::vector<ComparisonRow> compare(const FullModel& full, const Interface& interface, const Band& band,
                                                 int size, const ReductionOptions& options = {});

/// The rows as a table of text with a header line.
[[nodiscard]] std::string text(const std::vector<ComparisonRow>& rows);

}  // namespace thinwall::reduction
