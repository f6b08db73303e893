#pragma once
// Milling coefficients from orthogonal cutting data: the orthogonal-to-oblique transformation.

#include <string>
#include <vector>

#include "milling/cut/cutting_force.hpp"

namespace thinwall::milling {

/// Orthogonal cutting data of a material and a rake, from turning a tube.
struct OrthogonalCutting {
  double shear_stress_pa = 0.0;     ///< τ_s > 0
  double shear_angle_rad = 0.0;     ///< φ_c, 0 to π/2, taken for the normal shear angle
  double friction_angle_rad = 0.0;  ///< β_a, 0 to below π/2
  double rake_rad = 0.0;            ///< normal rake α_n
  double K_te = 0.0, K_re = 0.0;    ///< N/m; taken over as they are
};

/// The coefficients of an oblique edge from orthogonal data: with the oblique angle i, the helix angle of an end mill,
/// chip flow η = i (Stabler's rule) and tan β_n = tan β_a cos η,
///
///     K_tc = τ/sin φ_n [cos(β_n − α_n) + tan i tan η sin β_n]/c
///     K_rc = τ/(sin φ_n cos i) sin(β_n − α_n)/c
///     K_ac = τ/sin φ_n [cos(β_n − α_n) tan i − tan η sin β_n]/c,       c² = cos²(φ_n + β_n − α_n) + tan² η sin² β_n
///
/// (Budak, Altintas & Armarego 1996; Altintas 2012, ch. 2). A right-hand helix draws the tool out of its holder, so
/// that here K_t = K_tc, K_r = K_rc, K_a = −K_ac. Throws InputError for bad data or |i| > 80°.
[[nodiscard]] CuttingCoefficients oblique_coefficients(const OrthogonalCutting& data, double oblique_rad);

/// Every violation, empty if there is none; φ_c + β_a − α_n must stay below π/2, where the shear plane would carry no
/// force.
[[nodiscard]] std::vector<std::string> validate(const OrthogonalCutting& data);

/// φ_c of Merchant's least energy, π/4 − (β_a − α_n)/2, rad (Merchant 1945), for data without a chip ratio.
[[nodiscard]] double merchant_shear_angle(double friction_angle_rad, double rake_rad);

}  // namespace thinwall::milling
