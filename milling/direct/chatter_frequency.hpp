#pragma once
// Which of the frequencies of a Floquet solution is the one that is heard.

#include <Eigen/Core>
#include <complex>
#include <functional>

#include "milling/cut/contact_grid.hpp"

namespace thinwall::milling {

/// H(ω), 3 × 3, m/N, tool axes; ω in rad/s of any sign.
using ReceptanceAt = std::function<Eigen::Matrix3cd(double omega_rad_s)>;

/// A solution of multiplier e^{iθ} T-periods apart has components at ω_k = (θ + 2πk)/T for all k. Reported is the one
/// at which the motion |H(ω_k) F(ω_k)| is largest,
///
///     F(ω) = Σ weight_i e^{−iω t_i} force_i c_i
///
/// with c the contacts' modulations (up to a factor) and the weights those of the grid's nodes. Looked for up to
/// `highest_rad_s` and one harmonic beyond. Hz. Cost O(harmonics nodes).
[[nodiscard]] double chatter_frequency_hz(const ContactGrid& grid, double period_s, const ReceptanceAt& receptance,
                                          double highest_rad_s, double theta_rad, const Eigen::VectorXcd& c);

}  // namespace thinwall::milling
