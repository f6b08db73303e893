#pragma once
// The key under which the result of a stage is kept: a hash over every byte of the stage's input.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/SparseCore>
#include <array>
#include <complex>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/fields.hpp"
#include "setup/imported_part.hpp"
#include "setup/measured_frf.hpp"
#include "setup/point.hpp"
#include "setup/robot.hpp"

// A struct with an optional Eigen vector has to state the number of its members (core/fields.hpp).
namespace thinwall::core {

template <>
inline constexpr std::size_t member_count<setup::Point> = 9;
template <>
inline constexpr std::size_t member_count<setup::PostureWish> = 9;

}  // namespace thinwall::core

namespace thinwall::study {

/// Bytes that tell one value from any other of its type. Members of structs are found by core::fields_of, so a member
/// that is added later belongs to the key without being named. Lengths stand before what varies in length, and the
/// number of the alternative before a variant, so that no two values have equal bytes.
class InputBytes {
 public:
  /// Adds a number or an enumeration by its bytes.
  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void add(const T& value) { bytes_.append(reinterpret_cast<const char*>(&value), sizeof value); }
  /// Adds real and imaginary part.
  template <class Real>
  void add(const std::complex<Real>& value) {
    add(value.real());
    add(value.imag());
  }
  /// Adds the length of a text and its characters.
  void add(const std::string& text) {
    add(text.size());
    bytes_ += text;
  }
  /// Adds the name of a file without its folders: the input holds what stands in the file, and a case that is named by
  /// another path is the same case.
  void add(const std::filesystem::path& path) { add(path.filename().string()); }
  /// Adds a mark that tells if the value is there, and the value.
  template <class T>
  void add(const std::optional<T>& value) {
    add(value.has_value());
    if (value) add(*value);
  }
  /// Adds a mark that tells if there is an object, and the object.
  template <class T>
  void add(const std::shared_ptr<T>& value) {
    add(value != nullptr);
    if (value) add(*value);
  }
  /// Adds the number of the alternative and its value.
  template <class... Alternatives>
  void add(const std::variant<Alternatives...>& value) {
    add(value.index());
    std::visit([this](const auto& alternative) { this->add(alternative); }, value);
  }
  /// Adds nothing: the number of the alternative tells it.
  void add(const std::monostate& /*nothing*/) {}
  /// Adds both values.
  template <class First, class Second>
  void add(const std::pair<First, Second>& pair) {
    add(pair.first);
    add(pair.second);
  }
  /// Adds the length of a list and its items.
  template <class T>
  void add(const std::vector<T>& list) {
    add(list.size());
    for (const auto& item : list) add(static_cast<const T&>(item));
  }
  /// Adds all items of an array.
  template <class T, std::size_t n>
  void add(const std::array<T, n>& list) {
    for (const T& item : list) add(item);
  }
  /// Adds the length of a map, and its names and values in their order.
  template <class Name, class T>
  void add(const std::map<Name, T>& list) {
    add(list.size());
    for (const auto& item : list) add(item);
  }
  /// Adds the size of a dense matrix and its entries.
  template <class Scalar, int rows, int cols, int options, int max_rows, int max_cols>
  void add(const Eigen::Matrix<Scalar, rows, cols, options, max_rows, max_cols>& matrix) {
    add(matrix.rows());
    add(matrix.cols());
    bytes_.append(reinterpret_cast<const char*>(matrix.data()),
                  static_cast<std::size_t>(matrix.size()) * sizeof(Scalar));
  }
  /// Adds the size of a sparse matrix, and its entries with their places.
  template <class Scalar, int options, class Index>
  void add(const Eigen::SparseMatrix<Scalar, options, Index>& matrix) {
    add(matrix.rows());
    add(matrix.cols());
    add(matrix.nonZeros());
    for (Eigen::Index column = 0; column < matrix.outerSize(); ++column) {
      for (typename Eigen::SparseMatrix<Scalar, options, Index>::InnerIterator entry(matrix, column); entry; ++entry) {
        add(entry.row());
        add(entry.col());
        add(entry.value());
      }
    }
  }
  /// Adds the matrix of a frame.
  template <class Scalar, int dimension, int mode, int options>
  void add(const Eigen::Transform<Scalar, dimension, mode, options>& frame) {
    add(typename Eigen::Transform<Scalar, dimension, mode, options>::MatrixType(frame.matrix()));
  }
  /// Adds the two corners of a box.
  template <class Scalar, int dimension>
  void add(const Eigen::AlignedBox<Scalar, dimension>& box) {
    add(Eigen::Matrix<Scalar, dimension, 1>(box.min()));
    add(Eigen::Matrix<Scalar, dimension, 1>(box.max()));
  }
  /// Adds a measured FRF without the name of its file, which messages have.
  void add(const io::MeasuredFrf& frf) {
    const auto& [axis, H, source, coherence] = frf;
    add_all(axis, H, coherence);
  }
  /// Adds a measured FRF without what is said about its file, by the path that the case gives it.
  void add(const setup::FrfContent& content) {
    const auto& [frf, notes, warnings, lines_left_out] = content;
    add_all(frf, lines_left_out);
  }
  /// Adds a part from a file without such words.
  void add(const setup::ImportedPart& part) {
    const auto& [surface, mesh, matrices, box, summary, notes] = part;
    add_all(surface, mesh, matrices, box, summary);
  }
  /// Adds a set of nodes, and a mark that tells if it can be used.
  void add(const mesh::NodeSet& set) {
    const auto& [name, nodes, fault] = set;
    add_all(name, nodes, fault.empty());
  }
  /// Adds a mesh from a file without such words.
  void add(const mesh::SolidMesh& solid) {
    const auto& [tets, nodes, node_labels, element_labels, node_sets, element_sets, midside_offset, least_jacobian,
                 pieces, coincident_nodes, notices] = solid;
    add_all(tets, nodes, node_labels, element_labels, node_sets, element_sets, midside_offset, least_jacobian, pieces,
            coincident_nodes);
  }
  /// Adds all members of a struct in the order of their declaration.
  template <class Struct>
  requires std::is_class_v<Struct> && std::is_aggregate_v<Struct>
  void add(const Struct& value) {
    std::apply([this](const auto&... member) { this->add_all(member...); }, core::fields_of(value));
  }

  /// The bytes of all that was added.
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  template <class... Values>
  void add_all(const Values&... values) {
    (add(values), ...);
  }

  std::string bytes_;
};

/// SHA-256, in hexadecimal digits, of the running program and of `bytes`. Two programs share nothing that is kept,
/// because they may compute it in different ways. Cost: the hash of the bytes.
[[nodiscard]] std::string key_of_bytes(const std::string& bytes);

/// The key of a stage's input, which may be several structs.
template <class... Inputs>
[[nodiscard]] std::string input_key(const Inputs&... inputs) {
  InputBytes all;
  (all.add(inputs), ...);
  return key_of_bytes(all.bytes());
}

}  // namespace thinwall::study
