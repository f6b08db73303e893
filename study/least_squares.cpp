#include "study/least_squares.hpp"

#include <utility>
#include <vector>

#include "core/dense_factorisations.hpp"

namespace thinwall::study {

namespace {

Eigen::VectorXd clamped(const Eigen::VectorXd& x) {
  return x.cwiseMax(0.0).cwiseMin(1.0);
}

/// Gauss-Newton step with the parameters that sit on a bound and push outwards held there.
Eigen::VectorXd step_within_bounds(const LeastSquares& at) {
  const Eigen::VectorXd downhill = -at.jacobian.transpose() * at.residuals;
  std::vector<Eigen::Index> free;
  for (Eigen::Index k = 0; k < at.parameters.size(); ++k) {
    const bool stuck = (at.parameters(k) <= 0.0 && downhill(k) < 0.0) || (at.parameters(k) >= 1.0 && downhill(k) > 0.0);
    if (!stuck) free.push_back(k);
  }
  Eigen::VectorXd step = Eigen::VectorXd::Zero(at.parameters.size());
  if (free.empty()) return step;
  const Eigen::VectorXd inner = at.jacobian(Eigen::all, free).colPivHouseholderQr().solve(-at.residuals);
  step(free) = inner;
  return clamped(at.parameters + step) - at.parameters;
}

}  // namespace

JacobianAt forward_differences(ResidualsAt r, double difference) {
  return [r = std::move(r), difference](const Eigen::VectorXd& at, const Eigen::VectorXd& r_at) {
    Eigen::MatrixXd jacobian(r_at.size(), at.size());
    for (Eigen::Index k = 0; k < at.size(); ++k) {
      Eigen::VectorXd x = at;
      const double h = x(k) + difference <= 1.0 ? difference : -difference;
      x(k) += h;
      jacobian.col(k) = (r(x) - r_at) / h;
    }
    return jacobian;
  };
}

LeastSquares bounded_least_squares(const ResidualsAt& r, const JacobianAt& jacobian, const Eigen::VectorXd& start,
                                   double tolerance, int most_iterations) {
  LeastSquares at;
  at.parameters = clamped(start);
  at.residuals = r(at.parameters);
  at.jacobian = jacobian(at.parameters, at.residuals);
  for (int iteration = 0; iteration < most_iterations && !at.converged; ++iteration) {
    Eigen::VectorXd step = step_within_bounds(at);
    for (int halving = 0; halving < 6; ++halving, step *= 0.5) {
      if (step.cwiseAbs().maxCoeff() < tolerance) {
        at.converged = true;
        break;
      }
      const Eigen::VectorXd tried = r(at.parameters + step);
      if (!tried.allFinite()) continue;
      at.jacobian += (tried - at.residuals - at.jacobian * step) * step.transpose() / step.squaredNorm();
      if (!(tried.norm() < at.residuals.norm())) continue;
      at.parameters += step;
      at.residuals = tried;
      break;
    }
  }
  return at;
}

}  // namespace thinwall::study
