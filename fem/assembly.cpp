#include "fem/assembly.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/memory.hpp"
#include "core/parallel.hpp"
#include "fem/curved_element.hpp"
#include "fem/node_graph.hpp"
#include "fem/reference_element.hpp"

namespace thinwall::fem {

namespace {

using linalg::SparseMatrix;
using ElementNodes = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// The gradients of λ₁, λ₂, λ₃ as columns and the volume of a straight element; a curved element has neither.
struct Geometry {
  Eigen::Matrix3d gradients;
  double volume = 0.0;
  bool curved = false;
};

ElementNodes positions_of(const mesh::LagrangeNodes& nodes, Eigen::Index element) {
  ElementNodes x(nodes.elements.cols(), 3);
  for (Eigen::Index a = 0; a < x.rows(); ++a) x.row(a) = nodes.positions.row(nodes.elements(element, a));
  return x;
}

/// The geometry of an element, which is straight if every node lies on the lattice between its vertices to the
/// round-off of the positions.
Geometry geometry(const mesh::LagrangeNodes& nodes, const Eigen::Matrix<double, Eigen::Dynamic, 4>& lattice,
                  Eigen::Index element) {
  const ElementNodes x = positions_of(nodes, element);
  if (!x.allFinite()) {
    throw core::NumericalError("tetrahedron " + std::to_string(element) +
                               " has a node whose position is not a number: look at what moved the nodes");
  }
  const Eigen::Matrix<double, 4, 3> vertices = x.topRows<4>();
  const double size = (vertices.rowwise() - vertices.row(0)).cwiseAbs().maxCoeff();
  const double far = vertices.cwiseAbs().maxCoeff();
  Geometry g;
  g.curved = (x - lattice * vertices).cwiseAbs().maxCoeff() > 1e-10 * size + 1e-14 * far;
  const Eigen::Matrix3d edges = (vertices.bottomRows<3>().rowwise() - vertices.row(0)).transpose();
  g.volume = edges.determinant() / 6.0;
  if (!g.curved && !(g.volume > 0.0))
    throw core::NumericalError("tetrahedron " + std::to_string(element) + " has no positive volume");
  if (!g.curved) g.gradients = edges.inverse().transpose();
  return g;
}

/// The geometry of every element, in parallel.
std::vector<Geometry> geometries(const mesh::LagrangeNodes& nodes) {
  const auto alphas = mesh::lattice(nodes.order);
  Eigen::Matrix<double, Eigen::Dynamic, 4> lattice(static_cast<Eigen::Index>(alphas.size()), 4);
  for (std::size_t a = 0; a < alphas.size(); ++a) {
    for (std::size_t k = 0; k < 4; ++k)
      lattice(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(k)) = double(alphas[a][k]) / nodes.order;
  }
  std::vector<Geometry> all(static_cast<std::size_t>(nodes.elements.rows()));
  constexpr std::size_t piece = 4096;
  core::parallel_for((all.size() + piece - 1) / piece, [&](std::size_t p) {
    for (std::size_t e = p * piece; e < std::min(all.size(), (p + 1) * piece); ++e)
      all[e] = geometry(nodes, lattice, static_cast<Eigen::Index>(e));
  });
  return all;
}

/// Nine numbers padded to three vector registers of four.
using Packed = Eigen::Matrix<double, 12, 1>;

/// The matrix that maps D̂_ab to K_ab = Σ_kl D̂^{kl}_ab T_kl; entry (i, j) of K_ab stands in row 3j + i.
Eigen::Matrix<double, 12, 9> stiffness_map(const Geometry& g, const Lame& c) {
  Eigen::Matrix<double, 12, 9> T = Eigen::Matrix<double, 12, 9>::Zero();
  const Eigen::Matrix3d inner = g.volume * c.mu * g.gradients.transpose() * g.gradients;
  const Eigen::Matrix3d lambda = g.volume * c.lambda * g.gradients;
  const Eigen::Matrix3d mu = g.volume * c.mu * g.gradients;
  for (int k = 0; k < 3; ++k) {
    for (int l = 0; l < 3; ++l) {
      for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i)
          T(3 * j + i, 3 * k + l) = lambda(i, k) * g.gradients(j, l) + mu(j, k) * g.gradients(i, l);
        T(4 * j, 3 * k + l) += inner(k, l);
      }
    }
  }
  return T;
}

