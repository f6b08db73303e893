#include "identification/assignment.hpp"

#include <limits>
#include <utility>

namespace thinwall::identification {

namespace {

/// With no more rows than columns: one row after the other takes the column at the end of the cheapest alternating
/// path.
std::vector<int> row_of_columns(const Eigen::MatrixXd& cost) {
  const Eigen::Index rows = cost.rows(), columns = cost.cols();
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Eigen::VectorXd row_price = Eigen::VectorXd::Zero(rows), column_price = Eigen::VectorXd::Zero(columns);
  std::vector<int> row_of(static_cast<std::size_t>(columns), -1);
  for (Eigen::Index new_row = 0; new_row < rows; ++new_row) {
    Eigen::VectorXd distance = Eigen::VectorXd::Constant(columns, infinite);
    std::vector<Eigen::Index> from(static_cast<std::size_t>(columns), -1);
    std::vector<bool> reached(static_cast<std::size_t>(columns), false);
    Eigen::Index row = new_row, column = -1;
    double so_far = 0.0;
    for (;;) {
      Eigen::Index nearest = -1;
      for (Eigen::Index j = 0; j < columns; ++j) {
        if (reached[static_cast<std::size_t>(j)]) continue;
        const double through = so_far + cost(row, j) - row_price(row) - column_price(j);
        if (through < distance(j)) {
          distance(j) = through;
          from[static_cast<std::size_t>(j)] = column;
        }
        if (nearest < 0 || distance(j) < distance(nearest)) nearest = j;
      }
      column = nearest;
      reached[static_cast<std::size_t>(column)] = true;
      so_far = distance(column);
      if (row_of[static_cast<std::size_t>(column)] < 0) break;
      row = row_of[static_cast<std::size_t>(column)];
    }
    row_price(new_row) += so_far;
    for (Eigen::Index j = 0; j < columns; ++j) {
      if (!reached[static_cast<std::size_t>(j)] || j == column) continue;
      column_price(j) += distance(j) - so_far;
      row_price(row_of[static_cast<std::size_t>(j)]) += so_far - distance(j);
    }
    while (column >= 0) {
      const Eigen::Index before = from[static_cast<std::size_t>(column)];
      row_of[static_cast<std::size_t>(column)] =
          before < 0 ? static_cast<int>(new_row) : row_of[static_cast<std::size_t>(before)];
      column = before;
    }
  }
  return row_of;
}

}  // namespace

std::vector<int> cheapest_pairing(const Eigen::MatrixXd& cost) {
  if (cost.rows() > cost.cols()) return row_of_columns(cost.transpose());
  std::vector<int> column_of(static_cast<std::size_t>(cost.rows()), -1);
  const std::vector<int> row_of = row_of_columns(cost);
  for (std::size_t j = 0; j < row_of.size(); ++j) {
    if (row_of[j] >= 0) column_of[static_cast<std::size_t>(row_of[j])] = static_cast<int>(j);
  }
  return column_of;
}

}  // namespace thinwall::identification
