#pragma once
// CHOLMOD's analysis and numeric factorisation. Internal to linalg/.

#include <cholmod.h>

#include <string>
#include <vector>

#include "core/error.hpp"
#include "linalg/sparse.hpp"

namespace thinwall::linalg {

/// A symmetric matrix as CHOLMOD sees it, its lower triangle; nothing is copied.
inline cholmod_sparse cholmod_view(const SparseMatrix& A) {
  cholmod_sparse view{};
  view.nrow = static_cast<std::size_t>(A.rows());
  view.ncol = static_cast<std::size_t>(A.cols());
  view.nzmax = static_cast<std::size_t>(A.nonZeros());
  view.p = const_cast<int*>(A.outerIndexPtr());
  view.i = const_cast<int*>(A.innerIndexPtr());
  view.x = const_cast<double*>(A.valuePtr());
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

/// CHOLMOD's workspace and a factor, freed together.
struct CholmodFactor {
  mutable cholmod_common common{};
  cholmod_factor* L = nullptr;

  explicit CholmodFactor(int method) {
    cholmod_start(&common);
    common.print = 0;
    common.try_catch = 1;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    common.postorder = 1;
    common.supernodal = method;
    common.final_ll = method == CHOLMOD_SUPERNODAL ? 1 : 0;
  }
  ~CholmodFactor() {
    cholmod_free_factor(&L, &common);
    cholmod_finish(&common);
  }
  CholmodFactor(const CholmodFactor&) = delete;
  CholmodFactor& operator=(const CholmodFactor&) = delete;

  /// Symbolic factorisation with a given permutation. Throws NumericalError if the factor is beyond 32-bit indices or
  /// the memory.
  void analyse(cholmod_sparse* A, std::vector<int> permutation) {
    L = cholmod_analyze_p(A, permutation.data(), nullptr, 0, &common);
    if (L != nullptr) return;
    const std::string matrix = "a matrix of " + std::to_string(permutation.size()) + " rows: use larger elements";
    throw core::NumericalError(common.status == CHOLMOD_TOO_LARGE ? "32-bit indices end before the factor of " + matrix
                                                                  : "out of memory while analysing " + matrix);
  }

  /// Numeric factorisation; positive definite or not is told by L->minor.
  void factorise(cholmod_sparse* A) {
    cholmod_factorize(A, L, &common);
    if (common.status >= CHOLMOD_OK) return;
    const std::string rows = std::to_string(A->nrow) + " rows";
    if (common.status == CHOLMOD_OUT_OF_MEMORY) {
      throw core::NumericalError("out of memory in the factorisation of " + rows + " (factor of " +
                                 std::to_string(common.lnz * 8e-9) + " GB): use larger elements");
    }
    throw core::NumericalError("CHOLMOD could not factor a matrix of " + rows + " (status " +
                               std::to_string(common.status) + ")");
  }
};

}  // namespace thinwall::linalg
