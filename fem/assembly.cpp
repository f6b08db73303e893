#include "fem/assembly.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "fem/reference_element.hpp"

namespace thinwall::fem {

namespace {

/// For each node the nodes it shares an element with, itself included, ascending.
struct NodeGraph {
  std::vector<std::ptrdiff_t> start;
  std::vector<int> neighbours;

  [[nodiscard]] std::ptrdiff_t degree(int node) const {
    return start[static_cast<std::size_t>(node) + 1] - start[static_cast<std::size_t>(node)];
  }
  [[nodiscard]] const int* begin(int node) const { return neighbours.data() + start[static_cast<std::size_t>(node)]; }
  /// Place of `other` among the neighbours of `node`.
  [[nodiscard]] std::ptrdiff_t place(int node, int other) const {
    return std::lower_bound(begin(node), begin(node) + degree(node), other) - begin(node);
  }
};

NodeGraph node_graph(const mesh::LagrangeNodes& nodes) {
  const auto count = static_cast<std::size_t>(nodes.positions.rows());
  const auto& elements = nodes.elements;
  std::vector<int> first(count + 1, 0);
  for (const int node : elements.reshaped()) ++first[static_cast<std::size_t>(node) + 1];
  for (std::size_t i = 0; i < count; ++i) first[i + 1] += first[i];
  std::vector<int> element_of(static_cast<std::size_t>(elements.size()));
  std::vector<int> next(first.begin(), first.end() - 1);
  for (Eigen::Index e = 0; e < elements.rows(); ++e) {
    for (Eigen::Index a = 0; a < elements.cols(); ++a) {
      element_of[static_cast<std::size_t>(next[static_cast<std::size_t>(elements(e, a))]++)] = static_cast<int>(e);
    }
  }
  NodeGraph graph;
  graph.start.reserve(count + 1);
  graph.start.push_back(0);
  std::vector<int> seen(count, -1);
  for (std::size_t node = 0; node < count; ++node) {
    for (int k = first[node]; k < first[node + 1]; ++k) {
      for (const int other : elements.row(element_of[static_cast<std::size_t>(k)])) {
        if (seen[static_cast<std::size_t>(other)] == static_cast<int>(node)) continue;
        seen[static_cast<std::size_t>(other)] = static_cast<int>(node);
        graph.neighbours.push_back(other);
      }
    }
    std::sort(graph.neighbours.begin() + graph.start.back(), graph.neighbours.end());
    graph.start.push_back(static_cast<std::ptrdiff_t>(graph.neighbours.size()));
  }
  return graph;
}

/// Column pointers and row indices of a matrix of 3 × 3 blocks on the graph; `full` blocks or their diagonals only.
linalg::SparseMatrix blocks_on(const NodeGraph& graph, bool full) {
  const int nodes = static_cast<int>(graph.start.size()) - 1;
  const std::ptrdiff_t per_block_column = full ? 3 : 1;
  linalg::SparseMatrix A(3 * nodes, 3 * nodes);
  const std::ptrdiff_t entries = 3 * per_block_column * graph.start.back();
  A.resizeNonZeros(entries);
  std::fill_n(A.valuePtr(), entries, 0.0);
  int* row = A.innerIndexPtr();
  int* column = A.outerIndexPtr();
  int filled = 0;
  for (int node = 0; node < nodes; ++node) {
    for (int j = 0; j < 3; ++j) {
      column[3 * node + j] = filled;
      for (std::ptrdiff_t k = 0; k < graph.degree(node); ++k) {
        for (int i = full ? 0 : j; i < (full ? 3 : j + 1); ++i) row[filled++] = 3 * graph.begin(node)[k] + i;
      }
    }
  }
  column[3 * nodes] = filled;
  return A;
}

/// Gradients of λ₁, λ₂, λ₃ as columns, and the volume.
struct Geometry {
  Eigen::Matrix3d gradients;
  double volume = 0.0;
};

Geometry geometry(const mesh::TetMesh& mesh, int tet) {
  const auto& t = mesh.tets[static_cast<std::size_t>(tet)];
  const auto at = [&](std::size_t k) -> const Eigen::Vector3d& {
    return mesh.vertices[static_cast<std::size_t>(t[k])];
  };
  Eigen::Matrix3d edges;
  edges << at(1) - at(0), at(2) - at(0), at(3) - at(0);
  const double volume = edges.determinant() / 6.0;
  if (!(volume > 0.0)) throw core::NumericalError("tetrahedron " + std::to_string(tet) + " has no positive volume");
  return {edges.inverse().transpose(), volume};
}

/// All S^{ij}, column 3i + j, row a + nodes·b: nodes² × 9.
void gradient_products(const Geometry& g, const ReferenceElement& reference, Eigen::MatrixXd& S) {
  Eigen::Matrix<double, 9, 9> contraction;
  for (int k = 0; k < 3; ++k) {
    for (int l = 0; l < 3; ++l) {
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
          contraction(3 * k + l, 3 * i + j) = g.volume * g.gradients(i, k) * g.gradients(j, l);
      }
    }
  }
  S.noalias() = reference.stiffness * contraction;
}

}  // namespace

Assembled assemble(const mesh::TetMesh& mesh, const mesh::LagrangeNodes& nodes, const Material& material) {
  const Lame c = lame(material);
  const ReferenceElement& reference = reference_element(nodes.order);
  const NodeGraph graph = node_graph(nodes);
  if (9 * graph.start.back() > std::numeric_limits<int>::max()) {
    throw core::NumericalError("the stiffness matrix would have " + std::to_string(9 * graph.start.back()) +
                               " entries, more than 32-bit indices hold: use larger elements or a lower order");
  }
  Assembled result{blocks_on(graph, true), blocks_on(graph, false)};
  Eigen::MatrixXd S(reference.stiffness.rows(), 9);
  const int n = reference.nodes;
  for (int e = 0; e < static_cast<int>(mesh.tets.size()); ++e) {
    if (e % 1024 == 0) core::check_interrupt();
    const Geometry g = geometry(mesh, e);
    gradient_products(g, reference, S);
    for (int b = 0; b < n; ++b) {
      const int column_node = nodes.elements(e, b);
      const std::ptrdiff_t degree = graph.degree(column_node);
      double* k_block = result.K.valuePtr() + 9 * graph.start[static_cast<std::size_t>(column_node)];
      double* m_block = result.M.valuePtr() + 3 * graph.start[static_cast<std::size_t>(column_node)];
      for (int a = 0; a < n; ++a) {
        const Eigen::Index ab = a + static_cast<Eigen::Index>(n) * b;
        const std::ptrdiff_t place = graph.place(column_node, nodes.elements(e, a));
        const double trace = c.mu * (S(ab, 0) + S(ab, 4) + S(ab, 8));
        for (int j = 0; j < 3; ++j) {
          double* entry = k_block + 3 * (j * degree + place);
          for (int i = 0; i < 3; ++i) entry[i] += c.lambda * S(ab, 3 * i + j) + c.mu * S(ab, 3 * j + i);
          entry[j] += trace;
          m_block[j * degree + place] += material.density_kg_m3 * g.volume * reference.mass(a, b);
        }
      }
    }
  }
  return result;
}

}  // namespace thinwall::fem
