#pragma once
// Flanks that rub on the waves they have cut.

#include <string>
#include <vector>

#include "milling/cut/cutting_force.hpp"

namespace thinwall::milling {

/// A tooth that moves into the material presses its flank on the slope of the wave behind its edge. Per width of cut,
/// with v = r Ω the cutting speed, on the tool and to first order,
///
///     f = −(C/v) (rᵀ dq/dt) (r + μ t) = −(C/r) (rᵀ dq/dφ) (r + μ t)
///
/// (Chiou & Liang 1998; Altintas, Eynian & Onozuka 2008 call C the process damping coefficient). By the angle φ it
/// turns with no speed is left in it. Sides of cylinders only: at the tip of a ball v vanishes.
struct ProcessDamping {
  double C = 0.0;         ///< N/m, ≥ 0; with a wear flat L_w and an indentation stiffness K_sp (N/m³): K_sp L_w²/2
  double friction = 0.3;  ///< μ ≥ 0
};

/// The coefficients of D(φ), tool axes, such that f = −w D dq/dφ: N/m² with dq/dφ in m.
[[nodiscard]] CuttingCoefficients per_slope(const ProcessDamping& damping, const Cutter& cutter);

/// Every violation, empty if there is none: both at least 0 and finite; on cylinders only.
[[nodiscard]] std::vector<std::string> validate(const ProcessDamping& damping, const Cutter& cutter);

}  // namespace thinwall::milling
