#include "io/matrices/nastran_matrix.hpp"

#include "core/error.hpp"
#include "io/matrices/matrix_names.hpp"

namespace thinwall::io {

std::optional<NastranMatrix> described(const std::string& name, std::int64_t columns, std::int64_t rows,
                                       std::int64_t form, std::int64_t type) {
  const bool sound = columns >= 0 && columns <= largest_label && rows >= 0 && rows <= largest_label && form >= 0 &&
                     form <= 15 && type >= 1 && type <= 4 && !name.empty();
  if (!sound) return std::nullopt;
  return NastranMatrix{
      name, static_cast<int>(form), static_cast<int>(type), static_cast<int>(rows), static_cast<int>(columns), {}};
}

bool is_read(const NastranMatrix& matrix) {
  return matrix.type <= 2 && matrix.rows == matrix.columns &&
         (matrix.form == 1 || matrix.form == 2 || matrix.form == 6);
}

MatrixEntries nastran_matrix(const std::vector<NastranMatrix>& matrices, const std::string& wanted, char letter,
                             const std::string& path) {
  std::vector<std::string> names;
  for (const NastranMatrix& matrix : matrices) names.push_back(matrix.name);
  const NastranMatrix& matrix = matrices[matrix_by_name(names, wanted, letter, path)];
  if (!is_read(matrix))
    throw core::DataError(path + ": the matrix " + matrix.name + " has " + std::to_string(matrix.rows) + " rows, " +
                          std::to_string(matrix.columns) + " columns, form " + std::to_string(matrix.form) +
                          " and type " + std::to_string(matrix.type) +
                          "; a square one (form 1, 2 or 6) of real numbers (type 1 or 2) belongs here");
  return {path, matrix.rows, matrix.entries, matrix.form == 6};
}

}  // namespace thinwall::io
