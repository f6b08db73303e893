#include "linalg/factor_bytes.hpp"

#include "linalg/ordering.hpp"
#include "linalg/supernodal_factor.hpp"

namespace thinwall::linalg {

double factor_bytes(const SymbolicFactor& L, const TreeCut& cut) {
  return 8.0 * static_cast<double>(L.values()) + 4.0 * static_cast<double>(L.rows.size()) + update_bytes(L, cut);
}

double factor_bytes(const MatrixGraph& graph) {
  const SymbolicFactor L = symbolic_factor(graph, least_fill_order(graph));
  return factor_bytes(L, tree_cut(L));
}

}  // namespace thinwall::linalg
