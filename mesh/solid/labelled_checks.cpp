#include "mesh/solid/labelled_checks.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>
#include <unordered_map>
#include <utility>

#include "mesh/triangle_soup.hpp"

namespace thinwall::mesh {

namespace {

/// Largest number of a node. Degrees of freedom are named by it, and other formats store it as a 32-bit integer.
constexpr std::int64_t most_label = std::numeric_limits<std::int32_t>::max();

/// Largest coordinate of a node, m.
constexpr double farthest_m = 1e6;

std::string in_line(const LabelledMesh& labelled, std::int64_t line) {
  if (line <= 0) return "";
  return labelled.origins.empty() ? ", in line " + std::to_string(line) : ", at " + place_of(labelled, line);
}

void require_cells_once(const LabelledMesh& labelled) {
  std::vector<std::pair<std::int64_t, std::int64_t>> labels;
  labels.reserve(labelled.cells.size());
  for (const LabelledCell& cell : labelled.cells) labels.emplace_back(cell.label, cell.line);
  std::sort(labels.begin(), labels.end());
  for (std::size_t i = 1; i < labels.size(); ++i) {
    if (labels[i].first != labels[i - 1].first) continue;
    fail_at(labelled, labels[i].second,
            "element " + std::to_string(labels[i].first) + " is there already" +
                in_line(labelled, labels[i - 1].second) + ": give every element a number of its own");
  }
}

void require_one_order(const LabelledMesh& labelled) {
  if (labelled.cells.empty())
    fail_at(labelled, 0, "holds no solid element: tetrahedra, hexahedra, wedges or pyramids are wanted");
  const LabelledCell& first = labelled.cells.front();
  for (const LabelledCell& cell : labelled.cells) {
    if (cell_order(cell.shape, cell.nodes) == cell_order(first.shape, first.nodes)) continue;
    fail_at(labelled, cell.line,
            "element " + std::to_string(cell.label) + " has " + std::to_string(cell.nodes) + " nodes and element " +
                std::to_string(first.label) + " has " + std::to_string(first.nodes) +
                ": elements of one order fit together; mesh all with mid-edge nodes, or all without");
  }
}

/// The rows of a cell's corners in ascending order, which identify the cell whatever its orientation.
std::vector<int> sorted_rows(const LabelledCell& cell, const std::vector<int>& rows) {
  const auto begin = rows.begin() + static_cast<std::ptrdiff_t>(cell.first);
  std::vector<int> sorted(begin, begin + static_cast<std::ptrdiff_t>(topology(cell.shape).corners));
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

/// Pairs of cells on the same corners: the one that is kept, and the one that repeats it.
std::vector<std::pair<std::size_t, std::size_t>> repeated_cells(const LabelledMesh& labelled,
                                                                const std::vector<int>& rows) {
  struct Mixed {
    std::uint64_t hash;
    std::size_t cell;
  };
  std::vector<Mixed> all;
  all.reserve(labelled.cells.size());
  for (std::size_t c = 0; c < labelled.cells.size(); ++c) {
    std::uint64_t hash = 0x9E3779B97F4A7C15U;
    for (const int row : sorted_rows(labelled.cells[c], rows)) {
      hash = (hash ^ static_cast<std::uint64_t>(row)) * 0xBF58476D1CE4E5B9U;
      hash ^= hash >> 29U;
    }
    all.push_back({hash, c});
  }
  std::sort(all.begin(), all.end(),
            [](const Mixed& a, const Mixed& b) { return a.hash != b.hash ? a.hash < b.hash : a.cell < b.cell; });
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  std::size_t kept = 0;
  for (std::size_t i = 1; i < all.size(); ++i) {
    const bool same = all[i].hash == all[kept].hash && sorted_rows(labelled.cells[all[i].cell], rows) ==
                                                           sorted_rows(labelled.cells[all[kept].cell], rows);
    if (same) pairs.emplace_back(all[kept].cell, all[i].cell);
    if (!same) kept = i;
  }
  return pairs;
}

/// Drops the repeated cells. In the sets, the cell that is kept takes their place.
void merge_repeated_cells(LabelledMesh& labelled, const std::vector<int>& rows, std::vector<std::string>& notices) {
  const auto pairs = repeated_cells(labelled, rows);
  if (pairs.empty()) return;
  if (!labelled.repeated_cells_are_one) {
    const LabelledCell& first = labelled.cells[pairs.front().first];
    const LabelledCell& second = labelled.cells[pairs.front().second];
    fail_at(labelled, second.line,
            "element " + std::to_string(second.label) + " stands on the same nodes as element " +
                std::to_string(first.label) + in_line(labelled, first.line) + ": remove one of them");
  }
  std::unordered_map<std::int64_t, std::int64_t> kept_label;
  std::vector<bool> drop(labelled.cells.size(), false);
  for (const auto& [kept, repeated] : pairs) {
    kept_label[labelled.cells[repeated].label] = labelled.cells[kept].label;
    drop[repeated] = true;
  }
  std::vector<LabelledCell> cells;
  for (std::size_t c = 0; c < labelled.cells.size(); ++c)
    if (!drop[c]) cells.push_back(labelled.cells[c]);
  labelled.cells = std::move(cells);
  for (LabelledSet& set : labelled.cell_sets)
    for (std::int64_t& label : set.labels)
      if (const auto found = kept_label.find(label); found != kept_label.end()) label = found->second;
  notices.push_back(std::to_string(pairs.size()) +
                    " elements that the file repeats, for several groups, are taken once");
}

/// Turns wedges whose first triangle is oriented outwards, by exchanging nodes, into the orientation of cell_shape.hpp.
void turn_wedges(const LabelledMesh& labelled, std::vector<int>& rows, std::vector<std::string>& notices) {
  constexpr std::array<std::array<std::size_t, 2>, 7> exchanges{
      {{1, 2}, {4, 5}, {6, 8}, {9, 11}, {13, 14}, {15, 17}, {0, 0}}};
  int turned = 0;
  for (const LabelledCell& cell : labelled.cells) {
    if (cell.shape != CellShape::wedge) continue;
    const auto x = [&](std::size_t local) -> const Eigen::Vector3d& {
      return labelled.nodes[static_cast<std::size_t>(rows[cell.first + local])].x;
    };
    const Eigen::Vector3d upwards = x(3) + x(4) + x(5) - x(0) - x(1) - x(2);
    if (!((x(1) - x(0)).cross(x(2) - x(0)).dot(upwards) < 0.0)) continue;
    for (const auto& [a, b] : exchanges)
      if (b < cell.nodes) std::swap(rows[cell.first + a], rows[cell.first + b]);
    ++turned;
  }
  if (turned > 0) notices.push_back(std::to_string(turned) + " wedges whose first triangle looks outwards are turned");
}

}  // namespace

void sort_nodes(LabelledMesh& labelled) {
  const auto by_label = [](const LabelledNode& a, const LabelledNode& b) { return a.label < b.label; };
  if (!std::is_sorted(labelled.nodes.begin(), labelled.nodes.end(), by_label))
    std::stable_sort(labelled.nodes.begin(), labelled.nodes.end(), by_label);
  for (std::size_t i = 0; i < labelled.nodes.size(); ++i) {
    const LabelledNode& node = labelled.nodes[i];
    if (node.label > most_label)
      fail_at(labelled, node.line,
              "the number of node " + std::to_string(node.label) + " is beyond " + std::to_string(most_label) +
                  ": renumber the nodes");
    if (!node.x.allFinite())
      fail_at(labelled, node.line, "node " + std::to_string(node.label) + " has a coordinate that is not finite");
    if (node.x.cwiseAbs().maxCoeff() > farthest_m)
      fail_at(labelled, node.line,
              "node " + std::to_string(node.label) + " lies at " + place_text(node.x) +
                  ", and no part is larger than 1e+09 mm: look for a stray node, and check the unit");
    if (i == 0 || labelled.nodes[i - 1].label != node.label) continue;
    const std::int64_t other = labelled.nodes[i - 1].line;
    fail_at(labelled, std::max(node.line, other),
            "node " + std::to_string(node.label) + " is there already" + in_line(labelled, std::min(node.line, other)) +
                ": give every node a number of its own");
  }
}

int row_of_node(const LabelledMesh& labelled, std::int64_t label, std::int64_t line) {
  const auto& nodes = labelled.nodes;
  std::size_t row = nodes.size();
  if (!nodes.empty() && label >= nodes.front().label && label <= nodes.back().label) {
    row = std::min(nodes.size() - 1, static_cast<std::size_t>(label) - static_cast<std::size_t>(nodes.front().label));
    if (nodes[row].label != label) {
      const auto below = [](const LabelledNode& node, std::int64_t value) { return node.label < value; };
      row = static_cast<std::size_t>(std::lower_bound(nodes.begin(), nodes.end(), label, below) - nodes.begin());
    }
  }
  if (row >= nodes.size() || nodes[row].label != label)
    fail_at(labelled, line, "node " + std::to_string(label) + " is not among the nodes of the file");
  return static_cast<int>(row);
}

std::vector<NodeRole> node_roles(const LabelledMesh& labelled, const std::vector<int>& rows) {
  std::vector<NodeRole> role(labelled.nodes.size(), NodeRole::unused);
  for (const LabelledCell& cell : labelled.cells) {
    const std::size_t corners = topology(cell.shape).corners;
    for (std::size_t a = 0; a < cell.nodes; ++a) {
      NodeRole& known = role[static_cast<std::size_t>(rows[cell.first + a])];
      const NodeRole here = a < corners ? NodeRole::corner : NodeRole::middle;
      if (known != NodeRole::unused && known != here) {
        fail_at(labelled, cell.line,
                "node " + std::to_string(labelled.cell_nodes[cell.first + a]) +
                    " is a corner of one element and within an edge of another: the elements do not fit together");
      }
      known = here;
    }
  }
  return role;
}

std::vector<int> checked_rows(LabelledMesh& labelled, std::vector<std::string>& notices) {
  require_one_order(labelled);
  sort_nodes(labelled);
  require_cells_once(labelled);
  std::vector<int> rows(labelled.cell_nodes.size(), -1);
  for (const LabelledCell& cell : labelled.cells)
    for (std::size_t a = cell.first; a < cell.first + cell.nodes; ++a)
      rows[a] = row_of_node(labelled, labelled.cell_nodes[a], cell.line);
  merge_repeated_cells(labelled, rows, notices);
  if (labelled.wedges_may_be_turned) turn_wedges(labelled, rows, notices);
  return rows;
}

}  // namespace thinwall::mesh
