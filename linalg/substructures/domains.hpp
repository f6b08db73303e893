#pragma once
// The division of a sparse matrix into domains that are coupled by the rows of an interface alone.

#include <vector>

#include "linalg/sparse.hpp"

namespace thinwall::linalg {

/// Rows of a symmetric matrix by domain. An entry of the matrix couples two rows of one domain, or a row with one of
/// the interface; none couples two domains.
struct Domains {
  std::vector<std::vector<int>> inner;  ///< rows of each domain, ascending; none is empty
  std::vector<std::vector<int>>
      border;                    ///< for each domain the rows of the interface that it is coupled with, ascending
  std::vector<int> interface;    ///< rows of the interface, ascending
  std::vector<int> node_of_row;  ///< numbers of sets of rows with the same pattern, which are never divided
};

/// A division of A (n × n, both triangles) by vertex separators of its graph (METIS; Karypis & Kumar 1998), which are
/// found by repeated bisection: `count` domains of about the same number of rows, a power of two of at least 2. Where
/// the matrix is too small for so many the result has fewer; one domain has no interface. The division is deterministic
/// (fixed seed). Throws InputError for another count, NumericalError if METIS fails. Cost O(nnz log count).
[[nodiscard]] Domains divide(const SparseMatrix& A, int count);

}  // namespace thinwall::linalg
