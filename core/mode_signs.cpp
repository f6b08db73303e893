#include "core/mode_signs.hpp"

namespace thinwall::core {

void fix_signs(Eigen::MatrixXd& Phi) {
  for (auto phi : Phi.colwise()) {
    Eigen::Index largest = 0;
    phi.cwiseAbs().maxCoeff(&largest);
    if (phi(largest) < 0.0) phi = -phi;
  }
}

}  // namespace thinwall::core
