#include "mesh/lagrange_nodes.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <unordered_map>

#include "core/error.hpp"

namespace thinwall::mesh {

namespace {

/// The identity of a node: its vertices with their weights, sorted by vertex; unused places are −1, 0.
struct Key {
  std::array<std::int32_t, 4> vertices{-1, -1, -1, -1};
  std::array<std::int8_t, 4> weights{};
  bool operator==(const Key&) const = default;
};

struct KeyHash {
  std::size_t operator()(const Key& key) const {
    std::uint64_t h = 0x9e3779b97f4a7c15ULL;
    for (std::size_t i = 0; i < 4; ++i) {
      h ^= static_cast<std::uint64_t>(static_cast<std::uint32_t>(key.vertices[i])) * 8 +
           static_cast<std::uint64_t>(key.weights[i]);
      h *= 0xff51afd7ed558ccdULL;
      h ^= h >> 32U;
    }
    return h;
  }
};

/// The identity of the node at the lattice point alpha of a tetrahedron.
Key key_of(const std::array<int, 4>& tet, const std::array<int, 4>& alpha) {
  std::array<std::pair<int, int>, 4> parts{};
  for (std::size_t k = 0; k < 4; ++k) {
    parts[k] = alpha[k] > 0 ? std::pair{tet[k], alpha[k]} : std::pair{std::numeric_limits<int>::max(), 0};
  }
  std::sort(parts.begin(), parts.end());
  Key key;
  for (std::size_t k = 0; k < 4; ++k) {
    key.vertices[k] = parts[k].second > 0 ? parts[k].first : -1;
    key.weights[k] = static_cast<std::int8_t>(parts[k].second);
  }
  return key;
}

void require_order(int order) {
  if (order < 1 || order > 6) throw core::InputError("element order " + std::to_string(order) + " is outside 1 to 6");
}

/// The number of different items, which are sorted on the way.
template <class T>
std::int64_t distinct(std::vector<T>& items) {
  std::sort(items.begin(), items.end());
  return std::unique(items.begin(), items.end()) - items.begin();
}

}  // namespace

std::vector<std::array<int, 4>> lattice(int order) {
  std::vector<std::array<int, 4>> vertices_first;
  std::vector<std::array<int, 4>> others;
  for (std::size_t k = 0; k < 4; ++k) {
    std::array<int, 4> alpha{};
    alpha[k] = order;
    vertices_first.push_back(alpha);
  }
  for (int d = 0; d <= order; ++d) {
    for (int c = 0; c <= order - d; ++c) {
      for (int b = 0; b <= order - d - c; ++b) {
        const std::array<int, 4> alpha{order - b - c - d, b, c, d};
        if (*std::max_element(alpha.begin(), alpha.end()) < order) others.push_back(alpha);
      }
    }
  }
  vertices_first.insert(vertices_first.end(), others.begin(), others.end());
  return vertices_first;
}

std::int64_t lagrange_node_count(const TetMesh& mesh, int order) {
  require_order(order);
  std::vector<int> vertices;
  std::vector<std::array<int, 2>> edges;
  std::vector<std::array<int, 3>> faces;
  for (auto tet : mesh.tets) {
    std::sort(tet.begin(), tet.end());
    for (std::size_t i = 0; i < 4; ++i) {
      vertices.push_back(tet[i]);
      for (std::size_t j = i + 1; j < 4; ++j) edges.push_back({tet[i], tet[j]});
      faces.push_back({tet[i == 0 ? 1 : 0], tet[i <= 1 ? 2 : 1], tet[i <= 2 ? 3 : 2]});
    }
  }
  const std::int64_t p = order;
  return distinct(vertices) + (p - 1) * distinct(edges) + (p - 1) * (p - 2) / 2 * distinct(faces) +
         (p - 1) * (p - 2) * (p - 3) / 6 * static_cast<std::int64_t>(mesh.tets.size());
}

LagrangeNodes lagrange_nodes(const TetMesh& mesh, int order) {
  require_order(order);
  const auto alphas = lattice(order);
  LagrangeNodes nodes;
  nodes.order = order;
  nodes.elements.resize(static_cast<Eigen::Index>(mesh.tets.size()), static_cast<Eigen::Index>(alphas.size()));
  std::unordered_map<Key, int, KeyHash> number;
  number.reserve(mesh.tets.size() * alphas.size() / 3);
  std::vector<Eigen::Vector3d> positions = mesh.vertices;
  for (std::size_t tet = 0; tet < mesh.tets.size(); ++tet) {
    for (std::size_t a = 0; a < alphas.size(); ++a) {
      int& node = nodes.elements(static_cast<Eigen::Index>(tet), static_cast<Eigen::Index>(a));
      if (a < 4) {
        node = mesh.tets[tet][a];
        continue;
      }
      const auto [found, inserted] =
          number.try_emplace(key_of(mesh.tets[tet], alphas[a]), static_cast<int>(positions.size()));
      node = found->second;
      if (!inserted) continue;
      Eigen::Vector3d position = Eigen::Vector3d::Zero();
      for (std::size_t k = 0; k < 4; ++k) {
        position += alphas[a][k] * mesh.vertices[static_cast<std::size_t>(mesh.tets[tet][k])];
      }
      positions.push_back(position / order);
    }
  }
  nodes.positions.resize(static_cast<Eigen::Index>(positions.size()), 3);
  for (std::size_t i = 0; i < positions.size(); ++i)
    nodes.positions.row(static_cast<Eigen::Index>(i)) = positions[i].transpose();
  return nodes;
}

LagrangeNodes nodes_of_order(const TetMesh& mesh, const LagrangeNodes& nodes, int order) {
  if (nodes.order > 2)
    throw core::InputError("nodes of order " + std::to_string(nodes.order) + " where 1 or 2 is expected");
  LagrangeNodes result = lagrange_nodes(mesh, order);
  if (nodes.order < 2) return result;
  const auto quadratic = lattice(2);
  const auto alphas = lattice(order);
  for (Eigen::Index tet = 0; tet < result.elements.rows(); ++tet) {
    for (std::size_t a = 4; a < alphas.size(); ++a) {
      Eigen::RowVector3d x = Eigen::RowVector3d::Zero();
      for (std::size_t b = 0; b < quadratic.size(); ++b) {
        double N = 1.0;  // λ(2λ − 1) at a corner, 4 λ λ' within an edge
        for (std::size_t k = 0; k < 4; ++k) {
          const double lambda = static_cast<double>(alphas[a][k]) / order;
          if (quadratic[b][k] == 2) N *= lambda * (2.0 * lambda - 1.0);
          if (quadratic[b][k] == 1) N *= 2.0 * lambda;
        }
        x += N * nodes.positions.row(nodes.elements(tet, static_cast<Eigen::Index>(b)));
      }
      result.positions.row(result.elements(tet, static_cast<Eigen::Index>(a))) = x;
    }
  }
  return result;
}

std::vector<int> set_of_order(const LagrangeNodes& from, const std::vector<int>& set, const LagrangeNodes& to) {
  const auto lower = lattice(from.order);
  const auto higher = lattice(to.order);
  std::vector<char> in_set(static_cast<std::size_t>(from.positions.rows()), 0);
  for (const int node : set) in_set[static_cast<std::size_t>(node)] = 1;
  std::vector<int> result;
  for (Eigen::Index tet = 0; tet < to.elements.rows(); ++tet) {
    for (std::size_t a = 0; a < higher.size(); ++a) {
      bool all = true;
      for (std::size_t b = 0; b < lower.size() && all; ++b) {
        bool on = true;  // the edge, face or element of the higher node
        for (std::size_t k = 0; k < 4; ++k) on = on && (lower[b][k] == 0 || higher[a][k] > 0);
        all = !on || in_set[static_cast<std::size_t>(from.elements(tet, static_cast<Eigen::Index>(b)))] != 0;
      }
      if (all) result.push_back(to.elements(tet, static_cast<Eigen::Index>(a)));
    }
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

}  // namespace thinwall::mesh
