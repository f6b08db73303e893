#pragma once
// The scatter of a limiting depth with the samples of a measured or coupled receptance.

#include <cstdint>
#include <vector>

#include "milling/chart/sampled_stability.hpp"

namespace thinwall::milling {

/// Covariance E[v vᴴ] of the nine entries of H, v column by column, (m/N)²; one a line of the samples, tool axes.
/// Errors are circular (E[v vᵀ] = 0; coupling/error_budget.hpp makes them) and independent from line to line. σ of real
/// and imaginary part alike is 2σ² on the diagonal.
using SampleCovariance = std::vector<Eigen::Matrix<std::complex<double>, 9, 9>>;

/// Standard deviation of a critical depth, m, first order: with g of depth_gradient() and dw = Re gᵀv a line,
///
///     σ_w² = ½ Σ_lines gᵀ E[v vᴴ] ḡ
///
/// Throws InputError unless there is one covariance a line, finite and Hermitian. Cost O(lines).
[[nodiscard]] double depth_deviation_m(const std::vector<Eigen::Matrix3cd>& gradient,
                                       const SampleCovariance& covariance);

/// Results of drawing the samples again and again.
struct DepthScatter {
  std::vector<double> depth_m;  ///< limiting depths, one a draw, in the order of the draws
  double mean_m = 0.0;          ///< of those with a limit
  double deviation_m = 0.0;     ///< known to 1/√(2n) itself
  int without_limit = 0;        ///< draws that are stable to the depth limit, or whose search did not converge
};

/// limiting_depth() of `samples` ≥ 2 draws H + F z, F Fᴴ = E[v vᴴ], z complex normal with E|z|² = 1, from
/// std::mt19937_64 with seed, seed + 1, … The poles of the fit stay, as they do in depth_gradient(), and the remainder
/// takes the noise. The draws are shared out among core::thread_count() threads; the result does
/// not depend on their number. Where the mean is off the limit without noise, or another lobe takes over, first order
/// does not hold: the limit is the least of several depths. Errors as limiting_depth() and above; a covariance that is
/// not positive semidefinite. Cost: `samples` rows.
[[nodiscard]] DepthScatter sampled_depths(const FittedStructure& structure, const MillingProcess& process,
                                          double spindle_speed_rpm, const StabilityOptions& options,
                                          const SampleCovariance& covariance, int samples, std::uint64_t seed);

}  // namespace thinwall::milling
