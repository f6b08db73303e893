#include "fem/error/receptance_change.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dynamics/dof.hpp"

namespace thinwall::fem {

namespace {

/// The columns of the points. Turns are scaled to the norm of a displacement's column, so that receptances in rad and
/// in m can be compared.
linalg::SparseMatrix point_loads(const Model& model, const std::vector<NamedPoint>& points) {
  std::vector<Eigen::Triplet<double>> entries;
  int columns = 0;
  for (const NamedPoint& point : points) {
    const linalg::SparseMatrix w = point_columns(model, point);
    for (Eigen::Index j = 0; j < w.cols(); ++j, ++columns) {
      const bool turn = j >= static_cast<Eigen::Index>(point.directions.size());
      const double scale = turn && !point.directions.empty() ? w.col(0).norm() / w.col(j).norm() : 1.0;
      for (linalg::SparseMatrix::InnerIterator it(w, j); it; ++it)
        entries.emplace_back(static_cast<int>(it.row()), columns, scale * it.value());
    }
  }
  linalg::SparseMatrix W(model.K.rows(), columns);
  W.setFromTriplets(entries.begin(), entries.end());
  return W;
}

/// The receptance between the points over the known modes k and all others, whose contribution is taken at the shift,
/// where the factor gives it exactly: H(ω²) = Wᵀ(K − σM)⁻¹W + Σ_k a_k a_kᵀ (1/(λ_k − ω²) − 1/(λ_k − σ)).
Eigen::MatrixXd receptance(const Responses& s, double omega_squared) {
  const Eigen::VectorXd share = (s.lambda - omega_squared).inverse() - (s.lambda - s.sigma).inverse();
  return s.flexibility + s.amplitudes * share.asDiagonal() * s.amplitudes.transpose();
}

/// The scale for the error of every entry of a receptance. The diagonal of B = Σ |a| |a|ᵀ / |λ − ω²|, plus the
/// magnitude of the other modes' contribution, is the receptance that the modes' contributions would add up to if none
/// cancelled. At an antiresonance they do cancel, and an error relative to the remainder would say nothing about the
/// model. The entry (i, j) has the scale √(B_ii B_jj), which bounds it (Cauchy-Schwarz) and leaves one that vanishes by
/// symmetry a scale.
Eigen::MatrixXd magnitudes(const Responses& s, double omega_squared) {
  const Eigen::VectorXd share = (s.lambda - omega_squared).inverse().abs();
  const Eigen::VectorXd at_shift = (s.lambda - s.sigma).inverse();
  const Eigen::MatrixXd squares = s.amplitudes.cwiseAbs2();
  const Eigen::VectorXd rest = (s.flexibility.diagonal() - squares * at_shift).cwiseAbs();
  const Eigen::VectorXd root = (rest + squares * share).cwiseSqrt();
  return root * root.transpose();
}

/// Values of ω² at which receptances are compared: the shift, then up to five places midway between frequencies at
/// least 25 % apart, away from resonances.
std::vector<double> compared_omega_squared(const Modes& modes, double sigma) {
  std::vector<double> places{sigma};
  for (Eigen::Index k = std::max(modes.rigid_motions, 0); k + 1 < modes.frequency_hz.size(); ++k) {
    if (modes.frequency_hz(k) <= 0.0 || modes.frequency_hz(k + 1) < 1.25 * modes.frequency_hz(k)) continue;
    const double middle = std::numbers::pi * (modes.frequency_hz(k) + modes.frequency_hz(k + 1));
    places.push_back(middle * middle);
    if (places.size() == 6) break;
  }
  return places;
}

}  // namespace

Responses responses_of(const Model& model, const Factored& factored, const Modes& modes,
                       const std::vector<NamedPoint>& points) {
  if (points.empty()) return {};
  const linalg::SparseMatrix W = point_loads(model, points);
  return {modes.pairs.lambda.array(), factored.sigma, W.transpose() * modes.pairs.Phi,
          W.transpose() * factored.factor.solve(Eigen::MatrixXd(W))};
}

ReceptanceChange receptance_change(const Responses& a, const Responses& b, const Modes& modes) {
  ReceptanceChange worst;
  for (const double place : compared_omega_squared(modes, b.sigma)) {
    // Both at the same place: the shifts of a free part, which scale with the matrices, differ by half between orders,
    // and its rigid motions have a receptance there that is inverse to it.
    const Eigen::MatrixXd change = (receptance(a, place) - receptance(b, place)).cwiseAbs();
    const Eigen::MatrixXd magnitude = magnitudes(b, place);
    worst.of_largest = std::max(worst.of_largest, change.maxCoeff() / magnitude.maxCoeff());
    Eigen::Index row = 0, column = 0;
    const double of_own = change.cwiseQuotient(magnitude).maxCoeff(&row, &column);
    if (of_own > worst.of_own) worst = {worst.of_largest, of_own, row, column};
  }
  return worst;
}

std::string receptance_name(const std::vector<NamedPoint>& points, Eigen::Index row, Eigen::Index column) {
  std::vector<std::string> names;
  for (const NamedPoint& point : points) {
    for (const auto& d : point.directions) names.push_back(dynamics::name({point.name, d}));
    for (const auto& d : point.turns) names.push_back(dynamics::name({point.name, d, dynamics::DofKind::rotation}));
  }
  const std::string& to = names[static_cast<std::size_t>(row)];
  return row == column ? to : names[static_cast<std::size_t>(column)] + " to " + to;
}

}  // namespace thinwall::fem
