#include "posture/mode_targets.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <sstream>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"

namespace thinwall::posture {

Eigen::VectorXd targets_of(const identification::FittedMode& mode) {
  if (!(mode.damping_ratio > 0.0 && mode.damping_ratio < 1.0)) {
    std::ostringstream text;
    text << "the mode at " << mode.frequency_hz << " Hz has a damping ratio of " << mode.damping_ratio
         << ", must be above 0 and below 1; leave it out or identify it again";
    throw core::InputError(text.str());
  }
  const Eigen::Index entries = mode.residue.size();
  const Eigen::MatrixXcd A = std::complex<double>(0.0, 2.0 * mode.pole().imag()) * mode.residue;
  Eigen::VectorXd targets(2 + 2 * entries);
  targets << std::log(mode.frequency_hz), std::log(mode.damping_ratio), A.real().reshaped(), A.imag().reshaped();
  return targets;
}

identification::FittedMode turned(identification::FittedMode mode, const Turn& turn) {
  if (turn.responses.size() == 0) return mode;
  mode.residue = (turn.responses * mode.residue * turn.references.transpose()).eval();
  if (mode.right.size() > 0) mode.right = (turn.responses * mode.right).eval();
  if (mode.left.size() > 0) mode.left = (turn.references * mode.left).eval();
  return mode;
}

Turn back(const Turn& turn) {
  return {turn.responses.transpose(), turn.references.transpose()};
}

identification::FittedMode mode_of(const Eigen::VectorXd& targets, Eigen::Index responses) {
  identification::FittedMode mode;
  mode.frequency_hz = std::exp(targets(0));
  mode.damping_ratio = std::min(std::exp(targets(1)), 0.999);
  const Eigen::Index entries = (targets.size() - 2) / 2;
  Eigen::MatrixXcd A(responses, entries / responses);
  A.real() = targets.segment(2, entries).reshaped(responses, entries / responses);
  A.imag() = targets.tail(entries).reshaped(responses, entries / responses);
  const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
  mode.left = svd.matrixV().col(0).conjugate();
  mode.right = svd.matrixU().col(0) * svd.singularValues()(0) / std::complex<double>(0.0, 2.0 * mode.pole().imag());
  mode.residue = A / std::complex<double>(0.0, 2.0 * mode.pole().imag());
  if (svd.singularValues().size() > 1 && svd.singularValues()(0) > 0.0)
    mode.second_singular = svd.singularValues()(1) / svd.singularValues()(0);
  Eigen::Index largest = 0;
  mode.left.cwiseAbs().maxCoeff(&largest);
  const std::complex<double> scale = mode.left(largest);
  mode.left /= scale;
  mode.right *= scale;
  return mode;
}

}  // namespace thinwall::posture
