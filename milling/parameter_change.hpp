#pragma once
// A structure and a process with other parameters.

#include <Eigen/Core>

#include "milling/process.hpp"
#include "milling/relative_structure.hpp"

namespace thinwall::milling {

/// Relative changes, 0.1 for 10 % more; vectors have an entry for each pole of the structure.
struct ParameterChange {
  Eigen::VectorXd frequency;      ///< |λ|, at constant modal mass and damping ratio
  Eigen::VectorXd damping_ratio;  ///< of no effect on a real pole
  Eigen::VectorXd mass;           ///< modal mass, at constant pole
  double K_t = 0.0, K_r = 0.0, K_a = 0.0;
};

/// λ = ω (−ζ + i √(1 − ζ²)) and b ~ 1/(m Im λ) with the changed ω, ζ, m (1/(m λ) of a real pole); R stays. Throws
/// InputError if a frequency or mass is no longer positive, or a damping ratio leaves (0, 1).
[[nodiscard]] RelativeStructure changed(const RelativeStructure& structure, const ParameterChange& change);

/// Of every tooth. Edge forces stay.
[[nodiscard]] MillingProcess changed(MillingProcess process, const ParameterChange& change);

}  // namespace thinwall::milling
