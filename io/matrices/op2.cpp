#include "io/matrices/op2.hpp"

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "io/matrices/fortran_records.hpp"
#include "io/mesh/inp_text.hpp"

namespace thinwall::io {

namespace {

/// The bytes of a word and their order, from the first key: 3 before the date of a label, or 2 before a name.
struct Words {
  bool big_endian = false;
  bool wide = false;
};

std::optional<Words> words_of(std::string_view bytes) {
  for (const bool big_endian : {false, true}) {
    for (const std::int32_t word : {4, 8}) {
      if (!is_record(bytes, 0, word, big_endian)) continue;
      FortranRecords records(bytes, "", big_endian, word == 8);
      records.open();
      const std::int64_t key = records.whole();
      const std::size_t next = 8 + static_cast<std::size_t>(word);
      if ((key == 2 || key == 3) && is_record(bytes, next, static_cast<std::int32_t>(key) * word, big_endian))
        return Words{big_endian, word == 8};
    }
  }
  return std::nullopt;
}

class Op2Reader {
 public:
  Op2Reader(std::string_view bytes, const std::string& path, Words words)
      : records_(bytes, path, words.big_endian, words.wide) {}

  /// All matrices of the file; `tables` receives the names of its other data blocks.
  std::vector<NastranMatrix> matrices(std::vector<std::string>& tables) {
    std::vector<NastranMatrix> all;
    std::int64_t first = key();
    if (first == 3) {
      skip_label();
      first = records_.at_end() ? 0 : key();
    }
    // A zero in place of a name ends the file.
    for (; first != 0; first = records_.at_end() ? 0 : key()) {
      if (first != 2) records_.fail("no data block begins here: export the file again");
      if (std::optional<NastranMatrix> matrix = data_block(tables)) all.push_back(std::move(*matrix));
    }
    return all;
  }

 private:
  /// A record of one word.
  std::int64_t key() {
    records_.open();
    if (records_.left() != records_.word()) records_.fail("a record of data stands in place of a key: export it again");
    const std::int64_t value = records_.whole();
    records_.close();
    return value;
  }

  void expect(std::initializer_list<std::int64_t> keys) {
    for (const std::int64_t wanted : keys)
      if (key() != wanted) records_.fail("the key " + std::to_string(wanted) + " is missing: export the file again");
  }

  void skip_record() {
    records_.open();
    records_.close();
  }

  /// Passes over records until a key at or below zero, which is returned; `words` is the key of the first.
  std::int64_t skip_records(std::int64_t words) {
    for (; words > 0; words = key()) skip_record();
    return words;
  }

  void skip_label() {
    skip_record();  // the date
    if (skip_records(key()) != -1) records_.fail("the label does not end with −1: export the file again");
    expect({0});
  }

  /// Words of 8 bytes hold four characters each, and four blanks.
  std::string name() {
    records_.open();
    std::string text;
    while (records_.left() >= records_.word()) text += records_.text(records_.word()).substr(0, 4);
    records_.close();
    std::erase_if(text, [](char c) { return c <= ' ' || c > '~'; });
    return capitals(text);
  }

  /// The matrix that a trailer describes; nothing if it is that of a table.
  std::optional<NastranMatrix> trailer(const std::string& name) {
    if (key() < 5) records_.fail("a trailer has fewer than five words: export the file again");
    records_.open();
    std::int64_t number = 0, columns = 0, rows = 0, form = 0, type = 0;
    for (std::int64_t* word : {&number, &columns, &rows, &form, &type}) *word = records_.whole();
    records_.close();
    return described(name, columns, rows, form, type);
  }

  std::optional<NastranMatrix> data_block(std::vector<std::string>& tables) {
    const std::string its_name = name();
    expect({-1});
    std::optional<NastranMatrix> matrix = trailer(its_name);
    expect({-2, 1, 0});
    std::int64_t group = skip_records(key());  // the header
    bool has_columns = false;
    for (int column = 1;; ++column) {
      if (group >= 0) records_.fail("a data block ends within a group: export the file again");
      expect({1});
      const std::int64_t kind = key();
      const std::int64_t words = key();
      if (kind == 0 && words == 0) break;
      if (kind != 0 && !matrix) records_.fail("columns follow the trailer of a table: export the file again");
      has_columns = has_columns || kind != 0;
      group = kind == 0 ? skip_records(words) : read_column(column, words, *matrix);
    }
    // A matrix without an entry has no column either, and its trailer says so by its rows and columns alone.
    if (has_columns) return matrix;
    tables.push_back(its_name);
    return std::nullopt;
  }

  /// Reads the strings of a column; `words` is the key of the first. Returns the key that ends them.
  std::int64_t read_column(int column, std::int64_t words, NastranMatrix& matrix) {
    if (column > matrix.columns)
      records_.fail("more columns follow than the " + std::to_string(matrix.columns) + " of the matrix " + matrix.name);
    std::int64_t next_row = 1;
    for (; words > 0; words = key()) {
      records_.open();
      if (is_read(matrix)) next_row = read_string(column, next_row, matrix);
      records_.close();
    }
    return words;
  }

  /// Returns the row below the string.
  std::int64_t read_string(int column, std::int64_t next_row, NastranMatrix& matrix) {
    std::int64_t row = records_.whole();
    const bool single = matrix.type == 1 && records_.word() == 4;
    const auto count = static_cast<std::int64_t>(records_.left() / (single ? 4 : 8));
    if (row < next_row || count > matrix.rows - row + 1)
      records_.fail("row " + std::to_string(row) + " of column " + std::to_string(column) + " and the " +
                    std::to_string(count - 1) + " below lie before the last ones, or outside of the matrix");
    records_.numbers(count, single, values_);
    if (records_.left() != 0) records_.fail("a string is no whole number of entries: export the file again");
    for (const double value : values_) {
      if (value != 0.0) matrix.entries.push_back({static_cast<int>(row - 1), column - 1, value, 0});
      ++row;
    }
    return row;
  }

  FortranRecords records_;
  std::vector<double> values_;
};

}  // namespace

bool is_op2(std::string_view bytes) {
  return words_of(bytes).has_value();
}

std::vector<NastranMatrix> read_op2(std::string_view bytes, const std::string& path) {
  const std::optional<Words> words = words_of(bytes);
  if (!words) throw core::DataError(path + ": is no file of OUTPUT2");
  std::vector<std::string> tables;
  std::vector<NastranMatrix> matrices = Op2Reader(bytes, path, *words).matrices(tables);
  if (!matrices.empty()) return matrices;
  std::string names;
  for (const std::string& name : tables) names += (names.empty() ? "" : ", ") + name;
  throw core::DataError(path + ": holds no matrix of OUTPUT2" + (names.empty() ? "" : ", only the tables " + names) +
                        "; write the matrices by OUTPUT2 KAA,MAA, by OUTPUT4, or by DMIGPCH");
}

}  // namespace thinwall::io
