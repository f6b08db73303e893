#include "fem/determined_motions.hpp"

#include <string>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "fem/free_motions.hpp"

namespace thinwall::fem {

void require_motions_determined(const Model& model, const Modes& modes, const Eigen::MatrixXd& amplitudes) {
  const Eigen::Index rigid = modes.rigid_motions;
  if (rigid == 0) return;  // the part is held, rigidly or by soft springs
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(Eigen::MatrixXd(amplitudes.leftCols(rigid)));
  svd.setThreshold(1e-6);
  if (svd.rank() == rigid) return;
  throw core::InputError("the part can move rigidly in " + std::to_string(rigid) + " ways (" +
                         listed(model.free_motions) + ") and its points see " + std::to_string(svd.rank()) +
                         " of them: add a support, or a point off the line of the others; without points, modes alone "
                         "are computed");
}

}  // namespace thinwall::fem
