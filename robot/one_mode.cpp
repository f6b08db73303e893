#include "robot/one_mode.hpp"

#include <cmath>
#include <numbers>
#include <sstream>

#include "core/error.hpp"

namespace thinwall::robot {

namespace {

void require(bool holds, const std::string& quantity, double value, const std::string& bound) {
  if (holds) return;
  std::ostringstream text;
  text << "robot mode: " << quantity << " is " << value << ", but " << bound;
  throw core::InputError(text.str());
}

void require_valid(const OneMode& mode) {
  require(mode.mass > 0.0 && std::isfinite(mode.mass), "mass (kg)", mode.mass, "it must be positive");
  require(mode.stiffness >= 0.0 && std::isfinite(mode.stiffness), "stiffness (N/m)", mode.stiffness,
          "it must not be negative");
  require(mode.damping >= 0.0 && std::isfinite(mode.damping), "damping (N s/m)", mode.damping,
          "it must not be negative");
  const double length = mode.direction.norm();
  require(std::abs(length - 1.0) <= 1e-9, "the length of the direction", length, "it must be a unit vector");
}

/// Index of the first mode along the same line as modes[i]; the sign of that direction is `sign` times its own.
std::size_t first_along(const std::vector<OneMode>& modes, std::size_t i, double& sign) {
  for (std::size_t j = 0; j < i; ++j) {
    const double cosine = modes[i].direction.dot(modes[j].direction);
    sign = cosine < 0.0 ? -1.0 : 1.0;
    if (std::abs(cosine) > 1.0 - 1e-12) return j;
  }
  sign = 1.0;
  return i;
}

}  // namespace

OneMode one_mode(double frequency_hz, double damping_ratio, double stiffness_n_m, const Eigen::Vector3d& direction) {
  require(frequency_hz > 0.0 && std::isfinite(frequency_hz), "frequency (Hz)", frequency_hz, "it must be positive");
  require(damping_ratio >= 0.0 && damping_ratio < 1.0, "damping ratio", damping_ratio, "it must be in [0, 1)");
  require(stiffness_n_m > 0.0 && std::isfinite(stiffness_n_m), "stiffness (N/m)", stiffness_n_m, "it must be positive");
  const double omega = 2.0 * std::numbers::pi * frequency_hz;
  OneMode mode{stiffness_n_m / (omega * omega), 2.0 * damping_ratio * stiffness_n_m / omega, stiffness_n_m, direction};
  require_valid(mode);
  return mode;
}

dynamics::SpatialModel spatial_model(const std::vector<OneMode>& modes, const std::string& point) {
  if (modes.empty()) throw core::InputError("robot \"" + point + "\" has no mode: give at least one");
  const auto n = static_cast<Eigen::Index>(modes.size());
  Eigen::VectorXd mass(n), damping(n), stiffness(n);
  Eigen::MatrixXd T = Eigen::MatrixXd::Identity(n, n);
  dynamics::DofTable dofs;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    require_valid(modes[i]);
    const auto row = static_cast<Eigen::Index>(i);
    mass(row) = modes[i].mass;
    damping(row) = modes[i].damping;
    stiffness(row) = modes[i].stiffness;
    double sign = 1.0;
    const std::size_t first = first_along(modes, i, sign);
    if (first == i) {
      dofs.push_back({point, modes[i].direction, dynamics::DofKind::translation});
    } else {
      T(static_cast<Eigen::Index>(first), row) = -sign;
      dofs.push_back({point + " mode " + std::to_string(i + 1), Eigen::Vector3d::Zero(), dynamics::DofKind::modal});
    }
  }
  return {T.transpose() * mass.asDiagonal() * T, T.transpose() * damping.asDiagonal() * T,
          T.transpose() * stiffness.asDiagonal() * T, Eigen::MatrixXd(), dofs};
}

}  // namespace thinwall::robot
