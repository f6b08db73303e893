#include "reduction/methods/modal_truncation.hpp"

#include <cmath>
#include <string>

#include "core/error.hpp"

namespace thinwall::reduction {

dynamics::ModalModel modal_truncation(const FreeInterface& part, double damping_ratio) {
  if (!(damping_ratio >= 0.0 && damping_ratio < 1.0)) {
    throw core::InputError("the damping ratio " + std::to_string(damping_ratio) +
                           " of a modal truncation must lie in 0 … 1, without 1");
  }
  if ((part.lambda.array() == 0.0).any()) {
    throw core::InputError(
        "a free part has no sum over simple poles: its rigid-body motions are double poles at 0 Hz; hold it, or take "
        "MacNeal's model, which is the same sum as matrices");
  }
  const Eigen::Index modes = part.lambda.size(), nb = part.F.rows();
  dynamics::ModalModel model{Eigen::VectorXcd(2 * modes),
                             Eigen::MatrixXcd(nb, 2 * modes),
                             Eigen::MatrixXcd(nb, 2 * modes),
                             Eigen::VectorXcd(2 * modes),
                             part.F,
                             part.dofs};
  for (Eigen::Index k = 0; k < modes; ++k) {
    const double omega = std::sqrt(part.lambda(k));
    const double damped = omega * std::sqrt(1.0 - damping_ratio * damping_ratio);
    const std::complex<double> pole(-damping_ratio * omega, damped), a(0.0, 2.0 * damped);
    model.poles.segment(2 * k, 2) << pole, std::conj(pole);
    model.scaling.segment(2 * k, 2) << a, -a;
    model.right.middleCols(2 * k, 2) = part.p.row(k).transpose().cast<std::complex<double>>().replicate(1, 2);
  }
  model.left = model.right;
  return model;
}

}  // namespace thinwall::reduction
