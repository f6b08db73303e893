#pragma once
// The stiffness of a ball pressed against a surface, after Hertz and Mindlin, and that of a ball caster.

#include "coupling/contact.hpp"

namespace thinwall::coupling {

/// An elastic material: Young's modulus (Pa, > 0) and Poisson's ratio (−1 < ν ≤ 0.5).
struct Elastic {
  double E = 0.0;
  double nu = 0.3;
};

/// Two elastic bodies that touch at a point, with R the relative radius, 1/R = 1/R_1 + 1/R_2 (m, > 0; 1/R_2 = 0 for a
/// plane, negative for a hollow). Their shape is round about the contact's normal.
struct HertzContact {
  double radius = 0.0;
  Elastic one, other;
};

/// The relative radius R of a ball of radius r (m) against a plane, against a ball of radius `other` (> 0) or in a
/// hollow (other < −r). Throws InputError for impossible radii.
[[nodiscard]] double relative_radius(double r, double other = std::numeric_limits<double>::infinity());

/// The state of a contact under a force F (N) (Johnson 1985, Eq. 4.22-4.24), with 1/E* = (1 − ν_1²)/E_1 + (1 −
/// ν_2²)/E_2, 1/G* = (2 − ν_1)/G_1 + (2 − ν_2)/G_2:
///
///     a = (3FR / 4E*)^⅓,   δ = a²/R = (9F² / 16RE*²)^⅓,   p_0 = (6FE*² / π³R²)^⅓,
///     k_n = dF/dδ = 2E*a = (6FRE*²)^⅓,   k_t = 8 G* a       (docs/theory/coupling.md, Eq. 18-19)
///
/// k_t is Mindlin's stiffness at the start of a tangential motion, before any slip (Johnson 1985, Eq. 7.43), for
/// tangential forces small against friction times F. Surfaces are smooth and dry, bodies elastic; yielding begins at
/// p_0 of about 1.6 times the yield stress.
struct HertzState {
  double contact_radius = 0.0;  ///< a, m
  double approach = 0.0;        ///< δ, m
  double peak_pressure = 0.0;   ///< p_0, Pa
  double normal = 0.0;          ///< k_n, N/m
  double tangential = 0.0;      ///< k_t, N/m
};

/// The state of a contact under a preload (N). Throws InputError for a faulty material or radius, or unless F > 0:
/// without a preload there is no stiffness.
[[nodiscard]] HertzState hertz(const HertzContact& contact, double preload);

/// A ball caster: its main ball touches the part and is carried by `balls` equal balls in a cup. The contacts of these
/// with the main ball lie at `angle` to the axis (rad, in [0, π/2)). All are of one material.
struct BallCaster {
  double ball_radius = 0.0;     ///< m
  double support_radius = 0.0;  ///< radius of the carrying balls, m
  int balls = 0;                ///< number of carrying balls, ≥ 3
  double angle = 0.0;           ///< between the axis and their contacts with the main ball
  Elastic steel{210e9, 0.3};    ///< material of all balls and of the cup
};

/// The stiffness (N/m) of a caster along its axis against a flat part under a preload F (N). There are Hertz contacts
/// at the part and, under Q = F/(n cos β), of each carrying ball with the main ball and with the cup (a hollow of
/// radius ball + 2 support):
///
///     1/k = 1/k_n(F) + 1/(n cos²β k_Q),     1/k_Q = 1/k_n,ball(Q) + 1/k_n,cup(Q)       (Eq. 20)
///
/// Races, housing and friction are neglected. Throws as hertz() does, or for a faulty caster.
[[nodiscard]] double caster_stiffness(const BallCaster& caster, const Elastic& part, double preload);

}  // namespace thinwall::coupling