/// The numbering of the free DOFs.
struct Numbering {
  std::vector<int> free_rows;
  std::vector<int> row_of;  // row of the DOF 3·node + axis; −1 if it is fixed

  Numbering(Eigen::Index nodes, const std::vector<int>& fixed) : row_of(3 * static_cast<std::size_t>(nodes), 0) {
    for (const int row : fixed) row_of[static_cast<std::size_t>(row)] = -1;
    for (std::size_t dof = 0; dof < row_of.size(); ++dof) {
      if (row_of[dof] < 0) continue;
      row_of[dof] = static_cast<int>(free_rows.size());
      free_rows.push_back(static_cast<int>(dof));
    }
    if (free_rows.empty()) throw core::InputError("the supports hold every node of the part: nothing can move");
  }
  [[nodiscard]] const int* of_node(int node) const { return row_of.data() + 3 * static_cast<std::size_t>(node); }
};

/// Allocates `count` entries, on large pages.
void resize_entries(SparseMatrix& A, Eigen::Index count) {
  A.resizeNonZeros(count);
  core::want_large_pages(A.valuePtr(), sizeof(double) * static_cast<std::size_t>(count));
  core::want_large_pages(A.innerIndexPtr(), sizeof(int) * static_cast<std::size_t>(count));
}

/// Prepares the matrices for every pair of neighbouring nodes: full 3 × 3 blocks in K, the diagonals of such blocks in
/// M.
void reserve(const Lists& graph, const Numbering& rows, Assembled& result) {
  const int nodes = static_cast<int>(graph.start.size()) - 1;
  const auto free = static_cast<Eigen::Index>(rows.free_rows.size());
  if (9 * graph.start.back() > std::numeric_limits<int>::max()) {
    throw core::NumericalError("the stiffness matrix would have " + std::to_string(9 * graph.start.back()) +
                               " entries, more than 32-bit indices hold: use larger elements or a lower order");
  }
  // K has blocks of nine entries, M of three, the mass of nodes one; an entry is a number and an index.
  core::require_memory(12.0 * 13.0 * static_cast<double>(graph.start.back()),
                       "the stiffness matrix of " + std::to_string(free) + " degrees of freedom");
  result.K.resize(free, free);
  result.M.resize(free, free);
  result.node_mass.resize(nodes, nodes);
  int* k_column = result.K.outerIndexPtr();
  int* m_column = result.M.outerIndexPtr();
  int k_filled = 0;
  int m_filled = 0;
  int column = 0;
  for (int node = 0; node < nodes; ++node) {
    result.node_mass.outerIndexPtr()[node] = static_cast<int>(graph.start[static_cast<std::size_t>(node)]);
    std::array<int, 3> free_axis{};
    for (const int* other = graph.begin(node); other != graph.end(node); ++other) {
      for (std::size_t axis = 0; axis < 3; ++axis) free_axis[axis] += rows.of_node(*other)[axis] >= 0 ? 1 : 0;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (rows.of_node(node)[axis] < 0) continue;
      k_column[column] = k_filled;
      m_column[column++] = m_filled;
      k_filled += free_axis[0] + free_axis[1] + free_axis[2];
      m_filled += free_axis[axis];
    }
  }
  k_column[column] = k_filled;
  m_column[column] = m_filled;
  result.node_mass.outerIndexPtr()[nodes] = static_cast<int>(graph.start.back());
  resize_entries(result.K, k_filled);
  resize_entries(result.M, m_filled);
  resize_entries(result.node_mass, graph.start.back());
}

