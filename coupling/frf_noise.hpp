#pragma once
// How far measured FRFs scatter: from their coherence or as stated, and drawn with a seed.

#include <cstdint>
#include <vector>

#include "dynamics/response_model.hpp"

namespace thinwall::coupling {

/// Standard deviation σ of the real and, alike, of the imaginary part of every FRF, in the FRF's unit: one matrix a
/// line, of the shape of H. The error of an averaged FRF has no preferred phase (its modulus scatters by σ, its phase
/// by σ/|H|: Bendat & Piersol 2010, chapter 9), so that one number says all: the covariance of (Re, Im) is σ² I₂. It
/// stays a multiple of I₂ under every linear map. FRFs are taken as independent of each other and from line to line.
using Deviations = std::vector<Eigen::MatrixXd>;

/// σ = share · |H|. Throws InputError unless the share is finite and not negative, or as require_complete().
[[nodiscard]] Deviations relative_deviations(const dynamics::ResponseModel& model, double share);

/// σ = |H| √((1 − γ²)/(2 n γ²)) of an H₁ estimate from n averages of coherence γ² (Bendat & Piersol 2010, chapter 9,
/// random error of gain factors; of leading order where it is small against 1). `coherence`: one matrix a line of the
/// shape of H. Throws InputError unless 0 < γ² ≤ 1, n ≥ 1 and the shapes agree, naming the first line that is at fault.
[[nodiscard]] Deviations deviations_from_coherence(const dynamics::ResponseModel& model,
                                                   const std::vector<Eigen::MatrixXd>& coherence, int averages);

/// Throws InputError unless there is a matrix a line of the shape of H, finite and not negative.
void require_valid(const Deviations& deviations, const dynamics::ResponseModel& model);

/// H + σ (a + ib), a and b standard normal and independent, line by line, from std::mt19937_64 with this seed.
[[nodiscard]] dynamics::ResponseModel with_noise(dynamics::ResponseModel model, const Deviations& deviations,
                                                 std::uint64_t seed);

}  // namespace thinwall::coupling
