#pragma once
// The sensitivity of a critical depth to the structure and the coefficients.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "milling/cut/process.hpp"
#include "milling/direct/lobe_row.hpp"
#include "milling/structure/relative_structure.hpp"

namespace thinwall::milling {

/// d ln w / d ln p of a critical depth w: by how many percent it rises if a parameter rises by one percent. Vectors
/// have an entry for each pole of the structure.
struct DepthSensitivity {
  Eigen::VectorXd to_frequency;      ///< |λ|, at constant modal mass and damping ratio
  Eigen::VectorXd to_damping_ratio;  ///< −Re λ/|λ|; 0 of a real pole
  Eigen::VectorXd to_mass;           ///< modal mass, at constant pole: the mode's receptance goes with its reciprocal
  double to_K_t = 0.0;
  double to_K_r = 0.0;
  double to_K_a = 0.0;
};

/// The sensitivities of a crossing's depth. There 1/w is an eigenvalue ν of −Z(e^{iθ}) with vectors l and r
/// (crossing.hpp). With
///
///     ν_p = −lᵀ (∂Z/∂p) r / lᵀ r,      ν_θ dθ + (ν_w + 1/w²) dw + ν_p dp = 0
///
/// in complex numbers, dθ and dw real: two equations for the two. ν_w is the grid's own change with the depth, of a
/// helix. Z is linear in coefficients and modal constants, so that these derivatives are exact; that by a pole is a
/// central difference of its own entire function. On a grid whose depth agrees with the crossing's to its estimate;
/// `point` is one of limiting_depth()'s crossings for the same arguments. Throws InputError as limiting_depth(),
/// NumericalError if the crossing is not found again. Cost: six times a mode's share of regenerative_loop() for each
/// mode.
[[nodiscard]] DepthSensitivity depth_sensitivity(const RelativeStructure& structure, const MillingProcess& process,
                                                 double spindle_speed_rpm, const LobePoint& point,
                                                 const StabilityOptions& options);

/// The relative change of a critical depth, dw/w, where `structure` becomes `other`: first order in dZ = Z_other − Z,
/// exact in what the modes themselves become, which may also be more or fewer,
///
///     dw = −Re[…] of dν = −lᵀ dZ r / lᵀ r   as above
///
/// `point`, errors: as depth_sensitivity(). What is wrong by a share e of itself leaves e² of it. Cost: some values of
/// Z.
[[nodiscard]] double relative_depth_change(const RelativeStructure& structure, const RelativeStructure& other,
                                           const MillingProcess& process, double spindle_speed_rpm,
                                           const LobePoint& point, const StabilityOptions& options);

/// The depths, m, to which a critical depth w moves where `structure` becomes each of `others`. On the grid of the
/// crossing Newton's rule brings it to the axis of the changed loop (to_axis() of crossing.hpp), so that the depth is
/// exact up to the grid's error and that of a crossing of the other structure, though not always of its first. Where
/// the rule does not settle, and for a cut whose shape changes with the depth, 1/w is taken to first order as in
/// relative_depth_change(); infinite where that is no longer positive. `point`, errors: as depth_sensitivity(). Cost:
/// one value of Z and some four factorisations of its size for each of the others.
[[nodiscard]] std::vector<double> moved_depths_m(const RelativeStructure& structure,
                                                 const std::vector<RelativeStructure>& others,
                                                 const MillingProcess& process, double spindle_speed_rpm,
                                                 const LobePoint& point, const StabilityOptions& options);

/// Standard uncertainties, relative, of every mode and coefficient alike.
struct Uncertainty {
  double frequency = 0.0;
  double damping_ratio = 0.0;
  double mass = 0.0;  ///< of the receptance, too: of a mode's height
  double coefficients = 0.0;
};

/// Every violation, empty if there is none: finite, 0 to 1.
[[nodiscard]] std::vector<std::string> validate(const Uncertainty& uncertainty);

/// Standard uncertainty of ln w, parameters independent: √Σ (sensitivity · uncertainty)² (first order; JCGM 100:2008,
/// Eq. 10). A depth of w (1 − k times this) is stable with the confidence of k.
[[nodiscard]] double relative_uncertainty(const DepthSensitivity& sensitivity, const Uncertainty& uncertainty);

}  // namespace thinwall::milling
