#include "dynamics/sparse_spatial.hpp"

#include <charconv>
#include <set>
#include <utility>

#include "core/error.hpp"

namespace thinwall::dynamics {

namespace {

/// The key of a point: whether it is an amplitude, and its name; an amplitude and a node may share a name.
using PointKey = std::pair<bool, std::string>;

PointKey key(const Dof& dof) {
  return {dof.kind == DofKind::modal, dof.point};
}

/// The number in a name such as "node 17" ("mode 17" for an amplitude); 0 for any other name.
int own_number(const PointKey& point) {
  const std::string text = point.first ? "mode " : "node ";
  if (!point.second.starts_with(text)) return 0;
  int number = 0;
  const char* last = point.second.data() + point.second.size();
  const auto [end, error] = std::from_chars(point.second.data() + text.size(), last, number);
  const bool plain = error == std::errc{} && end == last && text + std::to_string(number) == point.second;
  return plain ? number : 0;
}

/// A number for every point: the one in its name if no other point has it, else the next free one.
std::map<PointKey, int> numbers_of(const DofTable& dofs) {
  std::map<PointKey, int> numbers;
  std::set<int> taken;
  for (const bool amplitudes : {false, true}) {
    for (const Dof& dof : dofs) {
      const PointKey point = key(dof);
      const int number = own_number(point);
      if (point.first != amplitudes || number == 0 || numbers.contains(point)) continue;
      if (taken.insert(number).second) numbers.emplace(point, number);
    }
  }
  int next = 1;
  for (const Dof& dof : dofs) {
    if (numbers.contains(key(dof))) continue;
    while (taken.contains(next)) ++next;
    taken.insert(next);
    numbers.emplace(key(dof), next);
  }
  return numbers;
}

int component_of(const Dof& dof) {
  if (dof.kind == DofKind::modal) return 0;
  for (int axis_index = 0; axis_index < 3; ++axis_index)
    if (dof.direction == Eigen::Vector3d::Unit(axis_index)) return axis_index + (dof.kind == DofKind::rotation ? 4 : 1);
  throw core::InputError("the DOF \"" + name(dof) +
                         "\" lies along no axis: files that number nodes and components cannot hold it");
}

}  // namespace

SpatialModel spatial_model(const SparseModel& model, Eigen::Index most) {
  require_consistent(model);
  const Eigen::Index n = model.size();
  if (n > most) {
    throw core::InputError("imported matrices of " + std::to_string(n) + " rows are too large to be used whole (" +
                           std::to_string(most) + " are allowed): reduce them to the points that matter first");
  }
  SpatialModel dense;
  dense.M = Eigen::MatrixXd(model.M);
  dense.K = Eigen::MatrixXd(model.K);
  dense.C = model.has_damping() ? Eigen::MatrixXd(model.C) : Eigen::MatrixXd::Zero(n, n);
  dense.dofs = dof_table(model);
  return dense;
}

SparseModel sparse_model(const SpatialModel& model) {
  require_consistent(model);
  if (model.has_own_coordinates() || model.has_structural_damping()) {
    throw core::InputError(std::string("a model with ") +
                           (model.has_own_coordinates() ? "coordinates that are not its DOFs" : "structural damping") +
                           " cannot be written by nodes and components: write it as MAT");
  }
  SparseModel sparse;
  sparse.M = model.M.sparseView(0.0, 0.0);
  sparse.K = model.K.sparseView(0.0, 0.0);
  if (!model.C.isZero(0.0)) sparse.C = model.C.sparseView(0.0, 0.0);
  const std::map<PointKey, int> numbers = numbers_of(model.dofs);
  for (const Dof& dof : model.dofs) sparse.dofs.push_back({numbers.at(key(dof)), component_of(dof)});
  for (const auto& [point, number] : numbers)
    if (own_number(point) != number) sparse.names.emplace(number, point.second);
  require_consistent(sparse);
  return sparse;
}

}  // namespace thinwall::dynamics
