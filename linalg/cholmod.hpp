#pragma once
// A C++ interface to CHOLMOD's analysis and numeric factorisation. Internal to linalg/.

#include <cholmod.h>

#include <string>
#include <vector>

#include "core/error.hpp"
#include "linalg/sparse.hpp"

namespace thinwall::linalg {

/// CHOLMOD's description of a symmetric matrix by its lower triangle, from the arrays of its compressed columns.
/// Nothing is copied, so that the arrays must outlive it. `values` is null for a pattern without numbers.
inline cholmod_sparse cholmod_view(std::size_t rows, int* first, int* row, double* values) {
  cholmod_sparse view{};
  view.nrow = rows;
  view.ncol = rows;
  view.nzmax = static_cast<std::size_t>(first[rows]);
  view.p = first;
  view.i = row;
  view.x = values;
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = values != nullptr ? CHOLMOD_REAL : CHOLMOD_PATTERN;
  view.dtype = CHOLMOD_DOUBLE;
  view.packed = 1;
  return view;
}

/// CHOLMOD's description of the symmetric matrix A, of which it reads the lower triangle. Nothing is copied, so that A
/// must outlive it.
inline cholmod_sparse cholmod_view(const SparseMatrix& A) {
  cholmod_sparse view = cholmod_view(static_cast<std::size_t>(A.rows()), const_cast<int*>(A.outerIndexPtr()),
                                     const_cast<int*>(A.innerIndexPtr()), const_cast<double*>(A.valuePtr()));
  view.sorted = 1;
  return view;
}

/// CHOLMOD's workspace and one factor, freed together. `method` is CHOLMOD_SUPERNODAL or CHOLMOD_SIMPLICIAL; the
/// ordering is always given by the caller.
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

  /// Makes the symbolic factorisation with the given permutation (new position → old row). Throws NumericalError if the
  /// factor exceeds 32-bit indices or the memory.
  void analyse(cholmod_sparse* A, std::vector<int> permutation) {
    L = cholmod_analyze_p(A, permutation.data(), nullptr, 0, &common);
    if (L != nullptr) return;
    const std::string matrix = "a matrix of " + std::to_string(permutation.size()) + " rows: use larger elements";
    throw core::NumericalError(common.status == CHOLMOD_TOO_LARGE ? "32-bit indices end before the factor of " + matrix
                                                                  : "out of memory while analysing " + matrix);
  }

  /// Makes the numeric factorisation. Afterwards L->minor < L->n tells that A is not positive definite (supernodal), or
  /// that a pivot vanished (simplicial). Throws NumericalError for lack of memory and other failures.
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
