#pragma once
// The nodes of order p on a mesh of straight-sided tetrahedra.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "mesh/tet_mesh.hpp"

namespace thinwall::mesh {

/// The barycentric lattice of order p: all (p+1)(p+2)(p+3)/6 quadruples α with α₀ + α₁ + α₂ + α₃ = p. Local node a of
/// every element lies at λ = α_a / p. The four vertices come first, in order.
[[nodiscard]] std::vector<std::array<int, 4>> lattice(int order);

/// Nodes shared by the elements: positions (nodes × 3, m) and for each element its (p+1)(p+2)(p+3)/6 node indices, in
/// the order of lattice(p), one row for each element. The mesh's vertices keep their indices as the first nodes.
struct LagrangeNodes {
  int order = 0;
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> positions;
  Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> elements;
};

/// The nodes of order 1…6 on a mesh, at their places on the straight elements. Two elements share a node exactly if
/// both describe it by the same weighted set of vertices, so that the orientation of a shared edge or face needs no
/// special case. Throws InputError for another order. Cost O(nodes log nodes).
[[nodiscard]] LagrangeNodes lagrange_nodes(const TetMesh& mesh, int order);

/// The nodes of another order on the elements of `nodes`, which are of order 1 or 2 and may be curved: x(λ) = Σ N_a(λ)
/// x_a at each of them. Throws as lagrange_nodes(), and InputError for nodes of a higher order. Cost as
/// lagrange_nodes().
[[nodiscard]] LagrangeNodes nodes_of_order(const TetMesh& mesh, const LagrangeNodes& nodes, int order);

/// The nodes of `to` on edges, faces and elements of which `set` has every node of `from`, another order on the same
/// mesh; ascending. `set`: nodes of `from`. Cost O(elements · nodes of an element of each order).
[[nodiscard]] std::vector<int> set_of_order(const LagrangeNodes& from, const std::vector<int>& set,
                                            const LagrangeNodes& to);

/// The number of nodes that lagrange_nodes() would make, without making them: V + (p − 1) E + (p − 1)(p − 2)/2 F
/// + (p − 1)(p − 2)(p − 3)/6 T for the vertices that elements use, edges, faces and elements. Throws InputError for
/// another order than 1…6. Cost O(elements log elements).
[[nodiscard]] std::int64_t lagrange_node_count(const TetMesh& mesh, int order);

}  // namespace thinwall::mesh
