#pragma once
// A tube as beams, the way a finite-element program would export it.

#include <algorithm>
#include <vector>

#include "dynamics/beam_element.hpp"
#include "dynamics/sparse_model.hpp"

namespace thinwall::testing {

using dynamics::NodeDof;
using dynamics::SparseModel;

inline constexpr double length = 0.6;

/// A tube of `length` (m) along x, nodes 1 … elements + 1 with six components each, free; the nodes of `held` are left
/// out.
inline SparseModel tube(int elements, const std::vector<NodeDof>& held = {}) {
  const dynamics::BeamSection section = dynamics::section({0.04, 0.03, 210e9, 0.3, 7850.0});
  const double l = length / elements;
  const Eigen::Index n = 6 * (elements + 1);
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n), M = Eigen::MatrixXd::Zero(n, n);
  for (int e = 0; e < elements; ++e) {
    K.block(6 * e, 6 * e, 12, 12) += dynamics::beam_stiffness(section, l);
    M.block(6 * e, 6 * e, 12, 12) += dynamics::beam_mass(section, l);
  }
  SparseModel model;
  std::vector<int> kept;
  for (int row = 0; row < n; ++row) {
    const NodeDof dof{row / 6 + 1, row % 6 + 1};
    model.positions[dof.node] = {l * (row / 6), 0.1, 0.0};
    if (std::find(held.begin(), held.end(), dof) != held.end()) continue;
    kept.push_back(row);
    model.dofs.push_back(dof);
  }
  model.K = Eigen::MatrixXd(K(kept, kept)).sparseView();
  model.M = Eigen::MatrixXd(M(kept, kept)).sparseView();
  return model;
}

/// All six DOFs of a node.
inline std::vector<NodeDof> six(int node) {
  return {{node, 1}, {node, 2}, {node, 3}, {node, 4}, {node, 5}, {node, 6}};
}

}  // namespace thinwall::testing