/// The columns of one node before constraints: for each neighbour, entry (i, j) of the block of K in row 3j + i, and
/// the entry of M.
struct NodeColumns {
  Eigen::Matrix<double, 12, Eigen::Dynamic> K;
  Eigen::VectorXd M;
};

/// Copies the free rows of a node's columns to their places.
void store(const Lists& graph, const Numbering& rows, int node, const NodeColumns& columns, Assembled& result) {
  const int* others = graph.begin(node);
  const std::ptrdiff_t degree = graph.length(node);
  std::copy_n(others, degree, result.node_mass.innerIndexPtr() + graph.start[static_cast<std::size_t>(node)]);
  std::copy_n(columns.M.data(), degree, result.node_mass.valuePtr() + graph.start[static_cast<std::size_t>(node)]);
  for (int j = 0; j < 3; ++j) {
    const int column = rows.of_node(node)[j];
    if (column < 0) continue;
    std::ptrdiff_t k_at = result.K.outerIndexPtr()[column];
    std::ptrdiff_t m_at = result.M.outerIndexPtr()[column];
    for (std::ptrdiff_t k = 0; k < degree; ++k) {
      for (int i = 0; i < 3; ++i) {
        const int row = rows.of_node(others[k])[i];
        if (row < 0) continue;
        result.K.innerIndexPtr()[k_at] = row;
        result.K.valuePtr()[k_at++] = columns.K(3 * j + i, k);
        if (i != j) continue;
        result.M.innerIndexPtr()[m_at] = row;
        result.M.valuePtr()[m_at++] = columns.M(k);
      }
    }
  }
}

/// Lamé's constants and density of an element.
struct Constants {
  Lame lame;
  double density_kg_m3 = 0.0;
};

/// The constants of each tetrahedron; a part of one material has a single entry.
struct ElementConstants {
  std::vector<Constants> list;
  const std::vector<int>* of_tet;

  explicit ElementConstants(const Materials& materials) : of_tet(&materials.of_tet) {
    for (const Material& m : materials.list) list.push_back({lame(m), m.density_kg_m3});
  }
  [[nodiscard]] const Constants& of(Eigen::Index tet) const {
    return of_tet->empty() ? list.front() : list[static_cast<std::size_t>((*of_tet)[static_cast<std::size_t>(tet)])];
  }
};

/// Assembles the columns of the nodes first … last − 1 from the straight elements around them. Columns are computed one
/// by one instead of scattering whole element matrices, so that no two threads write to the same place and sums are
/// made in a fixed order.
void assemble_nodes(const mesh::LagrangeNodes& nodes, const ElementConstants& constants,
                    const std::vector<Geometry>& geometry, const Lists& places, const Lists& graph,
                    const Numbering& rows, int first, int last, Assembled& result) {
  const ReferenceElement& reference = reference_element(nodes.order);
  const Eigen::Index n = reference.nodes;
  std::vector<int> place_of(static_cast<std::size_t>(nodes.positions.rows()), 0);
  NodeColumns columns;
  for (int node = first; node < last; ++node) {
    const std::ptrdiff_t degree = graph.length(node);
    for (std::ptrdiff_t k = 0; k < degree; ++k)
      place_of[static_cast<std::size_t>(graph.begin(node)[k])] = static_cast<int>(k);
    columns.K.setZero(12, degree);
    columns.M.setZero(degree);
    for (const int* place = places.begin(node); place != places.end(node); ++place) {
      const Eigen::Index e = *place / n;
      const Eigen::Index b = *place % n;
      const Geometry& g = geometry[static_cast<std::size_t>(e)];
      if (g.curved) continue;
      const Constants& c = constants.of(e);
      const Eigen::Matrix<double, 12, 9> T = stiffness_map(g, c.lame);
      const double mass = c.density_kg_m3 * g.volume;
      const int* element = nodes.elements.data() + e * n;
      for (Eigen::Index a = 0; a < n; ++a) {
        const auto at = place_of[static_cast<std::size_t>(element[a])];
        const double* d = reference.stiffness.data() + 9 * (a + n * b);
        Packed sum = columns.K.col(at);
        for (int kl = 0; kl < 9; ++kl) sum += d[kl] * T.col(kl);
        columns.K.col(at) = sum;
        columns.M(at) += mass * reference.mass(a, b);
      }
    }
    store(graph, rows, node, columns, result);
  }
}

