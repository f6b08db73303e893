#pragma once
// Bounds of numbers and words that several keys of the schemas share.

#include <limits>

#include "case/schema/schema.hpp"

namespace thinwall::cases::bounds {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr Bounds any{};
inline constexpr Bounds positive{0.0, infinity, true, false, false, ""};
inline constexpr Bounds not_negative{0.0, infinity, false, false, false, ""};
inline constexpr Bounds at_least_one{1.0, 1e6, false, false, false, ""};
inline constexpr Bounds fraction{0.0,   1.0,   false,
                                 false, false, "a fraction of the box, 0 at one face and 1 at the other"};
inline constexpr Bounds ridden_mass{0.0, 100.0, true, false, false, "for grams write the unit: \"5 g\""};
inline constexpr Bounds sensor_mass{0.0, 1.0, true, false, false, "for grams write the unit: \"5 g\""};
inline constexpr Bounds damping_ratio{0.0, 1.0, false, true, false, "a ratio to critical damping: 1 % is 0.01"};
inline constexpr Bounds density_bounds{100.0, 25000.0, false,
                                       false, false,   "for g/cm^3 write the unit: \"7.85 g/cm^3\""};
inline constexpr Bounds modulus_bounds{1e6, 2e12, false, false, false, "for GPa write the unit: \"210 GPa\""};
inline constexpr Bounds poisson_bounds{0.0,  0.5,   false,
                                       true, false, "isotropic solids lie at 0.2 to 0.45; 0.5 would be incompressible"};
inline constexpr Bounds stiffness_or_infinite{0.0, infinity, true, false, true, "\"inf\" for a rigid contact"};
inline constexpr Bounds coefficient_bounds{1e6,   1e11,  false,
                                           false, false, "for N/mm^2 write the unit: \"1800 N/mm^2\""};
inline constexpr Bounds axial_bounds{-1e12, 1e12, false, false, false, "for N/mm^2 write the unit: \"-200 N/mm^2\""};
inline constexpr Bounds exponent_bounds{0.0, 1.0, false, true, false, "0.2 to 0.3 is usual for steel"};
inline constexpr Bounds right_angle{0.0, 1.5707963268, false, true, false, "below 90 deg"};
inline constexpr Bounds tilt{-1.3962634016, 1.3962634016, false, false, false, "within 80 deg"};
inline constexpr Bounds turn{-6.2831853072, 12.5663706144, false, false, false, "a full turn is 360 deg"};
inline constexpr Bounds radial_bounds{0.0, 1e12, false, false, false, "for N/mm^2 write the unit: \"600 N/mm^2\""};

inline constexpr Bounds uncertainty{0.0,   1.0,   false,
                                    false, false, "a standard uncertainty relative to the value: 5 % is 0.05"};
inline constexpr Bounds damper{0.0, 1e12, false, false, false, ""};
inline constexpr Bounds decay_rate{0.0, 1e9, false, false, false, ""};
inline constexpr Bounds inertia_bounds{0.0, 1e9, false, false, false, "for g mm^2 write the unit: \"5 g mm^2\""};
inline constexpr Bounds inertia_product{-1e9, 1e9, false, false, false, "for g mm^2 write the unit: \"5 g mm^2\""};
inline constexpr Bounds gear_ratio{-1e6, 1e6, false, false, false, "negative where the joint turns against the motor"};
inline constexpr Bounds weight_bounds{0.0, 1e9, true, false, false, "1 is usual"};
inline constexpr Bounds friction_bounds{0.0, 100.0, false, false, false, "0.3 is usual"};
inline constexpr Bounds posture_value{-1e9, 1e9, false, false, false, ""};
inline constexpr bool required = true;

/// The words of lobes.method.
inline constexpr auto methods =
    "direct|zeroth_order|multi_frequency|semi_discretization_0|semi_discretization_1|semi_discretization_2|"
    "full_discretization_1|full_discretization_2|full_discretization_3";

}  // namespace thinwall::cases::bounds
