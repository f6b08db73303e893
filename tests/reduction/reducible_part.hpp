#pragma once
// Solid parts, held or free, as what every reduction begins with.

#include <utility>

#include "reduction/full_model.hpp"
#include "tests/reduction/solid_part.hpp"

namespace thinwall::reduction {

struct Reducible {
  FullModel full;
  Interface interface;
};

/// A model with an interface; the rigid motions of a free one from its nodes.
inline Reducible reducible(const fem::Model& model, const std::vector<fem::NamedPoint>& points) {
  Reducible part{{model.K, model.M, model.node_of_row, Eigen::MatrixXd(model.K.rows(), 0)},
                 interface_at(model, points)};
  if (model.rigid_motions > 0) part.full.rigid = fem::rigid_body_motions(model.nodes)(model.free_rows, Eigen::all);
  return part;
}

/// A block of less than 600 rows: dense eigen-solutions. Up to three patches.
inline Reducible small_part(bool held, std::size_t points = 3) {
  const fem::Model model = block({0.3, 0.2, 0.06}, {2, 2, 1}, 2, held);
  const std::vector<fem::NamedPoint> all{
      {"P", {0.3, 0.11, 0.03}, 0.03, xyz}, {"Q", {0.1, 0.2, 0.03}, 0.02, xyz}, {"R", {0.2, 0.05, 0.06}, 0.02, xyz}};
  return reducible(model, {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(points)});
}

/// A plate of more than 600 rows: Lanczos.
inline Reducible larger_part(bool held) {
  const fem::Model model = block({0.3, 0.2, 0.03}, {6, 4, 1}, 2, held);
  return reducible(
      model,
      {{"P", {0.3, 0.11, 0.03}, 0.02, xyz}, {"Q", {0.1, 0.2, 0.015}, 0.02, xyz}, {"R", {0.2, 0.05, 0.03}, 0.02, xyz}});
}

/// Every row as an interface DOF.
inline Interface every_row(const FullModel& full) {
  Interface interface;
  const auto n = full.K.rows();
  interface.W.resize(n, n);
  interface.W.setIdentity();
  for (Eigen::Index i = 0; i < n; ++i)
    interface.dofs.push_back({std::to_string(i), Eigen::Vector3d::UnitX(), dynamics::DofKind::translation});
  return interface;
}

}  // namespace thinwall::reduction
