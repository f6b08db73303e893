#include "reduction/full_response.hpp"

#include <cmath>
#include <complex>
#include <string>

#include "core/error.hpp"
#include "linalg/tall.hpp"

namespace thinwall::reduction {

FullResponse full_response(const linalg::SparseMatrix& K, const linalg::SparseMatrix& M,
                           const linalg::ShiftedInverse& inverse, const linalg::Eigenpairs& pairs,
                           const std::vector<double>& ratios, double rest, const Interface& interface,
                           const dynamics::FrequencyAxis& axis) {
  const double omega_max = axis.omega_rad_s(axis.size() - 1);
  const double quotient = omega_max * omega_max / pairs.lambda(pairs.lambda.size() - 1);
  if (!(quotient <= 0.81)) {
    throw core::InputError("the band reaches to " + std::to_string(axis.hz(axis.size() - 1)) +
                           " Hz, beyond 0.9 of the highest mode known: compute more modes (modes.up_to)");
  }
  const Eigen::MatrixXd& Phi = pairs.Phi;
  const Eigen::MatrixXd MPhi = linalg::symmetric_product(M, Phi);
  const Eigen::MatrixXd W = interface.W;
  const Eigen::MatrixXd amplitude = interface.W.transpose() * Phi;
  Eigen::MatrixXd X = inverse.apply(W);
  Eigen::MatrixXd undamped = Eigen::MatrixXd::Zero(W.rows(), W.cols());  // the series at the highest frequency
  std::vector<Eigen::MatrixXd> moments;  // times ω_max^{2k}, which keeps them of one size
  for (double power = 1.0; power > 1e-14; power *= quotient) {
    linalg::tall_subtract(X, Phi, linalg::tall_gram(MPhi, X));
    undamped += X;
    moments.emplace_back(interface.W.transpose() * X);
    X = omega_max * omega_max * inverse.apply(linalg::symmetric_product(M, X));
  }
  FullResponse result;
  const Eigen::VectorXd dynamic = (pairs.lambda.array() - omega_max * omega_max).inverse();
  undamped += Phi * (dynamic.asDiagonal() * amplitude.transpose());
  const Eigen::MatrixXd R = K * undamped - omega_max * omega_max * (M * undamped) - W;
  result.max_relative_residual = (R.colwise().norm().array() / W.colwise().norm().array()).maxCoeff();
  result.response.axis = axis;
  result.response.responses = interface.dofs;
  result.response.forces = interface.dofs;
  for (Eigen::Index line = 0; line < axis.size(); ++line) {
    const double omega = axis.omega_rad_s(line);
    Eigen::VectorXcd pole(pairs.lambda.size());
    for (Eigen::Index k = 0; k < pole.size(); ++k) {
      const double zeta = k < static_cast<Eigen::Index>(ratios.size()) ? ratios[static_cast<std::size_t>(k)] : rest;
      pole(k) =
          1.0 / std::complex<double>(pairs.lambda(k) - omega * omega, 2.0 * zeta * std::sqrt(pairs.lambda(k)) * omega);
    }
    Eigen::MatrixXcd H = amplitude * pole.asDiagonal() * amplitude.transpose();
    double power = 1.0;
    for (const auto& moment : moments) {
      H += power * moment;
      power *= (omega / omega_max) * (omega / omega_max);
    }
    result.response.H.push_back(std::move(H));
  }
  return result;
}

}  // namespace thinwall::reduction