/// The places of the entries of one node's columns in the sparse matrices.
struct ColumnPlaces {
  std::vector<std::ptrdiff_t> neighbour;             // for each node its place among the neighbours
  std::vector<std::ptrdiff_t> free_before;           // for each neighbour the number of free rows of those before it
  std::array<std::vector<std::ptrdiff_t>, 3> along;  // likewise, rows of each axis alone

  explicit ColumnPlaces(Eigen::Index nodes) : neighbour(static_cast<std::size_t>(nodes)) {}

  void locate(const Lists& graph, const Numbering& rows, int node) {
    free_before.assign(1, 0);
    for (auto& axis : along) axis.assign(1, 0);
    for (const int* other = graph.begin(node); other != graph.end(node); ++other) {
      neighbour[static_cast<std::size_t>(*other)] = other - graph.begin(node);
      std::ptrdiff_t free = free_before.back();
      for (std::size_t i = 0; i < 3; ++i) {
        const int is_free = rows.of_node(*other)[i] >= 0 ? 1 : 0;
        along[i].push_back(along[i].back() + is_free);
        free += is_free;
      }
      free_before.push_back(free);
    }
  }
};

/// Adds the columns of the element's local node b, whose places are `places`, to the matrices.
void add_columns(const mesh::LagrangeNodes& nodes, const Lists& graph, const Numbering& rows,
                 const ColumnPlaces& places, Eigen::Index e, Eigen::Index b, const CurvedElement& element,
                 Assembled& result) {
  const int node = nodes.elements(e, b);
  for (Eigen::Index a = 0; a < nodes.elements.cols(); ++a) {
    const int row_node = nodes.elements(e, a);
    const auto k = static_cast<std::size_t>(places.neighbour[static_cast<std::size_t>(row_node)]);
    result.node_mass.valuePtr()[graph.start[static_cast<std::size_t>(node)] + static_cast<std::ptrdiff_t>(k)] +=
        element.M(a, b);
    for (std::size_t j = 0; j < 3; ++j) {
      const int column = rows.of_node(node)[j];
      if (column < 0) continue;
      double* stiffness = result.K.valuePtr() + result.K.outerIndexPtr()[column] + places.free_before[k];
      for (std::size_t i = 0; i < 3; ++i) {
        if (rows.of_node(row_node)[i] < 0) continue;
        *stiffness++ += element.K(3 * a + static_cast<Eigen::Index>(i), 3 * b + static_cast<Eigen::Index>(j));
        if (i == j) result.M.valuePtr()[result.M.outerIndexPtr()[column] + places.along[j][k]] += element.M(a, b);
      }
    }
  }
}

/// The columns of one node of a curved element of a batch.
struct CurvedColumn {
  int node = 0;
  std::size_t element = 0;  // index in the batch
  Eigen::Index local = 0;
};

/// Adds a batch of curved elements to the matrices. The columns of a node are added by one thread, from its elements in
/// their order, so that results do not depend on the number of threads. `work` has one scratch object for each piece of
/// the columns.
void add_batch(const mesh::LagrangeNodes& nodes, const Lists& graph, const Numbering& rows,
               const std::vector<Eigen::Index>& elements, const std::vector<CurvedElement>& batch,
               std::vector<ColumnPlaces>& work, Assembled& result) {
  std::vector<CurvedColumn> columns;
  for (std::size_t k = 0; k < elements.size(); ++k) {
    for (Eigen::Index b = 0; b < nodes.elements.cols(); ++b) columns.push_back({nodes.elements(elements[k], b), k, b});
  }
  std::stable_sort(columns.begin(), columns.end(),
                   [](const CurvedColumn& a, const CurvedColumn& b) { return a.node < b.node; });
  const auto start_of = [&](std::size_t piece) {
    std::size_t at = piece * columns.size() / work.size();
    while (at > 0 && at < columns.size() && columns[at].node == columns[at - 1].node) ++at;
    return at;
  };
  core::parallel_for(work.size(), [&](std::size_t piece) {
    ColumnPlaces& places = work[piece];
    const std::size_t end = start_of(piece + 1);
    int located = -1;
    for (std::size_t c = start_of(piece); c < end; ++c) {
      const CurvedColumn& column = columns[c];
      if (column.node != located) places.locate(graph, rows, column.node);
      located = column.node;
      add_columns(nodes, graph, rows, places, elements[column.element], column.local, batch[column.element], result);
    }
  });
}

