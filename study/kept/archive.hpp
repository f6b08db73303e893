#pragma once
// Results as bytes and back: Eigen's and the field's types for cereal.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cereal/archives/binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/complex.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/utility.hpp>
#include <cereal/types/vector.hpp>
#include <istream>
#include <sstream>
#include <streambuf>
#include <string>

#include "core/error.hpp"

// cereal finds these by the namespace of their argument.
namespace Eigen {

/// Writes a dense matrix: its size, then its entries.
template <class Archive, class Scalar, int rows, int cols, int options, int max_rows, int max_cols>
void save(Archive& archive, const Matrix<Scalar, rows, cols, options, max_rows, max_cols>& matrix) {
  archive(static_cast<std::int64_t>(matrix.rows()), static_cast<std::int64_t>(matrix.cols()));
  archive(cereal::binary_data(matrix.data(), static_cast<std::size_t>(matrix.size()) * sizeof(Scalar)));
}

/// Reads a dense matrix.
template <class Archive, class Scalar, int rows, int cols, int options, int max_rows, int max_cols>
void load(Archive& archive, Matrix<Scalar, rows, cols, options, max_rows, max_cols>& matrix) {
  std::int64_t height = 0, width = 0;
  archive(height, width);
  matrix.resize(height, width);
  archive(cereal::binary_data(matrix.data(), static_cast<std::size_t>(matrix.size()) * sizeof(Scalar)));
}

/// Writes a compressed sparse matrix: its size, then the arrays that hold it.
template <class Archive, class Scalar, int options, class Index>
void save(Archive& archive, const SparseMatrix<Scalar, options, Index>& matrix) {
  if (!matrix.isCompressed()) throw thinwall::core::NumericalError("a sparse matrix to be kept is not compressed");
  archive(static_cast<std::int64_t>(matrix.rows()), static_cast<std::int64_t>(matrix.cols()),
          static_cast<std::int64_t>(matrix.nonZeros()));
  const auto entries = static_cast<std::size_t>(matrix.nonZeros());
  archive(
      cereal::binary_data(matrix.outerIndexPtr(), static_cast<std::size_t>(matrix.outerSize() + 1) * sizeof(Index)));
  archive(cereal::binary_data(matrix.innerIndexPtr(), entries * sizeof(Index)));
  archive(cereal::binary_data(matrix.valuePtr(), entries * sizeof(Scalar)));
}

/// Reads a sparse matrix.
template <class Archive, class Scalar, int options, class Index>
void load(Archive& archive, SparseMatrix<Scalar, options, Index>& matrix) {
  std::int64_t rows = 0, cols = 0, count = 0;
  archive(rows, cols, count);
  matrix.resize(rows, cols);
  matrix.resizeNonZeros(count);
  const auto entries = static_cast<std::size_t>(count);
  archive(
      cereal::binary_data(matrix.outerIndexPtr(), static_cast<std::size_t>(matrix.outerSize() + 1) * sizeof(Index)));
  archive(cereal::binary_data(matrix.innerIndexPtr(), entries * sizeof(Index)));
  archive(cereal::binary_data(matrix.valuePtr(), entries * sizeof(Scalar)));
}

}  // namespace Eigen

namespace thinwall::study {

/// Everything given, in order, to the last bit; for the machine that wrote it.
template <class... Items>
[[nodiscard]] std::string to_bytes(const Items&... items) {
  std::ostringstream out(std::ios::binary);
  cereal::BinaryOutputArchive archive(out);
  archive(items...);
  return std::move(out).str();
}

/// Bytes read where they lie.
class BytesInPlace : public std::streambuf {
 public:
  explicit BytesInPlace(const std::string& bytes) {
    char* first = const_cast<char*>(bytes.data());  // std::streambuf asks for it and writes nothing
    setg(first, first, first + bytes.size());
  }
};

/// The inverse of to_bytes. Throws DataError for bytes that end too early.
template <class... Items>
void from_bytes(const std::string& bytes, Items&... items) {
  BytesInPlace buffer(bytes);
  std::istream in(&buffer);
  cereal::BinaryInputArchive archive(in);
  try {
    archive(items...);
  } catch (const cereal::Exception& error) {
    throw core::DataError(std::string("kept results end too early: ") + error.what());
  }
}

}  // namespace thinwall::study
