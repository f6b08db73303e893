#pragma once
// A straight uniform beam element between two points: stretching, torsion, and bending with shear (Timoshenko).

#include <Eigen/Core>
#include <string>

#include "core/faults.hpp"
#include "dynamics/rigid_body.hpp"

namespace thinwall::dynamics {

/// A cross-section with its material, in the principal axes y and z through the centroid, which is taken as the shear
/// centre too. I_z = ∫ y² dA resists bending in the plane x-y. A shear factor κ is the ratio of the area that carries a
/// shear force along y (or z) with uniform strain to the whole area; an infinite one means no shear strain (the
/// Euler-Bernoulli beam, with rotary inertia).
struct BeamSection {
  double youngs_modulus_Pa = 0.0;
  double shear_modulus_Pa = 0.0;
  double density_kg_m3 = 0.0;
  double area_m2 = 0.0;
  double I_y_m4 = 0.0;
  double I_z_m4 = 0.0;
  double J_m4 = 0.0;  ///< torsion constant; I_y + I_z for a circle, less for all others
  double shear_y = 1.0;
  double shear_z = 1.0;
};

/// Dimensions and material of a solid cylinder (inner diameter 0) or a tube.
struct Tube {
  double outer_diameter_m = 0.0;
  double inner_diameter_m = 0.0;
  double youngs_modulus_Pa = 0.0;
  double poisson_ratio = 0.0;
  double density_kg_m3 = 0.0;
};

/// The section of a tube: I = π(D⁴ − d⁴)/64, J = 2I, G = E/(2(1 + ν)), and with m = d/D the shear factor of Cowper 1966
///
///     κ = 6(1 + ν)(1 + m²)² / ((7 + 6ν)(1 + m²)² + (20 + 12ν) m²)
///
/// Throws InputError that lists every violation, unless 0 ≤ d < D, E > 0, 0 ≤ ν < 0.5, ρ > 0, all finite.
[[nodiscard]] BeamSection section(const Tube& tube);

/// Notes in `faults`, under the name `where`, every violation of 0 ≤ d < D, E > 0, 0 ≤ ν < 0.5, ρ > 0, and numbers that
/// are not finite.
void check(const Tube& tube, const std::string& where, core::Faults& faults);

/// Notes in `faults`, under the name `where`, every number of the section that is not positive and finite (a shear
/// factor may be infinite).
void check(const BeamSection& section, const std::string& where, core::Faults& faults);

/// A 12 × 12 matrix over the six components of end 1 followed by the six of end 2.
using Matrix12 = Eigen::Matrix<double, 12, 12>;

// In the functions below, L is the length (m, > 0), x runs along the beam from end 1 to end 2, and the six components
// of motion and force are in the beam's axes, translations first.

/// The compliance S of end 2 with end 1 clamped: the motion of end 2 under a unit force and torque there. Stretching is
/// L/EA, twist L/GJ; in the plane x-y
///
///     v = (L³/3EI_z + L/κ_yGA) F_y + (L²/2EI_z) M_z,     θ_z = (L²/2EI_z) F_y + (L/EI_z) M_z
///
/// and likewise in x-z with θ_y = −w'. Units: m/N, rad/N, m/(N m), rad/(N m).
[[nodiscard]] Matrix6 tip_compliance(const BeamSection& section, double length);

/// The inverse S⁻¹ of tip_compliance() in closed form (Przemieniecki 1968, section 5.6): with ϕ = 12EI/κGAL² its
/// bending entries are 12EI/((1 + ϕ)L³), −6EI/((1 + ϕ)L²) and (4 + ϕ)EI/((1 + ϕ)L).
[[nodiscard]] Matrix6 tip_stiffness(const BeamSection& section, double length);

/// The shape functions N(x), 6 × 12: the motion of the section at x = `share` · L as a function of the motions [q₁; q₂]
/// of both ends, when forces act on the ends alone (Friedman & Kosmatka 1993, Eq. 20-23). u and θ_x are linear, v and w
/// cubic, the other rotations quadratic.
[[nodiscard]] Eigen::Matrix<double, 6, 12> section_motion(const BeamSection& section, double length, double share);

/// The stiffness matrix K = Gᵀ S⁻¹ G, where G [q₁; q₂] = q₂ − X(L) q₁ is the motion of end 2 beyond the rigid motion of
/// end 1. It is exact for forces on the ends.
[[nodiscard]] Matrix12 beam_stiffness(const BeamSection& section, double length);

/// The consistent mass matrix M = ∫ ρ Nᵀ diag(A, A, A, I_y + I_z, I_y, I_z) N dx with rotary inertia; the quadrature is
/// exact for the shapes of section_motion().
[[nodiscard]] Matrix12 beam_mass(const BeamSection& section, double length);

}  // namespace thinwall::dynamics
