#pragma once
// A structure and a process with other parameters.

#include <Eigen/Core>
#include <complex>

#include "milling/cut/process.hpp"
#include "milling/structure/relative_structure.hpp"

namespace thinwall::milling {

/// ω (−ζ + i √(1 − ζ²)), rad/s.
[[nodiscard]] std::complex<double> pole_of(double omega, double zeta);

/// Gives mode k another pole at the same modal mass: b ~ 1/Im λ, of a real pole 1/λ.
void move_pole(RelativeStructure& structure, Eigen::Index k, std::complex<double> pole);

/// Relative changes, 0.1 for 10 % more; vectors have an entry for each pole of the structure.
struct ParameterChange {
  Eigen::VectorXd frequency;      ///< |λ|, at constant modal mass and damping ratio
  Eigen::VectorXd damping_ratio;  ///< of no effect on a real pole
  Eigen::VectorXd mass;           ///< modal mass, at constant pole
  double K_t = 0.0, K_r = 0.0, K_a = 0.0;
};

/// λ = pole_of(ω, ζ) and b ~ 1/(m Im λ) with the changed ω, ζ, m (1/(m λ) of a real pole); R stays. Throws
/// InputError if a frequency or mass is no longer positive, or a damping ratio leaves (0, 1).
[[nodiscard]] RelativeStructure changed(const RelativeStructure& structure, const ParameterChange& change);

/// The process with changed coefficients of every tooth. Edge forces stay. Throws InputError if a coefficient changes
/// its sign or vanishes.
[[nodiscard]] MillingProcess changed(MillingProcess process, const ParameterChange& change);

}  // namespace thinwall::milling
