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

dynamics::SpatialModel spatial_model(const std::vector<OneMode>& modes, const std::string& point) {
  if (modes.empty()) throw core::InputError("robot \"" + point + "\" has no mode: give at least one");
  const auto n = static_cast<Eigen::Index>(modes.size());
  dynamics::SpatialModel model{
      Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd(), {},
      Eigen::MatrixXd::Zero(n, n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const OneMode& mode = modes[static_cast<std::size_t>(i)];
    require_valid(mode);
    model.M(i, i) = mode.mass;
    model.C(i, i) = mode.damping;
    model.K(i, i) = mode.stiffness;
    const auto along = std::find_if(model.dofs.begin(), model.dofs.end(), [&](const dynamics::Dof& dof) {
      return std::abs(dof.direction.dot(mode.direction)) > 1.0 - 1e-12;
    });
    const auto row = along - model.dofs.begin();
    model.T(row, i) = along == model.dofs.end() || along->direction.dot(mode.direction) > 0.0 ? 1.0 : -1.0;
    if (along == model.dofs.end()) model.dofs.push_back({point, mode.direction, dynamics::DofKind::translation});
  }
  model.T.conservativeResize(static_cast<Eigen::Index>(model.dofs.size()), Eigen::NoChange);
  return model;
}

}  // namespace thinwall::robot
