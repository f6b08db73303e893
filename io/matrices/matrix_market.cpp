#include "io/matrices/matrix_market.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "io/matrices/matrix_entries.hpp"
#include "io/surface_text.hpp"

namespace thinwall::io {

namespace {

constexpr std::string_view banner = "%%matrixmarket";

struct Heading {
  bool coordinate = true;
  bool symmetric = false;
};

Heading read_heading(SurfaceText& text) {
  if (lower_case(text.word_of_line()) != banner) text.fail("does not begin with \"%%MatrixMarket\"");
  std::array<std::string, 4> words;
  for (std::string& word : words) word = lower_case(text.word_of_line());
  const auto& [object, format, field, symmetry] = words;
  if (object != "matrix") text.fail("holds a " + io::quoted(object) + "; a matrix belongs here");
  if (format != "coordinate" && format != "array") text.fail("is in the format " + io::quoted(format) + ", not known");
  if (field != "real" && field != "integer" && field != "double")
    text.fail("holds " + io::quoted(field) + " entries; write a real matrix");
  if (symmetry != "general" && symmetry != "symmetric")
    text.fail("is " + io::quoted(symmetry) + "; K, M and C of a part are general or symmetric");
  text.skip_line();
  return {format == "coordinate", symmetry == "symmetric"};
}

/// The next word that does not belong to a comment.
std::string_view next_word(SurfaceText& text) {
  std::string_view word = text.word();
  while (word.starts_with('%')) {
    text.skip_line();
    word = text.word();
  }
  return word;
}

void read_coordinates(SurfaceText& text, bool symmetric, MatrixEntries& matrix) {
  const std::int64_t count =
      text.whole_number(next_word(text), "the number of entries", 0, std::numeric_limits<std::int64_t>::max());
  while (!text.at_end()) {
    const auto row = static_cast<int>(text.whole_number("a row", 1, matrix.size) - 1);
    const auto column = static_cast<int>(text.whole_number("a column", 1, matrix.size) - 1);
    if (symmetric && row < column)
      text.fail("an entry above the diagonal of a symmetric file, which holds those below");
    matrix.entries.push_back({row, column, text.number("an entry"), text.line()});
  }
  if (std::ssize(matrix.entries) == count) return;
  text.fail("states " + std::to_string(count) + " entries and holds " + std::to_string(matrix.entries.size()) +
            ": it is truncated, or was edited");
}

void read_array(SurfaceText& text, bool symmetric, MatrixEntries& matrix) {
  for (int column = 0; column < matrix.size; ++column)
    for (int row = symmetric ? column : 0; row < matrix.size; ++row)
      matrix.entries.push_back({row, column, text.number("an entry"), text.line()});
  if (!text.at_end()) text.fail("something follows the last entry");
}

}  // namespace

bool is_matrix_market(std::string_view bytes) {
  return lower_case(bytes.substr(0, banner.size())) == banner;
}

MatrixEntries matrix_market_entries(std::string_view bytes, const std::string& name) {
  SurfaceText text(bytes, name, '\0');
  const Heading heading = read_heading(text);
  const std::int64_t rows = text.whole_number(next_word(text), "the number of rows", 1, largest_label);
  const std::int64_t columns = text.whole_number(next_word(text), "the number of columns", 1, largest_label);
  if (rows != columns)
    text.fail("is " + std::to_string(rows) + " x " + std::to_string(columns) + "; K, M and C are square");
  MatrixEntries matrix{name, static_cast<int>(rows), {}, heading.symmetric};
  if (heading.coordinate) {
    read_coordinates(text, heading.symmetric, matrix);
  } else {
    read_array(text, heading.symmetric, matrix);
  }
  return matrix;
}

void write_matrix_market(const std::filesystem::path& path, const Eigen::SparseMatrix<double>& A) {
  const bool symmetric = dynamics::asymmetry(A).relative == 0.0;
  std::string entries;
  Eigen::Index count = 0;
  for (Eigen::Index column = 0; column < A.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(A, column); entry; ++entry) {
      if (!std::isfinite(entry.value()))
        throw core::NumericalError(path.string() + ": the entry of row " + std::to_string(entry.row() + 1) +
                                   " and column " + std::to_string(column + 1) + " is not finite");
      if (symmetric && entry.row() < column) continue;
      ++count;
      entries += std::to_string(entry.row() + 1) + ' ' + std::to_string(column + 1) + ' ' +
                 core::number_text(entry.value()) + '\n';
    }
  }
  core::write_file_atomically(path, std::string("%%MatrixMarket matrix coordinate real ") +
                                        (symmetric ? "symmetric" : "general") + "\n" + std::to_string(A.rows()) + ' ' +
                                        std::to_string(A.cols()) + ' ' + std::to_string(count) + '\n' + entries);
}

}  // namespace thinwall::io
