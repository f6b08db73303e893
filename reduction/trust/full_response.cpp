#include "reduction/trust/full_response.hpp"

#include <cmath>
#include <complex>

#include "reduction/trust/receptance_sum.hpp"

namespace thinwall::reduction {

FullResponse full_response(const linalg::SparseMatrix& K, const linalg::SparseMatrix& M,
                           const linalg::ShiftedInverse& inverse, const linalg::Eigenpairs& pairs,
                           const std::vector<double>& ratios, double rest_ratio, const Interface& interface,
                           const dynamics::FrequencyAxis& axis) {
  const ReceptanceSum sum = receptance_sum(K, M, inverse, pairs, interface, axis.omega_rad_s(axis.size() - 1));
  Eigen::VectorXd ratio = Eigen::VectorXd::Zero(sum.lambda.size());  // modes beyond the known ones are not damped
  for (Eigen::Index k = 0; k < sum.modes; ++k)
    ratio(k) = k < static_cast<Eigen::Index>(ratios.size()) ? ratios[static_cast<std::size_t>(k)] : rest_ratio;
  FullResponse result;
  result.max_relative_residual = sum.max_relative_residual;
  result.max_relative_error = sum.max_relative_error;
  result.response.axis = axis;
  result.response.responses = interface.dofs;
  result.response.forces = interface.dofs;
  for (Eigen::Index line = 0; line < axis.size(); ++line) {
    const double omega = axis.omega_rad_s(line);
    Eigen::VectorXcd pole(sum.lambda.size());
    for (Eigen::Index k = 0; k < pole.size(); ++k) {
      const double lambda = sum.lambda(k);
      pole(k) = 1.0 / std::complex<double>(lambda - omega * omega, 2.0 * ratio(k) * std::sqrt(lambda) * omega);
    }
    result.response.H.emplace_back(sum.amplitude * pole.asDiagonal() * sum.amplitude.transpose());
  }
  return result;
}

}  // namespace thinwall::reduction
