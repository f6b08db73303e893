#pragma once
// CHOLMOD's analysis and numeric factorisation with 32- or 64-bit indices, behind one name. Internal to linalg/.

#include <cholmod.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "core/error.hpp"
#include "linalg/sparse.hpp"

namespace thinwall::linalg {

/// The library's functions for one width of index: int or std::int64_t.
template <class Index>
struct Cholmod {
  static constexpr bool wide = std::is_same_v<Index, std::int64_t>;
  static constexpr int itype = wide ? CHOLMOD_LONG : CHOLMOD_INT;
  static constexpr auto start = wide ? &cholmod_l_start : &cholmod_start;
  static constexpr auto finish = wide ? &cholmod_l_finish : &cholmod_finish;
  static constexpr auto free_factor = wide ? &cholmod_l_free_factor : &cholmod_free_factor;
  static constexpr auto factorize = wide ? &cholmod_l_factorize : &cholmod_factorize;
};

/// A symmetric matrix as CHOLMOD sees it, its lower triangle: values not copied, indices only where they must be
/// widened.
template <class Index>
class CholmodView {
 public:
  explicit CholmodView(const SparseMatrix& A) {
    sparse_.nrow = static_cast<std::size_t>(A.rows());
    sparse_.ncol = static_cast<std::size_t>(A.cols());
    sparse_.nzmax = static_cast<std::size_t>(A.nonZeros());
    sparse_.p = indices(A.outerIndexPtr(), sparse_.ncol + 1, columns_);
    sparse_.i = indices(A.innerIndexPtr(), sparse_.nzmax, rows_);
    sparse_.x = const_cast<double*>(A.valuePtr());
    sparse_.stype = -1;
    sparse_.itype = Cholmod<Index>::itype;
    sparse_.xtype = CHOLMOD_REAL;
    sparse_.dtype = CHOLMOD_DOUBLE;
    sparse_.sorted = 1;
    sparse_.packed = 1;
  }
  CholmodView(const CholmodView&) = delete;
  CholmodView& operator=(const CholmodView&) = delete;
  ~CholmodView() = default;

  cholmod_sparse* get() { return &sparse_; }

 private:
  static void* indices(const int* from, std::size_t count, std::vector<Index>& copy) {
    if constexpr (!Cholmod<Index>::wide) return const_cast<int*>(from);
    copy.assign(from, from + count);
    return copy.data();
  }

  cholmod_sparse sparse_{};
  std::vector<Index> columns_;
  std::vector<Index> rows_;
};

/// CHOLMOD's workspace and a factor, freed together.
template <class Index>
struct CholmodFactor {
  mutable cholmod_common common{};
  cholmod_factor* L = nullptr;

  explicit CholmodFactor(int method) {
    Cholmod<Index>::start(&common);
    common.print = 0;
    common.try_catch = 1;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    common.postorder = 1;
    common.supernodal = method;
    common.final_ll = method == CHOLMOD_SUPERNODAL ? 1 : 0;
  }
  ~CholmodFactor() {
    Cholmod<Index>::free_factor(&L, &common);
    Cholmod<Index>::finish(&common);
  }
  CholmodFactor(const CholmodFactor&) = delete;
  CholmodFactor& operator=(const CholmodFactor&) = delete;

  /// Symbolic factorisation with a given permutation. False if the factor has more values than the indices can count.
  [[nodiscard]] bool analyse(CholmodView<Index>& A, const std::vector<int>& permutation) {
    std::vector<Index> order(permutation.begin(), permutation.end());
    if constexpr (Cholmod<Index>::wide) {
      L = cholmod_l_analyze_p(A.get(), order.data(), nullptr, 0, &common);
    } else {
      L = cholmod_analyze_p(A.get(), order.data(), nullptr, 0, &common);
    }
    if (L != nullptr) return true;
    if (common.status == CHOLMOD_TOO_LARGE) return false;
    throw core::NumericalError("out of memory while analysing a matrix of " + std::to_string(order.size()) +
                               " rows: use larger elements");
  }

  /// Numeric factorisation; positive definite or not is told by L->minor.
  void factorise(CholmodView<Index>& A) {
    Cholmod<Index>::factorize(A.get(), L, &common);
    if (common.status >= CHOLMOD_OK) return;
    const std::string rows = std::to_string(A.get()->nrow) + " rows";
    if (common.status == CHOLMOD_OUT_OF_MEMORY) {
      throw core::NumericalError("out of memory in the factorisation of " + rows + " (factor of " +
                                 std::to_string(common.lnz * 8e-9) + " GB): use larger elements");
    }
    throw core::NumericalError("CHOLMOD could not factor a matrix of " + rows + " (status " +
                               std::to_string(common.status) + ")");
  }
};

}  // namespace thinwall::linalg
