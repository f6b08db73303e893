#pragma once
// The kernel of the receptance route, solved line by line, and what solving it cost.

#include "core/dense_factorisations.hpp"

namespace thinwall::coupling {

/// What becomes of small singular values of the kernel (docs/theory/coupling.md, Eq. 8).
enum class Regularisation {
  none,       ///< the kernel as it is; a singular one is refused
  truncated,  ///< singular values up to `threshold` times the largest are left out
  tikhonov,   ///< 1/σ → σ/(σ² + μ²), μ = `threshold` times the largest
};

/// What became of one line.
struct KernelLine {
  double condition = 1.0;               ///< Skeel's, of what was solved
  int dropped = 0;                      ///< singular values left out; by Tikhonov: those with σ < μ, more than halved
  double compatibility_residual = 0.0;  ///< largest relative gap that is left: |r − S S⁺r| / |r| over the columns r
};

/// S X = R for one small kernel S (m × m) after another, in storage that stays. With the singular values σ of S = U Σ
/// Vᴴ and the regularisation f(σ) in place of 1/σ, S⁺ = V f(Σ) Uᴴ; without one S⁺ = S⁻¹ by LU. All
/// rows and columns must have one unit (coupling/joints.hpp).
///
/// The condition is Skeel's, ‖ D⁻¹ |S⁺| magnitude D ‖_∞, magnitude the sum of the moduli of the terms that S is the sum
/// of (Higham 2002, section 7.2): the factor by which a relative error of the terms may grow, cancellation in S
/// included. D = diag(magnitude)^−½ makes it independent of the units of the directions. Infinite for a singular kernel
/// without regularisation, and for a kernel that is zero.
///
/// Cost m³ and m² columns of R; with a regularisation some ten times as much. No allocation after the first line.
class Kernel {
 public:
  Kernel(Regularisation regularisation, double threshold) : regularisation_(regularisation), threshold_(threshold) {}

  /// Solves one line; see above for `magnitude`. What is found is in solution() and inverse() until the next.
  KernelLine solve(const Eigen::MatrixXcd& S, const Eigen::MatrixXd& magnitude, const Eigen::MatrixXcd& R);

  [[nodiscard]] const Eigen::MatrixXcd& solution() const { return X_; }         ///< S⁺ R
  [[nodiscard]] const Eigen::MatrixXcd& inverse() const { return S_inverse_; }  ///< S⁺

 private:
  void regularised_inverse(const Eigen::MatrixXcd& S, KernelLine& line);

  Regularisation regularisation_;
  double threshold_;
  Eigen::PartialPivLU<Eigen::MatrixXcd> lu_;
  Eigen::JacobiSVD<Eigen::MatrixXcd> svd_;
  Eigen::MatrixXcd identity_, S_inverse_, X_, gap_;
  Eigen::VectorXd row_sums_;
};

}  // namespace thinwall::coupling
