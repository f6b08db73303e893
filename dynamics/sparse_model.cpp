#include "dynamics/sparse_model.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "core/error.hpp"
#include "core/units.hpp"

namespace thinwall::dynamics {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

[[noreturn]] void fail(const std::string& what) {
  throw core::InputError("imported matrices: " + what);
}

std::string size_text(const Matrix& A) {
  return std::to_string(A.rows()) + " x " + std::to_string(A.cols());
}

std::string row_name(const SparseModel& model, Eigen::Index row) {
  return name(named(model, model.dofs[static_cast<std::size_t>(row)]));
}

/// The text of an entry: "K(node 1.x, node 2.y) = 3.5".
std::string entry_text(const SparseModel& model, const char* letter, Eigen::Index row, Eigen::Index column,
                       double value) {
  return std::string(letter) + "(" + row_name(model, row) + ", " + row_name(model, column) +
         ") = " + core::number_text(value);
}

/// The matrices of the model with their letters; C only if there is one.
std::vector<std::pair<const char*, const Matrix*>> matrices(const SparseModel& model) {
  std::vector<std::pair<const char*, const Matrix*>> all{{"K", &model.K}, {"M", &model.M}};
  if (model.has_damping()) all.emplace_back("C", &model.C);
  return all;
}

void require_sizes(const SparseModel& model) {
  const Eigen::Index n = model.K.rows();
  if (n == 0) fail("K has no row");
  for (const auto& [letter, A] : matrices(model)) {
    if (A->rows() == n && A->cols() == n) continue;
    fail(std::string(letter) + " is " + size_text(*A) + ", K has " + std::to_string(n) +
         " rows: they must be square and of one size, from one export");
  }
  const std::size_t rows = model.dofs.size();
  if (rows == static_cast<std::size_t>(n)) return;
  fail("the DOF table has " + std::to_string(rows) + " rows and K " + std::to_string(n) +
       ": it must name each row once; export it together with the matrices, without DOFs that supports hold");
}

void require_table(const SparseModel& model) {
  const auto dof_of = [&](int row) { return model.dofs[static_cast<std::size_t>(row)]; };
  for (int row = 0; row < std::ssize(model.dofs); ++row) {
    const int component = dof_of(row).component;
    if (component >= 0 && component <= 6) continue;
    fail("row " + std::to_string(row + 1) + " of the DOF table is component " + std::to_string(component) +
         " of node " + std::to_string(dof_of(row).node) + ": 1 to 6 move it, 0 is a mode's amplitude");
  }
  std::vector<int> order(model.dofs.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return dof_of(a) < dof_of(b); });
  const auto twice =
      std::adjacent_find(order.begin(), order.end(), [&](int a, int b) { return dof_of(a) == dof_of(b); });
  if (twice == order.end()) return;
  fail("rows " + std::to_string(*twice + 1) + " and " + std::to_string(*(twice + 1) + 1) +
       " of the DOF table are both " + row_name(model, *twice));
}

void require_points(const SparseModel& model) {
  std::set<std::string> names;
  for (const auto& [node, name] : model.names)
    if (!names.insert(name).second) fail("two nodes are called \"" + name + "\": rename one");
  for (const auto& [node, position] : model.positions)
    if (!position.allFinite()) fail("the position of node " + std::to_string(node) + " is not finite");
}

}  // namespace

std::string point_name(const SparseModel& model, const NodeDof& dof) {
  const auto found = model.names.find(dof.node);
  if (found != model.names.end()) return found->second;
  return (dof.component == 0 ? "mode " : "node ") + std::to_string(dof.node);
}

Dof named(const SparseModel& model, const NodeDof& dof) {
  if (dof.component == 0) return {point_name(model, dof), Eigen::Vector3d::Zero(), DofKind::modal};
  const bool turns = dof.component > 3;
  return {point_name(model, dof), Eigen::Vector3d::Unit((dof.component - 1) % 3),
          turns ? DofKind::rotation : DofKind::translation};
}

DofTable dof_table(const SparseModel& model) {
  DofTable table;
  table.reserve(model.dofs.size());
  for (const NodeDof& dof : model.dofs) table.push_back(named(model, dof));
  return table;
}

void require_consistent(const SparseModel& model) {
  require_sizes(model);
  require_table(model);
  require_points(model);
  for (const auto& [letter, A] : matrices(model)) {
    for (Eigen::Index column = 0; column < A->outerSize(); ++column) {
      for (Matrix::InnerIterator entry(*A, column); entry; ++entry) {
        if (std::isfinite(entry.value())) continue;
        fail(entry_text(model, letter, entry.row(), column, entry.value()) + " is not finite: export it again");
      }
    }
  }
}

Asymmetry asymmetry(const Matrix& A) {
  const Matrix At = A.transpose();
  const Matrix difference = A - At;
  const Eigen::VectorXd diagonal = A.diagonal().cwiseAbs().cwiseSqrt();
  Asymmetry worst;
  for (Eigen::Index column = 0; column < difference.outerSize(); ++column) {
    for (Matrix::InnerIterator entry(difference, column); entry && entry.row() < column; ++entry) {
      if (entry.value() == 0.0) continue;
      const double upper = A.coeff(entry.row(), column), lower = A.coeff(column, entry.row());
      const double size = std::max({std::abs(upper), std::abs(lower), diagonal(entry.row()) * diagonal(column)});
      const double relative = std::abs(entry.value()) / size;
      if (relative > worst.relative)
        worst = {relative, static_cast<int>(entry.row()), static_cast<int>(column), upper, lower};
    }
  }
  return worst;
}

void require_plausible(const SparseModel& model, double bound) {
  require_consistent(model);
  for (const auto& [letter, A] : matrices(model)) {
    const Asymmetry worst = asymmetry(*A);
    if (worst.relative > bound) {
      fail(std::string(letter) +
           " is not symmetric: " + entry_text(model, letter, worst.row, worst.column, worst.upper) + ", but " +
           entry_text(model, letter, worst.column, worst.row, worst.lower) + " (" + core::number_text(worst.relative) +
           " of their size, " + core::number_text(bound) +
           " is allowed): follower forces, friction or rotation make such matrices; export the part without them");
    }
    const Eigen::VectorXd diagonal = A->diagonal();
    Eigen::Index row = 0;
    if (diagonal.minCoeff(&row) >= 0.0) continue;
    fail(entry_text(model, letter, row, row, diagonal(row)) +
         " is negative: the matrix is indefinite, which no part alone has; look for a wrong sign or DOF table");
  }
}

}  // namespace thinwall::dynamics
