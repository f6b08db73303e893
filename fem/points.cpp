#include "fem/points.hpp"

#include <sstream>

#include "core/error.hpp"
#include "fem/patch.hpp"

namespace thinwall::fem {

namespace {

[[noreturn]] void cannot_move(const NamedPoint& point, const std::string& how, const Eigen::Vector3d& direction) {
  std::ostringstream text;
  text << "point \"" << point.name << "\" cannot " << how << " (" << direction.transpose()
       << "): it lies on a support; move the point or leave the direction out";
  throw core::InputError(text.str());
}

/// Adds the functional d · [u_c θ] of the patch's motion as a column, with d a vector of six. Returns the sum of the
/// magnitudes of its entries, which is zero if supports hold all nodes.
double add_column(const Model& model, const RowMap& rows, const PatchAverage& average, const Eigen::Matrix3d& J_inverse,
                  const Eigen::Matrix<double, 6, 1>& d, int column, std::vector<Eigen::Triplet<double>>& entries) {
  const std::size_t before = entries.size();
  for (std::size_t a = 0; a < average.nodes.size(); ++a) {
    Eigen::Vector3d w = motion_of_node(average, static_cast<Eigen::Index>(a), J_inverse).transpose() * d;
    // A component that is round-off is set to zero, and add_entries() then leaves it out.
    w = (w.array().abs() < 1e-15).select(0.0, w);
    add_entries(rows, model.nodes, model.rigid, average.nodes[a], w, column, entries);
  }
  double movable = 0.0;
  for (std::size_t i = before; i < entries.size(); ++i) movable += std::abs(entries[i].value());
  return movable;
}

}  // namespace

mesh::Disc disc_of(const NamedPoint& point) {
  return {point.position_m, point.patch_radius_m, point.off_m, point.facing.empty() ? point.directions : point.facing};
}

linalg::SparseMatrix point_columns(const Model& model, const NamedPoint& point) {
  const Patch patch = point.faces ? Patch(*point.faces) : Patch(disc_of(point));
  const PatchAverage average = patch_average(model.mesh, model.nodes, patch, point.name);
  const Eigen::Matrix3d J_inverse = point.turns.empty() ? Eigen::Matrix3d::Zero() : inverse_spread(average, point.name);
  const RowMap rows = row_map(model.nodes.positions.rows(), model.free_rows, model.rigid);
  std::vector<Eigen::Triplet<double>> entries;
  int column = 0;
  Eigen::Matrix<double, 6, 1> d;
  for (const Eigen::Vector3d& direction : point.directions) {
    d << direction, Eigen::Vector3d::Zero();
    if (add_column(model, rows, average, J_inverse, d, column++, entries) < 1e-9)
      cannot_move(point, "move in direction", direction);
  }
  for (const Eigen::Vector3d& axis : point.turns) {
    d << Eigen::Vector3d::Zero(), axis;
    if (add_column(model, rows, average, J_inverse, d, column++, entries) < 1e-9)
      cannot_move(point, "turn about", axis);
  }
  linalg::SparseMatrix W(model.K.rows(), column);
  W.setFromTriplets(entries.begin(), entries.end());
  return W;
}

}  // namespace thinwall::fem
