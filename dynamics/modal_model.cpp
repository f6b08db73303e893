#include "dynamics/modal_model.hpp"

#include <algorithm>
#include <numbers>

namespace thinwall::dynamics {

ModeSummary summarise(std::complex<double> pole) {
  const double omega = std::abs(pole);
  return {omega / (2.0 * std::numbers::pi), omega > 0.0 ? -pole.real() / omega : 0.0};
}

std::vector<int> oscillating_modes(const ModalModel& model) {
  std::vector<int> modes;
  for (int k = 0; k < static_cast<int>(model.poles.size()); ++k) {
    if (model.poles(k).imag() > 0.0) modes.push_back(k);
  }
  std::stable_sort(modes.begin(), modes.end(),
                   [&](int i, int j) { return std::abs(model.poles(i)) < std::abs(model.poles(j)); });
  return modes;
}

ModalModel truncate(const ModalModel& model, double omega_max_rad_s, bool keep_static) {
  std::vector<int> kept;
  const Eigen::Index n = model.right.rows();
  Eigen::MatrixXd residual = model.residual.size() > 0 ? model.residual : Eigen::MatrixXd::Zero(n, n);
  for (int k = 0; k < static_cast<int>(model.poles.size()); ++k) {
    if (std::abs(model.poles(k)) <= omega_max_rad_s) {
      kept.push_back(k);
    } else if (keep_static) {
      const std::complex<double> weight = -1.0 / (model.scaling(k) * model.poles(k));
      residual += (weight * model.right.col(k) * model.left.col(k).transpose()).real();
    }
  }
  const bool has_residual = keep_static || model.residual.size() > 0;
  return {model.poles(kept),
          model.right(Eigen::all, kept),
          model.left(Eigen::all, kept),
          model.scaling(kept),
          has_residual ? residual : Eigen::MatrixXd(),
          model.dofs};
}

}  // namespace thinwall::dynamics
