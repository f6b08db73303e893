#include "reduction/trust/imported_model.hpp"

#include <algorithm>
#include <map>

#include "core/error.hpp"
#include "reduction/methods/static_flexibility.hpp"

namespace thinwall::reduction {

std::vector<int> node_of_row(const dynamics::SparseModel& model) {
  std::map<int, int> numbers;
  std::vector<int> nodes;
  for (const dynamics::NodeDof& dof : model.dofs)
    nodes.push_back(numbers.emplace(dof.node, static_cast<int>(numbers.size())).first->second);
  return nodes;
}

FullModel full_model(const dynamics::SparseModel& model) {
  dynamics::require_plausible(model);
  const Eigen::VectorXd mass = model.M.diagonal();
  Eigen::Index row = 0;
  if (mass.minCoeff(&row) <= 0.0) {
    throw core::InputError(
        "imported matrices: " + name(dynamics::named(model, model.dofs[static_cast<std::size_t>(row)])) +
        " has no mass, and reductions need some at every DOF: export a consistent mass matrix, or "
        "without the DOFs that have none");
  }
  FullModel full;
  full.K = model.K;
  full.M = model.M;
  full.node_of_row = node_of_row(model);
  full.rigid = rigid_body_modes(full.K, full.M, full.node_of_row);
  return full;
}

Interface interface_at(const dynamics::SparseModel& model, const std::vector<int>& nodes) {
  Interface interface;
  std::vector<Eigen::Triplet<double>> entries;
  for (const int node : nodes) {
    if (std::any_of(model.dofs.begin(), model.dofs.end(), [&](const auto& dof) { return dof.node == node; })) continue;
    throw core::InputError("imported matrices: node " + std::to_string(node) +
                           " has no DOF, and cannot be an interface: a support holds it, or the table is another's");
  }
  for (int row = 0; row < std::ssize(model.dofs); ++row) {
    const dynamics::NodeDof& dof = model.dofs[static_cast<std::size_t>(row)];
    if (std::find(nodes.begin(), nodes.end(), dof.node) == nodes.end()) continue;
    entries.emplace_back(row, static_cast<int>(interface.dofs.size()), 1.0);
    interface.dofs.push_back(dynamics::named(model, dof));
  }
  interface.W.resize(model.size(), std::ssize(interface.dofs));
  interface.W.setFromTriplets(entries.begin(), entries.end());
  return interface;
}

}  // namespace thinwall::reduction
