#pragma once
// The memory of a solution on a mesh, before its matrices are assembled.

#include "linalg/matrix_graph.hpp"
#include "linalg/sparse.hpp"
#include "mesh/tet_mesh.hpp"

namespace thinwall::fem {

/// The graph of the matrices on a mesh at order p. Its nodes are the vertices, edges, faces and interiors of the
/// elements, with the three rows of each Lagrange node inside them: 1, p − 1, (p − 1)(p − 2)/2 and
/// (p − 1)(p − 2)(p − 3)/6 Lagrange nodes; those without one are left out. Two nodes are neighbours if they belong to
/// one element. This is linalg::pattern_graph() of the unconstrained stiffness matrix but for the numbering. Cost
/// O(elements log elements).
[[nodiscard]] linalg::MatrixGraph element_graph(const mesh::TetMesh& mesh, int order);

/// The bytes that the values and indices of a matrix take.
[[nodiscard]] double bytes_of(const linalg::SparseMatrix& A);

/// The memory that a solution at order p takes at its worst, when K − σM is factorised: K, M, which has a third of
/// its entries because it does not couple the axes, and linalg::factor_bytes() of the element_graph(). K − σM is a
/// matrix of its own, with the entries of K, only while another engine is set (linalg::has_factoriser()), as on ranks:
/// a factorisation in this process reads the sum from K and M, because M has no entry outside K. Supports, which take
/// rows away, are not counted. Cost and errors as there.
[[nodiscard]] double solution_bytes(const mesh::TetMesh& mesh, int order);

}  // namespace thinwall::fem
