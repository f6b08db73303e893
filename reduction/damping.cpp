#include "reduction/damping.hpp"

#include <string>

#include "core/error.hpp"
#include "dynamics/conversion.hpp"

namespace thinwall::reduction {

namespace {

void require_ratio(double zeta) {
  if (!(zeta >= 0.0 && zeta < 1.0)) {
    throw core::InputError("damping ratio " + std::to_string(zeta) +
                           " is outside 0 ≤ ζ < 1; write 0.01 or \"1 %\" for one per cent");
  }
}

void require_not_negative(double value, const char* name) {
  if (!(value >= 0.0))
    throw core::InputError(std::string(name) + " is " + std::to_string(value) + "; it must not be negative");
}

}  // namespace

Eigen::Index rigid_motions(const Eigen::VectorXd& ascending) {
  return (ascending.array() <= 1e-6 * ascending.maxCoeff()).count();
}

dynamics::SpatialModel with_modal_damping(dynamics::SpatialModel model, const std::vector<double>& ratios,
                                          double rest) {
  for (const double zeta : ratios) require_ratio(zeta);
  require_ratio(rest);
  const dynamics::UndampedModes modes = dynamics::undamped_modes(model);
  Eigen::VectorXd two_zeta_omega = 2.0 * modes.omega_rad_s;
  const Eigen::Index rigid = rigid_motions(modes.omega_rad_s);
  for (Eigen::Index k = rigid; k < two_zeta_omega.size(); ++k) {
    const auto elastic = static_cast<std::size_t>(k - rigid);
    two_zeta_omega(k) *= elastic < ratios.size() ? ratios[elastic] : rest;
  }
  two_zeta_omega.head(rigid).setZero();
  const Eigen::MatrixXd MPhi = model.M * modes.Phi;
  model.C = MPhi * two_zeta_omega.asDiagonal() * MPhi.transpose();
  model.C = (0.5 * (model.C + model.C.transpose())).eval();
  return model;
}

dynamics::SpatialModel with_rayleigh_damping(dynamics::SpatialModel model, double alpha_per_s, double beta_s) {
  require_not_negative(alpha_per_s, "Rayleigh's alpha");
  require_not_negative(beta_s, "Rayleigh's beta");
  model.C = alpha_per_s * model.M + beta_s * model.K;
  return model;
}

dynamics::SpatialModel with_structural_damping(dynamics::SpatialModel model, double loss_factor) {
  require_not_negative(loss_factor, "the loss factor");
  model.D = loss_factor * model.K;
  return model;
}

}  // namespace thinwall::reduction
