#pragma once
// The eigenvalue of largest modulus of a real linear map that is known by its action only.

#include <Eigen/Core>
#include <complex>
#include <functional>

namespace thinwall::milling {

/// out = map(in); both of the map's size.
using LinearMap = std::function<void(const Eigen::Ref<const Eigen::VectorXd>&, Eigen::Ref<Eigen::VectorXd>)>;

/// `value` with Im ≥ 0. `residual` = ‖D v − μ v‖ / ‖v‖ over max(|μ|, tiny); `converged` only if it meets the tolerance.
struct [[nodiscard]] DominantEigenvalue {
  std::complex<double> value;
  Eigen::VectorXcd vector;
  double residual = 0.0;
  bool converged = false;
  Eigen::Index basis = 0;  ///< vectors that Arnoldi's method took; 0 if dense
};

/// Up to 60 unknowns: the matrix column by column and all its eigenvalues. Above: Arnoldi's method (Arnoldi 1951) from
/// a fixed start, with full reorthogonalisation and no restart; the basis grows until the residual of the largest Ritz
/// value is below `tolerance` and that of the next one, in modulus, below 1e-3, so that a value still on its way up is
/// not overlooked. The maps of this folder are compact up to the few structural modes, and 20 to 50 vectors suffice. If
/// the basis would outgrow 200 vectors the result says that it has not converged. A look at the Ritz values costs as
/// much as several vectors: `first_look` is the basis size of the first, best what a similar map has needed. Cost: one
/// application of the map a vector, O(k² size).
DominantEigenvalue dominant_eigenvalue(const LinearMap& map, Eigen::Index size, double tolerance,
                                       Eigen::Index first_look = 20);

/// The dominant eigenvalue by all eigenvalues of the matrix, for comparison.
DominantEigenvalue dominant_eigenvalue_dense(const LinearMap& map, Eigen::Index size, double tolerance);
/// The dominant eigenvalue by Arnoldi's method, whose Ritz values are first looked at after so many steps.
DominantEigenvalue dominant_eigenvalue_arnoldi(const LinearMap& map, Eigen::Index size, double tolerance,
                                               Eigen::Index first_look = 20);

}  // namespace thinwall::milling
