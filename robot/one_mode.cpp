#include "robot/one_mode.hpp"

#include <algorithm>
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

namespace {

/// The unit vectors among x, y, z along which some mode moves.
std::vector<Eigen::Vector3d> moving_axes(const std::vector<OneMode>& modes) {
  std::vector<Eigen::Vector3d> axes;
  for (int i = 0; i < 3; ++i) {
    if (std::ranges::any_of(modes, [i](const OneMode& mode) { return std::abs(mode.direction(i)) > 1e-12; }))
      axes.emplace_back(Eigen::Vector3d::Unit(i));
  }
  return axes;
}

/// The different directions of the modes. If two of them are neither parallel nor perpendicular, coordinate axes are
/// taken instead, because the amplitude of such a DOF would not be the displacement along it.
std::vector<Eigen::Vector3d> tip_directions(const std::vector<OneMode>& modes) {
  std::vector<Eigen::Vector3d> directions;
  for (const OneMode& mode : modes) {
    bool known = false;
    for (const Eigen::Vector3d& d : directions) {
      const double along = std::abs(d.dot(mode.direction));
      if (along > 1e-12 && along < 1.0 - 1e-12) return moving_axes(modes);
      known = known || along >= 1.0 - 1e-12;
    }
    if (!known) directions.push_back(mode.direction);
  }
  return directions;
}

}  // namespace

dynamics::SpatialModel spatial_model(const std::vector<OneMode>& modes, const std::string& point) {
  if (modes.empty()) throw core::InputError("robot \"" + point + "\" has no mode: give at least one");
  for (const OneMode& mode : modes) require_valid(mode);
  const std::vector<Eigen::Vector3d> directions = tip_directions(modes);
  const auto n = static_cast<Eigen::Index>(modes.size());
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(n, n);
  dynamics::SpatialModel model{
      zero, zero, zero, Eigen::MatrixXd(), {}, Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(directions.size()), n)};
  for (const Eigen::Vector3d& d : directions) model.dofs.push_back({point, d, dynamics::DofKind::translation});
  for (Eigen::Index i = 0; i < n; ++i) {
    const OneMode& mode = modes[static_cast<std::size_t>(i)];
    model.M(i, i) = mode.mass;
    model.C(i, i) = mode.damping;
    model.K(i, i) = mode.stiffness;
    for (std::size_t row = 0; row < directions.size(); ++row)
      model.T(static_cast<Eigen::Index>(row), i) = directions[row].dot(mode.direction);
  }
  return model;
}

}  // namespace thinwall::robot
