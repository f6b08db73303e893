#pragma once
// The kernel of the receptance route, solved line by line, with the condition of each solution.

#include "core/dense_factorisations.hpp"
#include "core/words.hpp"

namespace thinwall::coupling {

/// Conditions of a kernel (Skeel's, see Kernel) above which it counts as ill-conditioned, so that the result is told
/// with a warning, and as singular to double precision, so that there is no result.
inline constexpr double ill_conditioned_above = 1e8;
inline constexpr double singular_above = 1e14;

/// The treatment of small singular values of the kernel (docs/theory/coupling.md, Eq. 8).
enum class Regularisation {
  none,       ///< the kernel is used as it is; a singular one is an error
  truncated,  ///< singular values up to `threshold` times the largest are left out
  tikhonov,   ///< 1/σ → σ/(σ² + μ²), μ = `threshold` times the largest
};

/// The condition and regularisation of one line.
struct KernelLine {
  double condition = 1.0;               ///< Skeel condition of what was solved
  int dropped = 0;                      ///< singular values left out, or more than halved by Tikhonov's rule (σ < μ)
  double compatibility_residual = 0.0;  ///< largest |r − S S⁺r| / |r| over the columns r
};

/// A solver of S X = R for one small kernel S (m × m) after another, in storage that is kept. With the singular value
/// decomposition S = U Σ Vᴴ and a regularisation f(σ) in place of 1/σ, S⁺ = V f(Σ) Uᴴ; without regularisation S⁺ = S⁻¹
/// by LU. All rows and columns must have the same unit (coupling/joints.hpp), because singular values compare them.
///
/// The condition is Skeel's, ‖ D⁻¹ |S⁺| magnitude D ‖_∞, where `magnitude` is the sum of the moduli of the terms whose
/// sum is S (Higham 2002, section 7.2): the factor by which a relative error of the terms may grow, including
/// cancellation in S. D = diag(magnitude)^−½ makes it independent of the units of the directions. It is infinite for a
/// singular kernel without regularisation, and for a kernel that is zero.
///
/// Cost m³ + m² · columns of R; with a regularisation about ten times as much. Nothing is allocated after the first
/// line.
class Kernel {
 public:
  Kernel(Regularisation regularisation, double threshold) : regularisation_(regularisation), threshold_(threshold) {}

  /// Solves one line, with `magnitude` as described above. The results are in solution() and inverse() until the next
  /// call.
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

namespace thinwall::core {

template <>
inline constexpr std::array<std::string_view, 3> words<coupling::Regularisation>{"none", "truncated", "tikhonov"};

}  // namespace thinwall::core
