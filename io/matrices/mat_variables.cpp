#include "io/matrices/mat_variables.hpp"

#include <fcntl.h>
#include <matio.h>
#include <sys/mman.h>
#include <unistd.h>
#include <utf8cpp/utf8.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string_view>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/matrices/mat4.hpp"
#include "io/matrices/mat5_layout.hpp"
#include "io/matrices/mat_version.hpp"

namespace thinwall::io {

namespace {

using dynamics::Dof;
using dynamics::DofKind;

struct CloseMat {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using MatFile = std::unique_ptr<mat_t, CloseMat>;
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

/// A file in memory for matio. matio writes to a path and does not notice a full disk, so that this program writes the
/// bytes to the disk itself.
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

// ---- Writing ----

std::size_t count_of(const std::vector<std::size_t>& size) {
  std::size_t count = 1;
  for (const std::size_t length : size) count *= length;
  return count;
}

void require_writable(const MatVariable& variable) {
  constexpr std::size_t largest = (std::size_t{1} << 31U) - 4096;  // with tags and names
  const auto entries = static_cast<std::size_t>(variable.sparse.nonZeros());
  if (8 * (variable.re.size() + variable.im.size()) + 12 * entries > largest) {
    throw core::InputError("the variable " + variable.name +
                           " exceeds the 2 GiB that a MAT file of version 5 holds; write fewer lines or DOFs");
  }
  const auto is_finite = [](double value) { return std::isfinite(value); };
  if (!std::all_of(variable.re.begin(), variable.re.end(), is_finite) ||
      !std::all_of(variable.im.begin(), variable.im.end(), is_finite) ||
      !std::all_of(variable.sparse.valuePtr(), variable.sparse.valuePtr() + entries, is_finite)) {
    throw core::InputError("the variable " + variable.name + " is not finite");
  }
}

/// The text in UTF-16. The format counts characters, not bytes, so that names with umlauts are readable everywhere.
std::u16string utf16(const std::string& text) {
  if (!utf8::is_valid(text)) throw core::InputError("the name \"" + text + "\" is not UTF-8; rename the point");
  return utf8::utf8to16(text);
}

Variable encoded_texts(const MatVariable& variable) {
  std::array size{variable.texts.size(), std::size_t{1}};
  Variable cells(Mat_VarCreate(variable.name.c_str(), MAT_C_CELL, MAT_T_CELL, 2, size.data(), nullptr, 0));
  if (!cells) throw core::DataError("matio cannot encode the variable " + variable.name);
  for (std::size_t i = 0; i < variable.texts.size(); ++i) {
    std::u16string text = utf16(variable.texts[i]);
    std::array length{std::size_t{1}, text.size()};
    Mat_VarSetCell(cells.get(), static_cast<int>(i),
                   Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UTF16, 2, length.data(), text.data(), 0));
  }
  return cells;
}

/// The variable with its compressed columns in the layout of the format.
Variable encoded_sparse(MatVariable variable) {
  variable.sparse.makeCompressed();
  mat_sparse_t parts{};
  const auto entries = static_cast<mat_uint32_t>(variable.sparse.nonZeros());
  std::vector<mat_uint32_t> rows(variable.sparse.innerIndexPtr(), variable.sparse.innerIndexPtr() + entries);
  std::vector<mat_uint32_t> starts(variable.sparse.outerIndexPtr(),
                                   variable.sparse.outerIndexPtr() + variable.sparse.cols() + 1);
  parts.nzmax = entries;
  parts.ir = rows.data();
  parts.nir = entries;
  parts.jc = starts.data();
  parts.njc = static_cast<mat_uint32_t>(starts.size());
  parts.ndata = entries;
  parts.data = variable.sparse.valuePtr();
  return Variable(Mat_VarCreate(variable.name.c_str(), MAT_C_SPARSE, MAT_T_DOUBLE, 2, variable.size.data(), &parts, 0));
}

Variable encoded_numbers(MatVariable variable) {  // a copy: matio's interface is not const
  const auto rank = static_cast<int>(variable.size.size());
  if (variable.im.empty()) {
    return Variable(Mat_VarCreate(variable.name.c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE, rank, variable.size.data(),
                                  variable.re.data(), 0));
  }
  mat_complex_split_t parts{variable.re.data(), variable.im.data()};
  return Variable(Mat_VarCreate(variable.name.c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE, rank, variable.size.data(), &parts,
                                MAT_F_COMPLEX));
}

bool is_same(const MatVariable& a, const MatVariable& b) {
  return a.size == b.size && a.re == b.re && a.im == b.im && a.texts == b.texts && a.is_sparse == b.is_sparse &&
         (!a.is_sparse || Eigen::SparseMatrix<double>(a.sparse - b.sparse).norm() == 0.0);
}

Variable encoded(const MatVariable& variable) {
  if (variable.is_sparse) return encoded_sparse(variable);
  return variable.texts.empty() ? encoded_numbers(variable) : encoded_texts(variable);
}

/// Reads again what matio wrote into memory, because it does not notice a write that fails. Throws DataError.
void require_written(const std::string& path, const std::string& header, const std::vector<MatVariable>& variables) {
  std::vector<std::string> names(variables.size());
  std::ranges::transform(variables, names.begin(), &MatVariable::name);
  bool whole = core::read_file(path).starts_with(header);
  try {
    const MatVariables read = read_mat_variables(path, names);
    for (const MatVariable& variable : variables) whole = whole && is_same(read.at(variable.name), variable);
  } catch (const std::exception&) {
    whole = false;
  }
  if (!whole) throw core::DataError("no memory to write a MAT file");
}

// ---- Reading ----

/// Throws DataError if a variable states more entries than its bytes can contain: every entry of an array or a list
/// takes at least one byte, every column of a sparse matrix four. matio would allocate the memory stated.
void require_entries_within(const matvar_t& stated, std::size_t bytes, const std::string& name,
                            const std::filesystem::path& path) {
  const bool is_sparse = stated.class_type == MAT_C_SPARSE && stated.rank == 2;
  std::size_t left = bytes;
  for (int i = is_sparse ? 1 : 0; i < stated.rank && left > 0; ++i) {
    if (stated.dims[i] == 0) return;
    left /= stated.dims[i];
  }
  if (left == 0) fail_in(path, "the variable " + name + " states more entries than the file holds: write it again");
}

/// The bytes that a file of version 7.3 can hold at most, for deflate makes a byte of 1032 at best.
std::size_t most_bytes_within(const std::filesystem::path& path) {
  constexpr std::size_t ratio_of_deflate = 1032;
  return std::filesystem::file_size(path) * ratio_of_deflate;
}

/// The characters of a cell as UTF-8, from the 16-bit characters of MATLAB or the bytes of other programs.
std::string utf8_text(const matvar_t& cell, const std::filesystem::path& path) {
  const std::size_t length = cell.dims[0] * cell.dims[1];
  const auto size = static_cast<std::size_t>(std::max(cell.data_size, 1));
  if (length > cell.nbytes / size || (length > 0 && cell.data == nullptr))
    fail_in(path, "holds a name without its characters; write it again");
  if (length == 0) return {};
  if (cell.data_size != 2) return {static_cast<const char*>(cell.data), length};
  try {
    return utf8::utf16to8(std::u16string(static_cast<const char16_t*>(cell.data), length));
  } catch (const utf8::exception&) {
    fail_in(path, "holds a name with broken characters");
  }
}

std::vector<std::string> texts_of(const matvar_t& cells, const std::filesystem::path& path, const std::string& name) {
  if (cells.rank != 2 || std::min(cells.dims[0], cells.dims[1]) > 1)
    fail_in(path, "the variable " + name + " is no list");
  const std::size_t count = cells.dims[0] * cells.dims[1];
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < count; ++i) {
    const matvar_t* cell = Mat_VarGetCell(const_cast<matvar_t*>(&cells), static_cast<int>(i));
    if (cell == nullptr || cell->class_type != MAT_C_CHAR || cell->rank != 2) {
      fail_in(path, name + " holds something not a text");
    }
    texts.push_back(utf8_text(*cell, path));
  }
  return texts;
}

template <typename Number>
std::vector<double> numbers_of(const void* data, std::size_t count, const std::filesystem::path& path,
                               const std::string& name) {
  if (data == nullptr && count > 0) fail_in(path, "the variable " + name + " has no values");
  const auto* numbers = static_cast<const Number*>(data);
  std::vector<double> values(numbers, numbers + count);
  for (const double value : values) {
    if (!std::isfinite(value)) fail_in(path, "the variable " + name + " holds NaN or infinity");
  }
  return values;
}

template <typename Number>
void take_numbers(const matvar_t& stored, const std::filesystem::path& path, MatVariable& variable) {
  const std::size_t count = count_of(variable.size);
  if (count > stored.nbytes / sizeof(Number))
    fail_in(path, "the variable " + variable.name + " has fewer values than it states: write it again");
  if (stored.isComplex == 0) {
    variable.re = numbers_of<Number>(stored.data, count, path, variable.name);
    return;
  }
  const auto* parts = static_cast<const mat_complex_split_t*>(stored.data);
  if (parts == nullptr) fail_in(path, "the variable " + variable.name + " has no values");
  variable.re = numbers_of<Number>(parts->Re, count, path, variable.name);
  variable.im = numbers_of<Number>(parts->Im, count, path, variable.name);
}

void take_numbers_of_any_kind(const matvar_t& stored, const std::filesystem::path& path, MatVariable& variable) {
  const auto take = [&]<typename... Number>() {
    constexpr std::array types{MAT_T_DOUBLE, MAT_T_SINGLE, MAT_T_INT8,   MAT_T_UINT8, MAT_T_INT16,
                               MAT_T_UINT16, MAT_T_INT32,  MAT_T_UINT32, MAT_T_INT64, MAT_T_UINT64};
    std::size_t i = 0;
    return ((stored.data_type == types[i++] && (take_numbers<Number>(stored, path, variable), true)) || ...);
  };
  const bool taken = take.operator()<double, float, std::int8_t, std::uint8_t, std::int16_t, std::uint16_t,
                                     std::int32_t, std::uint32_t, std::int64_t, std::uint64_t>();
  if (!taken) fail_in(path, "the variable " + variable.name + " is of numbers that are not known");
}

/// The sparse matrix with each index checked, because matio takes indices unchecked from the file.
Eigen::SparseMatrix<double> sparse_numbers(const matvar_t& stored, const std::string& name,
                                           const std::filesystem::path& path) {
  const auto* parts = static_cast<const mat_sparse_t*>(stored.data);
  if (parts == nullptr || stored.isComplex != 0 || stored.data_type != MAT_T_DOUBLE || stored.rank != 2)
    fail_in(path, "the variable " + name + " is no real sparse matrix of doubles");
  const std::size_t rows = stored.dims[0], columns = stored.dims[1];
  const auto* values = static_cast<const double*>(parts->data);
  const bool whole = parts->jc != nullptr && parts->njc == columns + 1 && parts->jc[0] == 0 &&
                     std::is_sorted(parts->jc, parts->jc + parts->njc) && parts->jc[columns] <= parts->nir &&
                     parts->jc[columns] <= parts->ndata && rows < std::size_t{1} << 31U;
  if (!whole) fail_in(path, "the sparse variable " + name + " is not whole: write it again");
  std::vector<Eigen::Triplet<double>> triplets;
  for (std::size_t column = 0; column < columns; ++column) {
    for (std::size_t k = parts->jc[column]; k < parts->jc[column + 1]; ++k) {
      if (parts->ir[k] >= rows) fail_in(path, "the sparse variable " + name + " has an entry beyond its rows");
      if (!std::isfinite(values[k])) fail_in(path, "the variable " + name + " holds NaN or infinity");
      triplets.emplace_back(static_cast<int>(parts->ir[k]), static_cast<int>(column), values[k]);
    }
  }
  Eigen::SparseMatrix<double> sparse(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
  sparse.setFromTriplets(triplets.begin(), triplets.end());
  return sparse;
}

MatVariable decoded(const matvar_t& stored, const std::string& name, const std::filesystem::path& path) {
  MatVariable variable{name, {stored.dims, stored.dims + stored.rank}, {}};
  if (stored.class_type == MAT_C_CELL) {
    variable.texts = texts_of(stored, path, name);
  } else if (stored.class_type == MAT_C_SPARSE) {
    variable.is_sparse = true;
    variable.sparse = sparse_numbers(stored, name, path);
  } else if (stored.class_type >= MAT_C_DOUBLE && stored.class_type <= MAT_C_UINT64) {
    take_numbers_of_any_kind(stored, path, variable);
  } else {
    fail_in(path, "the variable " + name + " is neither a matrix of numbers nor a list of texts");
  }
  return variable;
}

DofKind kind_of(const std::string& word, const std::filesystem::path& path) {
  for (const auto& [kind, known] : kind_words) {
    if (word == known) return kind;
  }
  fail_in(path, "the kind \"" + word + "\" is none of translation, rotation, modal");
}

MatVariable text_variable(const std::string& name, const dynamics::DofTable& dofs, std::string (*text_of)(const Dof&)) {
  MatVariable variable{name, {dofs.size(), 1}, {}};
  for (const Dof& dof : dofs) variable.texts.push_back(text_of(dof));
  return variable;
}

}  // namespace

void fail_in(const std::filesystem::path& path, const std::string& cause) {
  throw core::DataError(path.string() + ": " + cause);
}

void write_mat_variables(const std::filesystem::path& path, const std::string& title,
                         const std::vector<MatVariable>& variables) {
  const MemoryFile memory;
  const std::string header = "MATLAB 5.0 MAT-file, " + title;
  {
    const MatFile file(Mat_CreateVer(memory.path().c_str(), header.c_str(), MAT_FT_MAT5));
    if (!file) throw core::DataError("matio cannot create a MAT file in memory");
    for (const MatVariable& variable : variables) {
      require_writable(variable);
      const Variable stored = encoded(variable);
      if (!stored || Mat_VarWrite(file.get(), stored.get(), MAT_COMPRESSION_NONE) != 0) {
        throw core::DataError("matio cannot encode the variable " + variable.name);
      }
    }
  }
  require_written(memory.path(), header, variables);
  core::write_file_atomically(path, core::read_file(memory.path()));
}

MatVariables read_mat_variables(const std::filesystem::path& path, const std::vector<std::string>& names) {
  return in_memory(path, [&] {
    const MatVersion version = mat_version_of_file(path);
    if (version == MatVersion::four) return mat4_variables(core::read_file(path), names, path.string());
    const std::size_t most_bytes =
        version == MatVersion::hdf5 ? most_bytes_within(path) : require_whole_mat5(core::read_file(path), path);
    const MatFile file(Mat_Open(path.c_str(), MAT_ACC_RDONLY));
    if (!file) fail_in(path, "cannot be read as a MAT file; write it again by save(…, '-v7')");
    MatVariables variables;
    for (const std::string& name : names) {
      const Variable stated(Mat_VarReadInfo(file.get(), name.c_str()));
      if (!stated) continue;
      require_entries_within(*stated, most_bytes, name, path);
      const Variable stored(Mat_VarRead(file.get(), name.c_str()));
      if (stored) variables.emplace(name, decoded(*stored, name, path));
    }
    return variables;
  });
}

std::vector<std::string> mat_variable_names(const std::filesystem::path& path) {
  const MatVersion version = mat_version_of_file(path);
  if (version != MatVersion::five && version != MatVersion::hdf5) return {};
  return in_memory(path, [&] {
    if (version == MatVersion::five) (void)require_whole_mat5(core::read_file(path), path);
    const MatFile file(Mat_Open(path.c_str(), MAT_ACC_RDONLY));
    std::size_t count = 0;
    char** const directory = file ? Mat_GetDir(file.get(), &count) : nullptr;
    return directory == nullptr ? std::vector<std::string>() : std::vector<std::string>(directory, directory + count);
  });
}

const MatVariable& variable(const MatVariables& variables, const std::string& name, const std::filesystem::path& path) {
  const auto found = variables.find(name);
  if (found == variables.end()) fail_in(path, "has no variable " + name);
  return found->second;
}

MatVariable mat_matrix(const std::string& name, const Eigen::MatrixXd& matrix) {
  return {name,
          {static_cast<std::size_t>(matrix.rows()), static_cast<std::size_t>(matrix.cols())},
          {matrix.data(), matrix.data() + matrix.size()}};
}

MatVariable mat_sparse(const std::string& name, const Eigen::SparseMatrix<double>& matrix) {
  MatVariable result{name, {static_cast<std::size_t>(matrix.rows()), static_cast<std::size_t>(matrix.cols())}, {}};
  result.is_sparse = true;
  result.sparse = matrix;
  result.sparse.makeCompressed();
  return result;
}

Eigen::SparseMatrix<double> sparse_of(const MatVariable& variable, const std::filesystem::path& path) {
  Eigen::SparseMatrix<double> sparse;
  if (variable.is_sparse) {
    sparse = variable.sparse;
  } else {
    sparse = matrix_of(variable, path).sparseView(0.0, 0.0);
  }
  sparse.prune([](Eigen::Index, Eigen::Index, double value) { return value != 0.0; });
  return sparse;
}

Eigen::MatrixXd matrix_of(const MatVariable& variable, const std::filesystem::path& path, Eigen::Index rows,
                          Eigen::Index columns) {
  const std::string name = "the variable " + variable.name;
  if (variable.size.size() != 2 || !variable.im.empty() || !variable.texts.empty() || variable.is_sparse) {
    fail_in(path, name + " is not a full real matrix");
  }
  const auto found_rows = static_cast<Eigen::Index>(variable.size[0]);
  const auto found_columns = static_cast<Eigen::Index>(variable.size[1]);
  if ((rows >= 0 && found_rows != rows) || (columns >= 0 && found_columns != columns)) {
    const auto expected = [](Eigen::Index length) { return length >= 0 ? std::to_string(length) : "any"; };
    fail_in(path, name + " is " + std::to_string(found_rows) + " × " + std::to_string(found_columns) + ", expected " +
                      expected(rows) + " × " + expected(columns));
  }
  return Eigen::Map<const Eigen::MatrixXd>(variable.re.data(), found_rows, found_columns);
}

std::vector<MatVariable> dof_variables(const std::string& prefix, const dynamics::DofTable& dofs) {
  Eigen::MatrixXd directions(static_cast<Eigen::Index>(dofs.size()), 3);
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    directions.row(static_cast<Eigen::Index>(i)) = dofs[i].direction.transpose();
  }
  return {text_variable(prefix + "_name", dofs, [](const Dof& dof) { return name(dof); }),
          text_variable(prefix + "_point", dofs, [](const Dof& dof) { return dof.point; }),
          text_variable(prefix + "_kind", dofs, [](const Dof& dof) { return kind_word(dof.kind); }),
          text_variable(prefix + "_unit", dofs, [](const Dof& dof) { return unit(dof); }),
          mat_matrix(prefix + "_direction", directions)};
}

std::vector<std::string> dof_variable_names(const std::string& prefix) {
  return {prefix + "_point", prefix + "_kind", prefix + "_direction"};
}

dynamics::DofTable dofs_of(const MatVariables& variables, const std::string& prefix, Eigen::Index count,
                           const std::filesystem::path& path) {
  const MatVariable& points = variable(variables, prefix + "_point", path);
  const MatVariable& kinds = variable(variables, prefix + "_kind", path);
  for (const MatVariable* texts : {&points, &kinds}) {
    if (texts->texts.size() == static_cast<std::size_t>(count)) continue;
    fail_in(path, "the variable " + texts->name + " is not a cell array of " + std::to_string(count) + " × 1 texts");
  }
  const Eigen::MatrixXd axes = matrix_of(variable(variables, prefix + "_direction", path), path, count, 3);
  dynamics::DofTable dofs;
  for (std::size_t i = 0; i < points.texts.size(); ++i) {
    dofs.push_back(
        {points.texts[i], axes.row(static_cast<Eigen::Index>(i)).transpose(), kind_of(kinds.texts[i], path)});
  }
  return dofs;
}

}  // namespace thinwall::io
