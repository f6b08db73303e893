#include "io/mat.hpp"

#include <fcntl.h>
#include <matio.h>
#include <sys/mman.h>
#include <unistd.h>
#include <utf8cpp/utf8.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>

#include "core/atomic_file.hpp"
#include "core/error.hpp"

namespace thinwall::io {

namespace {

using dynamics::Dof;
using dynamics::DofKind;
using dynamics::SpatialModel;

struct CloseMat {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using MatFile = std::unique_ptr<mat_t, CloseMat>;
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

/// matio writes to a path and does not notice a full disk: it is given a file in memory, whose bytes we write
/// ourselves.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(::memfd_create("thinwall", MFD_CLOEXEC)) {
    if (descriptor_ < 0) throw core::DataError("no memory to write a MAT file");
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

constexpr std::array kind_words{std::pair{DofKind::translation, "translation"},
                                std::pair{DofKind::rotation, "rotation"}, std::pair{DofKind::modal, "modal"}};

std::string kind_word(DofKind kind) {
  for (const auto& [known, word] : kind_words) {
    if (known == kind) return word;
  }
  throw core::InputError("a degree of freedom is of no known kind");
}

void require_small_enough(const SpatialModel& model) {
  constexpr Eigen::Index largest = 16000;  // 8 n² bytes stay below the 2 GiB of a variable
  if (model.size() > largest) {
    throw core::InputError("a MAT file of version 5 holds at most " + std::to_string(largest) +
                           " DOFs, the model has " + std::to_string(model.size()) + "; keep fewer modes");
  }
}

void write_variable(mat_t* file, const Variable& variable) {
  if (!variable || Mat_VarWrite(file, variable.get(), MAT_COMPRESSION_NONE) != 0) {
    throw core::DataError("matio cannot encode the model");
  }
}

void write_matrix(mat_t* file, const char* name, const Eigen::MatrixXd& matrix) {
  std::array size{static_cast<std::size_t>(matrix.rows()), static_cast<std::size_t>(matrix.cols())};
  Eigen::MatrixXd values = matrix;  // matio's interface is not const
  write_variable(file, Variable(Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size.data(), values.data(), 0)));
}

/// The format counts characters, not bytes: UTF-16 keeps a name with an umlaut readable everywhere.
std::u16string utf16(const std::string& text) {
  if (!utf8::is_valid(text)) throw core::InputError("the name \"" + text + "\" is not UTF-8; rename the point");
  return utf8::utf8to16(text);
}

/// One text a DOF, as a cell array n × 1.
template <typename TextOf>
void write_texts(mat_t* file, const char* name, const dynamics::DofTable& dofs, TextOf text_of) {
  std::array size{dofs.size(), std::size_t{1}};
  const Variable cells(Mat_VarCreate(name, MAT_C_CELL, MAT_T_CELL, 2, size.data(), nullptr, 0));
  if (!cells) throw core::DataError("matio cannot encode the model");
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    std::u16string text = utf16(text_of(dofs[i]));
    std::array length{std::size_t{1}, text.size()};
    Mat_VarSetCell(cells.get(), static_cast<int>(i),
                   Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UTF16, 2, length.data(), text.data(), 0));
  }
  write_variable(file, cells);
}

Eigen::MatrixXd directions(const dynamics::DofTable& dofs) {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(dofs.size()), 3);
  for (std::size_t i = 0; i < dofs.size(); ++i) rows.row(static_cast<Eigen::Index>(i)) = dofs[i].direction.transpose();
  return rows;
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& cause) {
  throw core::DataError(path.string() + ": " + cause);
}

/// A real matrix of the given shape (−1: any).
Eigen::MatrixXd read_matrix(mat_t* file, const char* name, const std::filesystem::path& path, Eigen::Index rows,
                            Eigen::Index columns) {
  const Variable variable(Mat_VarRead(file, name));
  if (!variable) fail(path, std::string("has no variable ") + name);
  if (variable->class_type != MAT_C_DOUBLE || variable->data_type != MAT_T_DOUBLE || variable->rank != 2 ||
      variable->isComplex != 0) {
    fail(path, std::string("the variable ") + name + " is not a full real matrix of doubles");
  }
  const auto found_rows = static_cast<Eigen::Index>(variable->dims[0]);
  const auto found_columns = static_cast<Eigen::Index>(variable->dims[1]);
  if ((rows >= 0 && found_rows != rows) || (columns >= 0 && found_columns != columns)) {
    fail(path, std::string("the variable ") + name + " is " + std::to_string(found_rows) + " × " +
                   std::to_string(found_columns) + ", expected " + std::to_string(rows) + " × " +
                   std::to_string(columns));
  }
  Eigen::MatrixXd matrix =
      Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(variable->data), found_rows, found_columns);
  if (!matrix.allFinite()) fail(path, std::string("the variable ") + name + " holds NaN or infinity");
  return matrix;
}

/// matio reads a variable whose end is missing as if its last entries were zero; the lengths in the file tell. An
/// element is a tag (type, bytes), then its data in whole words of 8 bytes unless they are compressed.
void require_whole(const std::filesystem::path& path) {
  constexpr std::size_t header_size = 128;
  constexpr std::size_t tag_size = 8;
  const std::string bytes = core::read_file(path);
  std::size_t at = header_size;
  while (at + tag_size <= bytes.size()) {
    std::array<std::uint32_t, 2> tag{};
    std::memcpy(tag.data(), bytes.data() + at, tag_size);
    const std::size_t size = tag[1];
    at += tag_size + (tag[0] == MAT_T_COMPRESSED ? size : (size + 7) / 8 * 8);
  }
  if (at != bytes.size()) fail(path, "is no whole MAT file of version 5; write it again with that version");
}

