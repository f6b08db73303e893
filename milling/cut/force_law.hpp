#pragma once
// Cutting force as a law of the chip thickness, and its tangent: what vibrations about a steady chip feel.

#include <Eigen/Core>
#include <string>
#include <variant>
#include <vector>

#include "milling/cut/cutting_force.hpp"

namespace thinwall::milling {

/// F_i = w K_i h (h/h_1)^{−m_i}, h_1 = 1 mm (Kienzle 1952): K_i is the specific force k_i1.1 of tables, in N/m². Below
/// h = 0 no force.
struct PowerLaw {
  double K_t = 0.0, K_r = 0.0, K_a = 0.0;  ///< N/m², at a chip of 1 mm
  double m_t = 0.0, m_r = 0.0, m_a = 0.0;  ///< in [0, 1)
};

/// F_i = w K_i h (1 + r h/h_s)/(1 + h/h_s): stiffness K_i for a thin chip, r K_i for a thick one, h_s between
/// (Bondarenko 2012, Eq. 26-28, with F_r = k_r F_t). His Eq. 26 is printed without the factor h_s that makes k_0 what
/// his text says, the stiffness at small h: with it his numbers for aluminium, k_0 = 5e6 N/m over the width of cut,
/// h_s = 18 µm, r = 0.1, give 118 N for a chip of 0.1 mm, without it 6.6 MN. So K_t = k_0/width. Below h = 0 no force.
struct FractionalLaw {
  double K_t = 0.0, K_r = 0.0, K_a = 0.0;  ///< N/m², at h = 0
  double h_s_m = 0.0;                      ///< > 0
  double r = 0.0;                          ///< in [0, 1]
};

/// The coefficients alone are the linear law, F_i = w (K_i h + K_ie).
using ForceLaw = std::variant<CuttingCoefficients, PowerLaw, FractionalLaw>;

/// The law that Bondarenko 2012, Eq. 25 and 28, calls exponential, F_t = k_F h^μ w and F_r = k_r F_t: a power law with
/// m = 1 − μ. k_F in N/m^{1+μ}.
[[nodiscard]] PowerLaw exponential_law(double k_F, double mu, double k_r);

/// F_t, F_r, F_a per width of cut, N/m, of a chip of h m.
[[nodiscard]] Eigen::Vector3d force_per_width(const ForceLaw& law, double h_m);

/// The tangent at h > 0, m: K_i = dF_i/dh / w, K_ie = F_i/w − K_i h. Vibrations that are small beside the chip feel the
/// tangent, not the chord F/h. Throws InputError unless h is positive (the linear law is its own tangent anywhere).
[[nodiscard]] CuttingCoefficients linearised(const ForceLaw& law, double h_m);

/// Every violation, empty if there is none: finite, K_t ≥ 0, not all zero; m in [0, 1); h_s > 0, r in [0, 1].
[[nodiscard]] std::vector<std::string> validate(const ForceLaw& law);

}  // namespace thinwall::milling
