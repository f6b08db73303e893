#include "reduction/methods/guyan.hpp"

namespace thinwall::reduction {

CraigBampton guyan(const linalg::SparseMatrix& K, const linalg::SparseMatrix& M, const linalg::ShiftedInverse& inverse,
                   const Interface& interface) {
  return craig_bampton(K, M, inverse, interface, {.modes = 0, .up_to_hz = {}});
}

}  // namespace thinwall::reduction
