#pragma once
// Poles of a measured receptance matrix without a guess: polyreference least squares in the frequency domain.

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "identification/measured_lines.hpp"

namespace thinwall::identification {

/// A pole of a model of some order, and the combination of references that excites it most.
struct OrderPole {
  std::complex<double> pole;       ///< rad/s, within the band
  Eigen::VectorXcd participation;  ///< a number a reference, largest entry 1
};

/// The poles of one order.
struct OrderPoles {
  int order = 0;
  std::vector<OrderPole> poles;  ///< by rising frequency
};

/// The poles of right matrix fractions H = B(z) A(z)⁻¹ of the orders 1 to `highest_order`,
///
///     z = e^{−(s − iω_a)/(2 (f_b − f_a))},      Σ_k z^k B_k = H Σ_k z^k A_k      in weighted least squares over the
///     lines
///
/// with A of the highest power the identity (Peeters, Van der Auweraer, Guillaume & Leuridan 2004). z maps the band to
/// half a circle, whatever its ends, so that the powers are nearly orthogonal; coefficients are complex for that. B is
/// eliminated line by line, all orders take their normal equations from those of the highest, and the poles are the
/// eigenvalues of the companion matrix. Those that decay and lie in the band count. Throws InputError as
/// require_usable(), for an order below 1, or too few lines for it. Cost O(lines responses (order references)² + Σ
/// (order references)³).
[[nodiscard]] std::vector<OrderPoles> plscf(const MeasuredLines& measured, int highest_order);

/// The agreement of a pole with the nearest one of the order before.
struct Stability {
  bool frequency = false;      ///< within 1 %
  bool damping = false;        ///< and within 5 %
  bool participation = false;  ///< MAC of the references above 0.95
  /// True if all three agree.
  [[nodiscard]] bool all() const { return frequency && damping && participation; }
};

/// The stability of each pole of each order, in the order of `orders`: the stabilisation diagram.
[[nodiscard]] std::vector<std::vector<Stability>> stabilisation(const std::vector<OrderPoles>& orders);

/// Poles that stay over the orders.
struct StablePole {
  std::complex<double> pole;  ///< medians of frequency and damping over the orders
  int orders = 0;             ///< in which it is stable
};

/// Stable poles that lie within 1 % in frequency and a quarter in damping of each other in at least three orders, of
/// which the highest need not be one. By rising frequency. Cost O(poles²).
[[nodiscard]] std::vector<StablePole> stable_poles(const std::vector<OrderPoles>& orders);

/// Poles to start from at chosen frequencies (Hz): the stable pole that is nearest within 5 %, each for one frequency
/// only, or one of a damping of 1 %.
[[nodiscard]] Eigen::VectorXcd poles_near(const std::vector<double>& hz, const std::vector<StablePole>& stable);

}  // namespace thinwall::identification
