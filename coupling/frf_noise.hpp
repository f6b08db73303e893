#pragma once
// The scatter of measured FRFs: deviations from their coherence or as stated, and random draws with a seed.

#include <cstdint>
#include <vector>

#include "dynamics/response_model.hpp"

namespace thinwall::coupling {

/// The standard deviation σ of the real part, and equally of the imaginary part, of every FRF, in the FRF's unit: one
/// matrix for each line, with the shape of H. The error of an averaged FRF has no preferred phase (its modulus scatters
/// by σ, its phase by σ/|H|: Bendat & Piersol 2010, chapter 9), so that one number suffices: the covariance of (Re, Im)
/// is σ² I₂, and remains a multiple of I₂ under every complex linear map. FRFs are taken as independent of each other
/// and from line to line.
using Deviations = std::vector<Eigen::MatrixXd>;

/// The deviations σ = share · |H|. Throws InputError unless the share is finite and not negative, or as
/// require_complete() does.
[[nodiscard]] Deviations relative_deviations(const dynamics::ResponseModel& model, double share);

/// The deviations σ = |H| √((1 − γ²)/(2 n γ²)) of an H₁ estimate from n averages of coherence γ² (Bendat & Piersol
/// 2010, chapter 9, random error of gain factors; leading order, valid if small against 1). `coherence`: one matrix for
/// each line, with the shape of H. Throws InputError, which names the first faulty line, unless 0 < γ² ≤ 1, n ≥ 1 and
/// the shapes agree.
[[nodiscard]] Deviations deviations_from_coherence(const dynamics::ResponseModel& model,
                                                   const std::vector<Eigen::MatrixXd>& coherence, int averages);

/// Throws InputError unless there is one matrix for each line with the shape of H, finite and not negative.
void require_valid(const Deviations& deviations, const dynamics::ResponseModel& model);

/// The response with random errors, H + σ (a + ib) with a and b standard normal and independent, drawn line by line
/// from std::mt19937_64 with this seed.
[[nodiscard]] dynamics::ResponseModel with_noise(dynamics::ResponseModel model, const Deviations& deviations,
                                                 std::uint64_t seed);

}  // namespace thinwall::coupling
