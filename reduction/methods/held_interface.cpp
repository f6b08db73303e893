#include "reduction/methods/held_interface.hpp"

#include <string>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "reduction/methods/craig_bampton.hpp"

namespace thinwall::reduction {

linalg::SparseCholesky held_by_interface(const FullModel& full, const Interface& interface) {
  if (full.rigid.cols() == 0) return {full.K, full.node_of_row};
  // Motions are scaled to a mean displacement of one over the part, so that rotations and translations can be compared.
  const Eigen::VectorXd per_mean = full.rigid.colwise().norm().cwiseInverse();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr((interface.W.transpose() * full.rigid) * per_mean.asDiagonal());
  qr.setThreshold(1e-8);
  if (qr.rank() < full.rigid.cols()) {
    throw core::InputError("the interface's " + std::to_string(interface.W.cols()) + " degrees of freedom hold " +
                           std::to_string(qr.rank()) + " of the " + std::to_string(full.rigid.cols()) +
                           " rigid motions of a free part: add interface points, or take rubin or craig_chang");
  }
  return {restrained(full.K, interface), full.node_of_row};
}

}  // namespace thinwall::reduction