/// Integrates and adds the curved elements. They are integrated in parallel, a batch at a time, because their dense
/// matrices are too large to keep all of them.
void assemble_curved(const mesh::LagrangeNodes& nodes, const ElementConstants& constants,
                     const std::vector<Geometry>& geometry, const Lists& graph, const Numbering& rows,
                     Assembled& result) {
  std::vector<Eigen::Index> curved;
  for (std::size_t e = 0; e < geometry.size(); ++e) {
    if (geometry[e].curved) curved.push_back(static_cast<Eigen::Index>(e));
  }
  result.curved_elements = static_cast<int>(curved.size());
  const CurvedReference& reference = curved_reference(nodes.order);
  constexpr std::size_t at_once = 128;
  std::vector<ColumnPlaces> work(curved.empty() ? 0 : 8, ColumnPlaces(nodes.positions.rows()));
  for (std::size_t first = 0; first < curved.size(); first += at_once) {
    const std::vector<Eigen::Index> elements(
        curved.begin() + static_cast<std::ptrdiff_t>(first),
        curved.begin() + static_cast<std::ptrdiff_t>(std::min(first + at_once, curved.size())));
    std::vector<CurvedElement> batch(elements.size());
    core::parallel_for(elements.size(), [&](std::size_t k) {
      const Constants& c = constants.of(elements[k]);
      batch[k] = curved_element(reference, positions_of(nodes, elements[k]), c.lame, c.density_kg_m3);
    });
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const double jacobian = batch[k].least_jacobian;
      if (!(jacobian > 0.0)) {
        throw core::NumericalError("curved tetrahedron " + std::to_string(elements[k]) +
                                   " is turned inside out (det J falls to " + std::to_string(jacobian) +
                                   " of its mean): use smaller elements or fewer layers along the curve");
      }
      result.least_jacobian = std::min(result.least_jacobian, jacobian);
    }
    add_batch(nodes, graph, rows, elements, batch, work, result);
  }
}

}  // namespace

Assembled assemble(const mesh::LagrangeNodes& nodes, const Material& material, const std::vector<int>& fixed) {
  return assemble(nodes, Materials{{material}, {}}, fixed);
}

Assembled assemble(const mesh::LagrangeNodes& nodes, const Materials& materials, const std::vector<int>& fixed) {
  validate(materials, static_cast<std::size_t>(nodes.elements.rows()));
  const ElementConstants constants(materials);
  Numbering rows(nodes.positions.rows(), fixed);
  const std::vector<Geometry> geometry = geometries(nodes);
  const Lists places = incidences(nodes);
  const Lists graph = neighbours(nodes, places);
  Assembled result;
  reserve(graph, rows, result);
  const auto count = static_cast<std::size_t>(nodes.positions.rows());
  constexpr std::size_t pieces = 32;
  core::parallel_for(pieces, [&](std::size_t p) {
    assemble_nodes(nodes, constants, geometry, places, graph, rows, static_cast<int>(p * count / pieces),
                   static_cast<int>((p + 1) * count / pieces), result);
  });
  assemble_curved(nodes, constants, geometry, graph, rows, result);
  result.free_rows = std::move(rows.free_rows);
  return result;
}

}  // namespace thinwall::fem