bool has_variable(mat_t* file, const char* name) {
  return Variable(Mat_VarReadInfo(file, name)) != nullptr;
}

/// The characters of a cell as UTF-8; MATLAB writes 16-bit characters, other programs bytes.
std::string utf8_text(const matvar_t& cell, const std::filesystem::path& path) {
  const std::size_t length = cell.dims[0] * cell.dims[1];
  if (cell.data_size != 2) return {static_cast<const char*>(cell.data), length};
  try {
    return utf8::utf16to8(std::u16string(static_cast<const char16_t*>(cell.data), length));
  } catch (const utf8::exception&) {
    fail(path, "holds a name with broken characters");
  }
}

std::vector<std::string> read_texts(mat_t* file, const char* name, const std::filesystem::path& path,
                                    Eigen::Index rows) {
  const Variable cells(Mat_VarRead(file, name));
  if (!cells) fail(path, std::string("has no variable ") + name);
  if (cells->class_type != MAT_C_CELL || cells->rank != 2 || cells->dims[1] != 1 ||
      static_cast<Eigen::Index>(cells->dims[0]) != rows) {
    fail(path, std::string("the variable ") + name + " is not a cell array of " + std::to_string(rows) + " × 1 texts");
  }
  std::vector<std::string> texts;
  for (int i = 0; i < static_cast<int>(rows); ++i) {
    const matvar_t* cell = Mat_VarGetCell(cells.get(), i);
    if (cell == nullptr || cell->class_type != MAT_C_CHAR)
      fail(path, std::string(name) + " holds something not a text");
    texts.push_back(utf8_text(*cell, path));
  }
  return texts;
}

DofKind kind_of(const std::string& word, const std::filesystem::path& path) {
  for (const auto& [kind, known] : kind_words) {
    if (word == known) return kind;
  }
  fail(path, "dof_kind \"" + word + "\" is none of translation, rotation, modal");
}

}  // namespace

void write_mat(const std::filesystem::path& path, const SpatialModel& model) {
  dynamics::require_consistent(model);
  require_small_enough(model);
  const MemoryFile memory;
  {
    const MatFile file(
        Mat_CreateVer(memory.path().c_str(), "MATLAB 5.0 MAT-file, reduced model by thinwall", MAT_FT_MAT5));
    if (!file) throw core::DataError("matio cannot create a MAT file in memory");
    write_matrix(file.get(), "M", model.M);
    write_matrix(file.get(), "C", model.C);
    write_matrix(file.get(), "K", model.K);
    if (model.has_structural_damping()) write_matrix(file.get(), "D", model.D);
    if (model.has_own_coordinates()) write_matrix(file.get(), "T", model.T);
    write_texts(file.get(), "dof_name", model.dofs, [](const Dof& dof) { return name(dof); });
    write_texts(file.get(), "dof_point", model.dofs, [](const Dof& dof) { return dof.point; });
    write_texts(file.get(), "dof_kind", model.dofs, [](const Dof& dof) { return kind_word(dof.kind); });
    write_texts(file.get(), "dof_unit", model.dofs, [](const Dof& dof) { return unit(dof); });
    write_matrix(file.get(), "dof_direction", directions(model.dofs));
  }
  core::write_file_atomically(path, core::read_file(memory.path()));
}

SpatialModel read_mat(const std::filesystem::path& path) {
  require_whole(path);
  const MatFile file(Mat_Open(path.c_str(), MAT_ACC_RDONLY));
  if (!file) fail(path, "cannot be read as a MAT file");
  SpatialModel model;
  model.M = read_matrix(file.get(), "M", path, -1, -1);
  const Eigen::Index n = model.M.rows();
  if (model.M.cols() != n) fail(path, "the variable M is not square");
  model.K = read_matrix(file.get(), "K", path, n, n);
  model.C = has_variable(file.get(), "C") ? read_matrix(file.get(), "C", path, n, n) : Eigen::MatrixXd::Zero(n, n);
  if (has_variable(file.get(), "D")) model.D = read_matrix(file.get(), "D", path, n, n);
  if (has_variable(file.get(), "T")) {
    model.T = read_matrix(file.get(), "T", path, -1, -1);
    if (model.T.cols() != n || model.T.rows() == 0) {
      fail(path, "the variable T is " + std::to_string(model.T.rows()) + " x " + std::to_string(model.T.cols()) +
                     "; it must have a column for each of the " + std::to_string(n) + " rows of M");
    }
  }
  const Eigen::Index dofs = model.has_own_coordinates() ? model.T.rows() : n;
  const auto points = read_texts(file.get(), "dof_point", path, dofs);
  const auto kinds = read_texts(file.get(), "dof_kind", path, dofs);
  const auto axes = read_matrix(file.get(), "dof_direction", path, dofs, 3);
  for (Eigen::Index i = 0; i < dofs; ++i) {
    const auto row = static_cast<std::size_t>(i);
    model.dofs.push_back({points[row], axes.row(i).transpose(), kind_of(kinds[row], path)});
  }
  return model;
}

}  // namespace thinwall::io
