#pragma once
// Factors that another engine holds in place of this process, such as MUMPS on the ranks of distributed/.

#include <Eigen/Core>
#include <functional>
#include <memory>

#include "linalg/sparse_cholesky.hpp"

namespace thinwall::linalg {

/// The factor of a symmetric positive definite matrix, held by another engine.
class ExternalFactor {
 public:
  ExternalFactor() = default;
  virtual ~ExternalFactor() = default;
  ExternalFactor(const ExternalFactor&) = delete;
  ExternalFactor& operator=(const ExternalFactor&) = delete;

  /// The solution A⁻¹ B for B: n × any. It may be called from several threads at once.
  [[nodiscard]] virtual Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& B) const = 0;
  /// Size and cost of the factor.
  [[nodiscard]] virtual FactorStatistics statistics() const = 0;
};

/// A function that factorises a matrix, as SparseCholesky does, by another engine; null where that would not pay. It
/// throws NumericalError for a matrix that is not positive definite, and MemoryLimitError.
using Factoriser = std::function<std::unique_ptr<ExternalFactor>(const SparseMatrix& A, const FactorOptions& options)>;

/// Sets the engine that SparseCholesky asks first, for the whole process, and returns the one before; empty for none,
/// as at the start. Not to be called while another thread factorises.
Factoriser set_factoriser(Factoriser factoriser);

/// True if an engine is set.
[[nodiscard]] bool has_factoriser();

/// The factor that the engine set last makes of A; null without an engine, or if it leaves A to this process.
[[nodiscard]] std::unique_ptr<ExternalFactor> external_factor(const SparseMatrix& A, const FactorOptions& options);

}  // namespace thinwall::linalg
