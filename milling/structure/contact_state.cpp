#include "milling/structure/contact_state.hpp"

#include <algorithm>
#include <complex>
#include <string>
#include <vector>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"

namespace thinwall::milling {

namespace {

// Directions of the plane in which the structure yields. Modes are weighed by their compliance, so that a direction
// that moves only by round-off does not count.
Eigen::Matrix2Xd yielding_directions(const Eigen::Matrix2Xcd& phi, const RelativeStructure& structure) {
  const Eigen::Index poles = structure.poles.size();
  Eigen::Matrix2Xd motion(2, 2 * poles);
  for (Eigen::Index k = 0; k < poles; ++k) {
    const double compliance = structure.b.col(k).norm() / std::abs(structure.poles(k));
    motion.col(2 * k) = phi.col(k).real() * compliance;
    motion.col(2 * k + 1) = phi.col(k).imag() * compliance;
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(motion, Eigen::ComputeFullU);
  const Eigen::VectorXd& size = svd.singularValues();
  const bool still = size.size() == 0 || size(0) == 0.0;
  if (still) {
    throw core::InputError(
        "structure at the cut: no mode moves in the plane of the cut, at least one must; check the feed and the tool "
        "axis");
  }
  const Eigen::Index rank = size.size() > 1 && size(1) > 1e-12 * size(0) ? 2 : 1;
  return svd.matrixU().leftCols(rank);
}

}  // namespace

ContactState contact_state(const RelativeStructure& structure, const ToolFrame& frame) {
  const Eigen::VectorXcd none = Eigen::VectorXcd::Zero(structure.poles.size());
  ContactState state = contact_state(structure, ForcePair{none, none}, frame);
  state.pair_force.resize(0);
  state.pair_motion.resize(0);
  return state;
}

ContactState contact_state(const RelativeStructure& structure, const ForcePair& pair, const ToolFrame& frame) {
  if (pair.phi.size() != structure.poles.size() || pair.b.size() != structure.poles.size()) {
    throw core::InputError("pair of forces: " + std::to_string(pair.phi.size()) + " poles, must be the " +
                           std::to_string(structure.poles.size()) + " of the structure at the cut");
  }
  const Eigen::Matrix3d R = frame.rotation();
  const Eigen::Matrix3Xcd in_space = R.transpose() * structure.phi;
  const Eigen::Matrix2Xcd phi = in_space.topRows<2>();
  const Eigen::Matrix3Xcd b = R.transpose() * structure.b;
  std::vector<Eigen::Index> pairs;
  std::vector<Eigen::Index> reals;
  for (Eigen::Index k = 0; k < structure.poles.size(); ++k) {
    (structure.poles(k).imag() != 0.0 ? pairs : reals).push_back(k);
  }
  const auto n = static_cast<Eigen::Index>(pairs.size());
  const auto m = static_cast<Eigen::Index>(reals.size());
  ContactState state;
  state.in_plane = yielding_directions(phi, structure);
  state.decay = structure.poles(pairs).real();
  state.frequency = structure.poles(pairs).imag();
  state.real_pole = structure.poles(reals).real();
  state.B.resize(2 * n + m, 3);
  state.C.resize(state.in_plane.cols(), 2 * n + m);
  state.motion.resize(3, 2 * n + m);
  state.pair_force.resize(2 * n + m);
  state.pair_motion.resize(2 * n + m);
  const auto place = [&](Eigen::Index mode, Eigen::Index row, bool conjugate) {
    const double norm = phi.col(mode).norm();
    const double scale = norm > 0.0 ? norm : 1.0;
    const Eigen::VectorXcd shape = state.in_plane.transpose() * phi.col(mode) / scale;
    state.B.row(row) = b.col(mode).real().transpose() * scale;
    state.C.col(row) = shape.real() * (conjugate ? 2.0 : 1.0);
    state.motion.col(row) = in_space.col(mode).real() / scale * (conjugate ? 2.0 : 1.0);
    state.pair_force(row) = pair.b(mode).real() * scale;
    state.pair_motion(row) = pair.phi(mode).real() / scale * (conjugate ? 2.0 : 1.0);
    if (!conjugate) return;
    state.pair_force(n + row) = pair.b(mode).imag() * scale;
    state.pair_motion(n + row) = -2.0 * pair.phi(mode).imag() / scale;
    state.B.row(n + row) = b.col(mode).imag().transpose() * scale;
    state.C.col(n + row) = -2.0 * shape.imag();
    state.motion.col(n + row) = -2.0 * in_space.col(mode).imag() / scale;
  };
  for (Eigen::Index i = 0; i < n; ++i) place(pairs[static_cast<std::size_t>(i)], i, true);
  for (Eigen::Index i = 0; i < m; ++i) place(reals[static_cast<std::size_t>(i)], 2 * n + i, false);
  return state;
}

Eigen::MatrixXd state_matrix(const ContactState& state) {
  const Eigen::Index n = state.decay.size();
  Eigen::MatrixXd Lambda = Eigen::MatrixXd::Zero(state.size(), state.size());
  Lambda.diagonal() << state.decay.matrix(), state.decay.matrix(), state.real_pole.matrix();
  Lambda.block(0, n, n, n).diagonal() = -state.frequency.matrix();
  Lambda.block(n, 0, n, n).diagonal() = state.frequency.matrix();
  return Lambda;
}

FreeFlight free_flight(const ContactState& state, double time_s) {
  const Eigen::ArrayXd size = (state.decay * time_s).exp();
  return {size * (state.frequency * time_s).cos(), size * (state.frequency * time_s).sin(),
          (state.real_pole * time_s).exp()};
}

void advance(const FreeFlight& flight, Eigen::Ref<Eigen::MatrixXd> X) {
  const Eigen::Index n = flight.cosine.size();
  for (Eigen::Index column = 0; column < X.cols(); ++column) {
    double* re = X.col(column).data();
    double* im = re + n;
    for (Eigen::Index k = 0; k < n; ++k) {
      const double rotated = flight.cosine[k] * re[k] - flight.sine[k] * im[k];
      im[k] = flight.sine[k] * re[k] + flight.cosine[k] * im[k];
      re[k] = rotated;
    }
    X.col(column).tail(flight.decay.size()).array() *= flight.decay;
  }
}

double fastest_pole(const ContactState& state) {
  double fastest = 0.0;
  for (Eigen::Index k = 0; k < state.decay.size(); ++k) {
    fastest = std::max(fastest, std::hypot(state.decay(k), state.frequency(k)));
  }
  for (Eigen::Index k = 0; k < state.real_pole.size(); ++k) fastest = std::max(fastest, -state.real_pole(k));
  return fastest;
}

}  // namespace thinwall::milling
