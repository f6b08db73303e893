#pragma once
// A robot's tip as one mode or a few, each along a direction, as hammer tests in single directions give.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "dynamics/spatial_model.hpp"

namespace thinwall::robot {

/// One mode, m q'' + c q' + k q = f along a unit direction in the part's axes (Barrios 2019, Eq. 17). Units: kg, N s/m,
/// N/m.
struct OneMode {
  double mass = 0.0;
  double damping = 0.0;
  double stiffness = 0.0;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
};

/// The mode of undamped frequency f (Hz), damping ratio ζ and stiffness k (N/m): m = k / (2πf)², c = 2 ζ k / (2πf).
/// Throws InputError unless f > 0, 0 ≤ ζ < 1 and k > 0.
[[nodiscard]] OneMode one_mode(double frequency_hz, double damping_ratio, double stiffness_n_m,
                               const Eigen::Vector3d& direction);

/// The spatial model of independent modes at one point, u = Σ dᵢ qᵢ, over their amplitudes qᵢ. The DOFs are the point's
/// translations {point, d} along the different directions of the modes, or, if these are not perpendicular, along those
/// of x, y, z that they have components in; modes with the same direction add up. Throws InputError for an empty list,
/// a direction that is not a unit vector, or a mass, stiffness or damping that no passive mode has.
[[nodiscard]] dynamics::SpatialModel spatial_model(const std::vector<OneMode>& modes, const std::string& point);

}  // namespace thinwall::robot
