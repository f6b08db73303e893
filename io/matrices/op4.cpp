#include "io/matrices/op4.hpp"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "io/matrices/op4_source.hpp"

namespace thinwall::io {

namespace {

constexpr std::int64_t most_rows_of_short_strings = 65535;

/// A reader of the columns of one matrix.
template <class Source>
class ColumnReader {
 public:
  ColumnReader(Source& source, NastranMatrix& matrix, bool large)
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
  NastranMatrix& matrix_;
  bool large_ = false;
  int words_ = 1;  ///< of a number
  std::int64_t next_row_ = 1;
  std::vector<double> values_;
};

template <class Source>
std::vector<NastranMatrix> all_matrices(Source&& source) {
  std::vector<NastranMatrix> matrices;
  while (const auto head = source.head()) {
    std::optional<NastranMatrix> matrix =
        described(head->name, head->columns, std::abs(head->rows), head->form, head->type);
    if (!matrix)
      source.fail("no head of a matrix (columns, rows, form, type from 1 to 4, name): export the file again");
    matrices.push_back(std::move(*matrix));
    const bool large = head->rows < 0 || head->rows > most_rows_of_short_strings;
    ColumnReader(source, matrices.back(), large).read();
  }
  return matrices;
}

}  // namespace

bool is_op4(std::string_view bytes) {
  return Op4Bytes::begins(bytes) || is_op4_text(bytes);
}

std::vector<NastranMatrix> read_op4(std::string_view bytes, const std::string& path) {
  std::vector<NastranMatrix> matrices =
      Op4Bytes::begins(bytes) ? all_matrices(Op4Bytes(bytes, path)) : all_matrices(Op4Text(bytes, path));
  if (matrices.empty()) throw core::DataError(path + ": holds no matrix of OUTPUT4");
  return matrices;
}

}  // namespace thinwall::io
