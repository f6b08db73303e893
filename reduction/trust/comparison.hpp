#pragma once
// Reduced models of one part side by side.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "reduction/methods/reduce.hpp"
#include "reduction/trust/band.hpp"

namespace thinwall::reduction {

/// Undamped frequencies of a reduced model in Hz, ascending, of any pencil: from the eigenvalues μ = 1/(λ + α) of (K +
/// αM)⁻¹ M, α = (2π · about_hz)², so that coordinates without mass (μ = 0) and an indefinite K are allowed. Without the
/// `rigid` ones nearest to λ = 0; complex and negative λ, which only indefinite models have, are left out. Accurate
/// around and below about_hz (relative ε α/λ for low ones). Cost O(n³).
[[nodiscard]] Eigen::VectorXd natural_frequencies_hz(const ReducedModel& model, int rigid, double about_hz);

/// A line of the table.
struct ComparisonRow {
  Method method = Method::craig_bampton;
  int size = 0;                              ///< coordinates, or pairs of poles
  int modes = 0;                             ///< elastic modes kept
  double max_relative_frequency_error = 0;   ///< of the natural frequencies in the band; infinite if there are too few
  double max_relative_receptance_error = 0;  ///< Eq. 13, the largest of the band
  double seconds = 0.0;
  linalg::EigenStatus status = linalg::EigenStatus::converged;
};

/// One reduced model against the full one. Cost: lines · n³.
[[nodiscard]] ComparisonRow compared(const Reduction& reduction, const BandTruth& truth, const Band& band);

/// All methods that can have `size` coordinates (Guyan's has the interface's alone, and is there for comparison; a
/// reduced interface has as many amplitudes as options.characteristic says, no more than the interface has DOFs; poles
/// are for held parts). Errors as reduce() and band_truth(). Cost: all reductions, and lines · size³ each.
[[nodiscard]] std::vector<ComparisonRow> compare(const FullModel& full, const Interface& interface, const Band& band,
                                                 int size, const ReductionOptions& options = {});

/// The rows as text, a header line first.
[[nodiscard]] std::string text(const std::vector<ComparisonRow>& rows);

}  // namespace thinwall::reduction
