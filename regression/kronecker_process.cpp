#include "regression/kronecker_process.hpp"

#include <cmath>
#include <numbers>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"

namespace thinwall::regression {

std::optional<KroneckerProcess> kronecker_process(Kernel kernel, const TaskData& data,
                                                  const HyperParameters& parameters) {
  if (!data.complete())
    throw core::InputError("regression: a target is missing, must be there for the Kronecker path; take the dense one");
  KroneckerProcess p{kernel, data, parameters, {}, {}, {}, {}, {}, {}, {}, {}};
  p.kappa = correlation(kernel, data.inputs, data.inputs, parameters.length);
  p.D = parameters.noise_sd.array().square() + jitter;
  const Eigen::VectorXd root = p.D.cwiseSqrt();
  const Eigen::MatrixXd whitened = root.cwiseInverse().asDiagonal() * parameters.B() * root.cwiseInverse().asDiagonal();
  if (!p.kappa.allFinite() || !whitened.allFinite()) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> tasks(whitened), places(p.kappa);
  if (tasks.info() != Eigen::Success || places.info() != Eigen::Success) return std::nullopt;
  // Both are positive semi-definite; what is below zero is round-off.
  p.Q = places.eigenvectors();
  p.S = places.eigenvalues().cwiseMax(0.0);
  p.W = root.cwiseInverse().asDiagonal() * tasks.eigenvectors();
  p.Lambda = tasks.eigenvalues().cwiseMax(0.0);
  p.inner = ((p.S * p.Lambda.transpose()).array() + 1.0).inverse();
  const Eigen::MatrixXd whitened_y = p.Q.transpose() * data.targets * p.W;
  p.alpha = p.Q * whitened_y.cwiseProduct(p.inner) * p.W.transpose();
  if (!p.alpha.allFinite()) return std::nullopt;
  return p;
}

Likelihood log_likelihood(const KroneckerProcess& p) {
  const auto n = static_cast<double>(p.data.places());
  const Eigen::Index d = p.data.inputs.cols(), tasks = p.data.tasks();
  Likelihood result;
  const double log_determinant = n * p.D.array().log().sum() - p.inner.array().log().sum();
  result.value = -0.5 * p.data.targets.cwiseProduct(p.alpha).sum() - 0.5 * log_determinant -
                 0.5 * n * static_cast<double>(tasks) * std::log(2.0 * std::numbers::pi);
  HyperParameters slope = p.parameters;  // of the same shape
  const Eigen::MatrixXd B = p.parameters.B();
  // tr(K⁻¹ (B ⊗ ∂κ)) = Σ_ij Λ_i/(S_j Λ_i + 1) (Qᵀ ∂κ Q)_jj
  const Eigen::VectorXd weight = p.inner * p.Lambda;
  for (Eigen::Index k = 0; k < d; ++k) {
    const Eigen::MatrixXd change = correlation_change(p.kernel, p.data.inputs, p.parameters.length, k);
    const Eigen::MatrixXd changed_alpha = change * p.alpha;
    const double of_data = (p.alpha.transpose() * changed_alpha).cwiseProduct(B).sum();
    slope.length(k) = 0.5 * (of_data - (p.Q.cwiseProduct(change * p.Q).colwise().sum() * weight)(0));
  }
  const Eigen::MatrixXd of_tasks =
      0.5 * (p.alpha.transpose() * p.kappa * p.alpha -
             Eigen::MatrixXd(p.W * (p.inner.transpose() * p.S).asDiagonal() * p.W.transpose()));
  slope.L = 2.0 * of_tasks * p.parameters.L;
  const Eigen::VectorXd traces =
      (p.W * Eigen::VectorXd(p.inner.colwise().sum().transpose()).asDiagonal() * p.W.transpose()).diagonal();
  slope.noise_sd =
      p.parameters.noise_sd.array().square() * (p.alpha.colwise().squaredNorm().transpose() - traces).array();
  result.gradient = gradient_of(slope, p.parameters);
  return result;
}

Prediction predict(const KroneckerProcess& p, const Eigen::MatrixXd& inputs) {
  const Eigen::MatrixXd B = p.parameters.B();
  const Eigen::Index m = inputs.rows(), tasks = B.rows(), n = p.data.places();
  const Eigen::MatrixXd k = correlation(p.kernel, inputs, p.data.inputs, p.parameters.length);
  const Eigen::MatrixXd between = correlation(p.kernel, inputs, inputs, p.parameters.length);
  Prediction result;
  result.mean = k * p.alpha * B;
  // K⁻¹ in the eigenvectors is diagonal, so that the covariance is B ⊗ κ** less the rows B W ⊗ κ* Q, weighted.
  const Eigen::MatrixXd of_tasks = B * p.W, of_places = k * p.Q;
  Eigen::MatrixXd rows(m * tasks, n * tasks);
  for (Eigen::Index i = 0; i < m; ++i) {
    for (Eigen::Index t = 0; t < tasks; ++t) {
      for (Eigen::Index a = 0; a < tasks; ++a) {
        rows.row(i * tasks + t).segment(a * n, n) =
            of_tasks(t, a) * of_places.row(i).cwiseProduct(p.inner.col(a).cwiseSqrt().transpose());
      }
    }
  }
  result.covariance = -rows * rows.transpose();
  for (Eigen::Index i = 0; i < m; ++i) {
    for (Eigen::Index j = 0; j < m; ++j)
      result.covariance.block(i * tasks, j * tasks, tasks, tasks) += between(i, j) * B;
  }
  return result;
}

LeaveOneOut leave_one_out(const KroneckerProcess& p) {
  const Eigen::MatrixXd of_inverse = p.Q.cwiseAbs2() * p.inner * p.W.cwiseAbs2().transpose();
  return {p.data.targets - p.alpha.cwiseQuotient(of_inverse), of_inverse.cwiseInverse()};
}

}  // namespace thinwall::regression
