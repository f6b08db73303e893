#include "io/matrices/op4.hpp"

#include <algorithm>
#include <cstdlib>

#include "core/error.hpp"
#include "io/matrices/matrix_names.hpp"
#include "io/matrices/op4_source.hpp"

namespace thinwall::io {

namespace {

constexpr std::int64_t most_rows_of_short_strings = 65535;

/// The matrix that a head describes, without entries.
template <class Source>
Op4Matrix described(const Op4Head& head, const Source& source) {
  const std::int64_t rows = std::abs(head.rows);
  const bool sound = head.columns >= 0 && head.columns <= largest_label && head.rows > -largest_label &&
                     rows <= largest_label && head.form >= 0 && head.form <= 15 && head.type >= 1 && head.type <= 4 &&
                     !head.name.empty();
  if (!sound) source.fail("no head of a matrix (columns, rows, form, type from 1 to 4, name): export the file again");
  return {head.name,
          static_cast<int>(head.form),
          static_cast<int>(head.type),
          static_cast<int>(rows),
          static_cast<int>(head.columns),
          {}};
}

bool is_read(const Op4Matrix& matrix) {
  return matrix.type <= 2 && matrix.rows == matrix.columns &&
         (matrix.form == 1 || matrix.form == 2 || matrix.form == 6);
}

/// A reader of the columns of one matrix.
template <class Source>
class ColumnReader {
 public:
  ColumnReader(Source& source, Op4Matrix& matrix, bool large)
      : source_(source), matrix_(matrix), large_(large), words_(matrix.type % 2 == 1 ? 1 : source.words_of_double()) {}

  void read() {
    std::int64_t last = 0;
    for (Op4Column column = source_.column(); column.column <= matrix_.columns; column = source_.column()) {
      if (column.column <= last)
        source_.fail("column " + std::to_string(column.column) + " follows column " + std::to_string(last) +
                     ": columns ascend from 1");
      last = column.column;
      next_row_ = 1;
      if (column.row > 0) take(column.column, column.row, source_.dense_numbers(column.words, words_));
      if (column.row <= 0) read_strings(column);
      source_.end_column();
    }
    source_.end_matrix();
  }

 private:
  void read_strings(const Op4Column& column) {
    for (std::int64_t left = column.words; left > 0;) {
      const Op4String string = source_.string(large_);
      left -= string.words + (large_ ? 2 : 1);
      if (string.words < 1 || left < 0)
        source_.fail("a string of another length than its column: export the file again");
      take(column.column, string.row, string.words / words_);
    }
  }

  /// Reads numbers that stand in rows one below the other.
  void take(std::int64_t column, std::int64_t row, std::int64_t count) {
    source_.numbers(count, values_);
    if (!is_read(matrix_)) return;
    if (row < next_row_ || count > matrix_.rows - row + 1)
      source_.fail("row " + std::to_string(row) + " of column " + std::to_string(column) + " and the " +
                   std::to_string(count - 1) + " below lie before the last ones, or outside of the matrix");
    for (const double value : values_) {
      if (value != 0.0)
        matrix_.entries.push_back({static_cast<int>(row - 1), static_cast<int>(column - 1), value, source_.line()});
      ++row;
    }
    next_row_ = row;
  }

  Source& source_;
  Op4Matrix& matrix_;
  bool large_ = false;
  int words_ = 1;  ///< of a number
  std::int64_t next_row_ = 1;
  std::vector<double> values_;
};

template <class Source>
std::vector<Op4Matrix> all_matrices(Source&& source) {
  std::vector<Op4Matrix> matrices;
  while (const auto head = source.head()) {
    matrices.push_back(described(*head, source));
    const bool large = head->rows < 0 || head->rows > most_rows_of_short_strings;
    ColumnReader(source, matrices.back(), large).read();
  }
  return matrices;
}

}  // namespace

bool is_op4(std::string_view bytes) {
  return Op4Bytes::begins(bytes) || is_op4_text(bytes);
}

std::vector<Op4Matrix> read_op4(std::string_view bytes, const std::string& path) {
  std::vector<Op4Matrix> matrices =
      Op4Bytes::begins(bytes) ? all_matrices(Op4Bytes(bytes, path)) : all_matrices(Op4Text(bytes, path));
  if (matrices.empty()) throw core::DataError(path + ": holds no matrix of OUTPUT4");
  return matrices;
}

MatrixEntries op4_matrix(const std::vector<Op4Matrix>& matrices, const std::string& wanted, char letter,
                         const std::string& path) {
  std::vector<std::string> names;
  for (const Op4Matrix& matrix : matrices) names.push_back(matrix.name);
  const Op4Matrix& matrix = matrices[matrix_by_name(names, wanted, letter, path)];
  if (!is_read(matrix))
    throw core::DataError(path + ": the matrix " + matrix.name + " has " + std::to_string(matrix.rows) + " rows, " +
                          std::to_string(matrix.columns) + " columns, form " + std::to_string(matrix.form) +
                          " and type " + std::to_string(matrix.type) +
                          "; a square one (form 1, 2 or 6) of real numbers (type 1 or 2) belongs here");
  return {path, matrix.rows, matrix.entries, matrix.form == 6};
}

}  // namespace thinwall::io
