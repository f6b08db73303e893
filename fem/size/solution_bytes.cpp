#include "fem/size/solution_bytes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <map>
#include <numeric>
#include <vector>

#include "linalg/external_factor.hpp"
#include "linalg/factor_bytes.hpp"

namespace thinwall::fem {

namespace {

constexpr double bytes_of_entry = sizeof(double) + sizeof(linalg::SparseMatrix::StorageIndex);

using Entity = std::array<int, 4>;  // its vertices, ascending, after −1 for each that it lacks

/// The vertices, edges, faces and the interior of an element.
std::vector<Entity> entities_of(const std::array<int, 4>& tet) {
  std::vector<Entity> all;
  for (unsigned subset = 1; subset < 16; ++subset) {
    Entity entity{-1, -1, -1, -1};
    for (std::size_t i = 0; i < 4; ++i) {
      if ((subset >> i & 1U) != 0) entity[i] = tet[i];
    }
    std::ranges::sort(entity);
    all.push_back(entity);
  }
  return all;
}

/// The number of Lagrange nodes of order p inside an entity.
int nodes_inside(const Entity& entity, int p) {
  const std::array<int, 4> of_vertices{1, p - 1, (p - 1) * (p - 2) / 2, (p - 1) * (p - 2) * (p - 3) / 6};
  return of_vertices[static_cast<std::size_t>(3 - std::ranges::count(entity, -1))];
}

/// The entries of a matrix with this graph, both triangles.
double entry_count(const linalg::MatrixGraph& graph) {
  double entries = 0.0;
  for (int node = 0; node < graph.size(); ++node) {
    const auto rows = [&](int other) {
      return static_cast<double>(graph.rows[static_cast<std::size_t>(other)].size());
    };
    double width = rows(node);
    for (const int other : graph.around(node)) width += rows(other);
    entries += rows(node) * width;
  }
  return entries;
}

}  // namespace

linalg::MatrixGraph element_graph(const mesh::TetMesh& mesh, int order) {
  linalg::MatrixGraph graph;
  std::map<Entity, int> number;
  int next_row = 0;
  for (const auto& tet : mesh.tets) {
    std::vector<int> nodes;
    for (const Entity& entity : entities_of(tet)) {
      const int inside = nodes_inside(entity, order);
      if (inside == 0) continue;
      const auto [at, is_new] = number.try_emplace(entity, graph.size());
      nodes.push_back(at->second);
      if (!is_new) continue;
      auto& rows = graph.rows.emplace_back(3 * static_cast<std::size_t>(inside));
      std::iota(rows.begin(), rows.end(), next_row);
      next_row += 3 * inside;
    }
    graph.neighbours.resize(graph.rows.size());
    for (const int node : nodes) {
      auto& around = graph.neighbours[static_cast<std::size_t>(node)];
      std::ranges::copy_if(nodes, std::back_inserter(around), [node](int other) { return other != node; });
    }
  }
  for (auto& around : graph.neighbours) {
    std::ranges::sort(around);
    around.erase(std::unique(around.begin(), around.end()), around.end());
  }
  return graph;
}

double bytes_of(const linalg::SparseMatrix& A) {
  return bytes_of_entry * static_cast<double>(A.nonZeros());
}

double solution_bytes(const mesh::TetMesh& mesh, int order) {
  const linalg::MatrixGraph graph = element_graph(mesh, order);
  const double of_K = bytes_of_entry * entry_count(graph), of_M = of_K / 3.0;  // the axes have no mass in common
  const double of_sum = linalg::has_factoriser() ? of_K : 0.0;
  return of_K + of_M + of_sum + linalg::factor_bytes(graph);
}

}  // namespace thinwall::fem
