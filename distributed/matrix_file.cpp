#include "distributed/matrix_file.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "core/error.hpp"
#include "distributed/open_file.hpp"

namespace thinwall::distributed {

namespace {

using Access = OpenFile::Access;
using linalg::SparseMatrix;

/// The places of the parts of a file, bytes.
struct Places {
  std::size_t start, column, value;
};

using Header = std::array<std::int64_t, 2>;  // rows, entries

Places places(const Header& header) {
  const std::size_t start = sizeof(Header);
  const std::size_t column = start + sizeof(std::int64_t) * static_cast<std::size_t>(header[0] + 1);
  const std::size_t value = column + sizeof(int) * static_cast<std::size_t>(header[1] + header[1] % 2);
  return {start, column, value};
}

Header header_of(const OpenFile& file) {
  Header header{};
  file.read(header.data(), sizeof header, 0);
  return header;
}

/// The place in A of the first entry of a column on or below the diagonal, which is the row's part of the upper
/// triangle because A is symmetric.
int upper_start(const SparseMatrix& A, Eigen::Index column) {
  const int* begin = A.innerIndexPtr() + A.outerIndexPtr()[column];
  const int* end = A.innerIndexPtr() + A.outerIndexPtr()[column + 1];
  return static_cast<int>(std::lower_bound(begin, end, static_cast<int>(column)) - A.innerIndexPtr());
}

}  // namespace

void write_upper_rows(const SparseMatrix& A, const std::filesystem::path& path) {
  OpenFile file(path, Access::write);
  std::vector<std::int64_t> start(static_cast<std::size_t>(A.rows()) + 1, 0);
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    start[static_cast<std::size_t>(i) + 1] =
        start[static_cast<std::size_t>(i)] + A.outerIndexPtr()[i + 1] - upper_start(A, i);
  const Header header{A.rows(), start.back()};
  const Places at = places(header);
  file.write(header.data(), sizeof header, 0);
  file.write(start.data(), sizeof(std::int64_t) * start.size(), at.start);
  constexpr Eigen::Index piece = 8192;
  std::vector<int> columns;
  std::vector<double> values;
  for (Eigen::Index first = 0; first < A.rows(); first += piece) {
    columns.clear();
    values.clear();
    for (Eigen::Index i = first; i < std::min(first + piece, A.rows()); ++i) {
      const int from = upper_start(A, i), to = A.outerIndexPtr()[i + 1];
      columns.insert(columns.end(), A.innerIndexPtr() + from, A.innerIndexPtr() + to);
      values.insert(values.end(), A.valuePtr() + from, A.valuePtr() + to);
    }
    const auto before = static_cast<std::size_t>(start[static_cast<std::size_t>(first)]);
    file.write(columns.data(), sizeof(int) * columns.size(), at.column + sizeof(int) * before);
    file.write(values.data(), sizeof(double) * values.size(), at.value + sizeof(double) * before);
  }
  file.finish();
}

std::int64_t rows_of(const std::filesystem::path& path) {
  return header_of(OpenFile(path, Access::read))[0];
}

UpperRows read_upper_rows(const std::filesystem::path& path, std::int64_t first, std::int64_t last) {
  const OpenFile file(path, Access::read);
  const Header header = header_of(file);
  const Places at = places(header);
  std::vector<std::int64_t> start(static_cast<std::size_t>(last - first) + 1);
  file.read(start.data(), sizeof(std::int64_t) * start.size(),
            at.start + sizeof(std::int64_t) * static_cast<std::size_t>(first));
  const std::int64_t before = start.front(), entries = start.back() - before;
  if (entries > std::numeric_limits<int>::max()) {
    throw core::NumericalError("a rank's share of the matrix has " + std::to_string(entries) +
                               " entries, more than 32-bit indices count: take more ranks");
  }
  UpperRows rows{header[0], {}, {}, {}};
  rows.start.reserve(start.size());
  for (const std::int64_t place : start) rows.start.push_back(static_cast<int>(place - before));
  rows.column.resize(static_cast<std::size_t>(entries));
  rows.value.resize(static_cast<std::size_t>(entries));
  file.read(rows.column.data(), sizeof(int) * rows.column.size(),
            at.column + sizeof(int) * static_cast<std::size_t>(before));
  file.read(rows.value.data(), sizeof(double) * rows.value.size(),
            at.value + sizeof(double) * static_cast<std::size_t>(before));
  return rows;
}

}  // namespace thinwall::distributed
