#pragma once
// A straight uniform beam between two points: stretching, torsion, and bending with shear (Timoshenko).

#include <Eigen/Core>
#include <string>

#include "core/faults.hpp"
#include "dynamics/rigid_body.hpp"

namespace thinwall::dynamics {

/// A cross-section in its principal axes y and z through the centroid, which is its shear centre too, and what it is
/// made of. I_z = ∫ y² dA resists bending in the plane x-y. The shear factors are the shares of the area that a shear
/// force along y, along z strains evenly; infinite: no strain (Euler & Bernoulli's beam, with rotary inertia).
struct BeamSection {
  double youngs_modulus_Pa = 0.0;
  double shear_modulus_Pa = 0.0;
  double density_kg_m3 = 0.0;
  double area_m2 = 0.0;
  double I_y_m4 = 0.0;
  double I_z_m4 = 0.0;
  double J_m4 = 0.0;  ///< torsion constant; I_y + I_z of a circle, less of all others
  double shear_y = 1.0;
  double shear_z = 1.0;
};

/// A solid cylinder (inner diameter 0) or a tube, and what it is made of.
struct Tube {
  double outer_diameter_m = 0.0;
  double inner_diameter_m = 0.0;
  double youngs_modulus_Pa = 0.0;
  double poisson_ratio = 0.0;
  double density_kg_m3 = 0.0;
};

/// Its section: I = π(D⁴ − d⁴)/64, J = 2I, G = E/(2(1 + ν)), and with m = d/D the shear factor of Cowper 1966
///
///     κ = 6(1 + ν)(1 + m²)² / ((7 + 6ν)(1 + m²)² + (20 + 12ν) m²)
///
/// Throws InputError with every violation at once: unless 0 ≤ d < D, E > 0, 0 ≤ ν < 0.5, ρ > 0, all finite.
[[nodiscard]] BeamSection section(const Tube& tube);

/// The same checks, noted under the name `where`.
void check(const Tube& tube, const std::string& where, core::Faults& faults);

/// Notes any number of the section that is not positive and finite (a shear factor may be infinite).
void check(const BeamSection& section, const std::string& where, core::Faults& faults);

/// Over the six components of end 1 and the six of end 2.
using Matrix12 = Eigen::Matrix<double, 12, 12>;

// Below, L is the length (m, > 0), x runs along the beam from end 1 to end 2, and the six components are in its axes.

/// S: motion of end 2 under a force and torque there, end 1 clamped. Stretching L/EA, twist L/GJ; in the plane x-y
///
///     v = (L³/3EI_z + L/κ_yGA) F_y + (L²/2EI_z) M_z,     θ_z = (L²/2EI_z) F_y + (L/EI_z) M_z
///
/// and likewise in x-z with θ_y for −w'. m/N, rad/N, m/(N m), rad/(N m).
[[nodiscard]] Matrix6 tip_compliance(const BeamSection& section, double length);

/// S⁻¹ in closed form: with ϕ = 12EI/κGAL² (Przemieniecki 1968, section 5.6) 12EI/((1 + ϕ)L³), −6EI/((1 + ϕ)L²), (4 +
/// ϕ)EI/((1 + ϕ)L).
[[nodiscard]] Matrix6 tip_stiffness(const BeamSection& section, double length);

/// N(x), 6 × 12: motion of the section at x = `share` · L from those of both ends, [q₁; q₂], where forces act on the
/// ends alone (Friedman & Kosmatka 1993, Eq. 20-23): linear u and θ_x, cubic v and w, quadratic rotations.
[[nodiscard]] Eigen::Matrix<double, 6, 12> section_motion(const BeamSection& section, double length, double share);

/// K = Gᵀ S⁻¹ G with the deformation G [q₁; q₂] = q₂ − X(L) q₁: exact for forces on the ends.
[[nodiscard]] Matrix12 beam_stiffness(const BeamSection& section, double length);

/// M = ∫ ρ Nᵀ diag(A, A, A, I_y + I_z, I_y, I_z) N dx: with rotary inertia, exact for those shapes.
[[nodiscard]] Matrix12 beam_mass(const BeamSection& section, double length);

}  // namespace thinwall::dynamics
