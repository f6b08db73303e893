#pragma once
// MAT files as plain variables, which MATLAB, Octave, SciPy and measuring programs exchange.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <filesystem>
#include <map>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "dynamics/dof.hpp"

namespace thinwall::io {

/// An array of numbers, first index fastest, a cell array n × 1 of texts, or a real sparse matrix (`re` is then empty).
/// `im` is empty if the array is real.
struct MatVariable {
  std::string name;
  std::vector<std::size_t> size;
  std::vector<double> re;
  std::vector<double> im{};
  std::vector<std::string> texts{};
  bool is_sparse = false;
  Eigen::SparseMatrix<double> sparse{};
};

/// Variables by name.
using MatVariables = std::map<std::string, MatVariable>;

/// Throws DataError "path: cause".
[[noreturn]] void fail_in(const std::filesystem::path& path, const std::string& cause);

/// The result of `read`. Throws DataError, with the path, if a damaged file states sizes that exceed the memory.
template <typename Read>
auto in_memory(const std::filesystem::path& path, const Read& read) {
  constexpr const char* cause = "states more than the memory holds: it is damaged, or too large; write it again";
  try {
    return read();
  } catch (const std::bad_alloc&) {
    fail_in(path, cause);
  } catch (const std::length_error&) {
    fail_in(path, cause);
  }
}

/// Writes the variables in their order; the file begins with "MATLAB 5.0 MAT-file, " and `title` (100 bytes at most).
/// The bytes depend on the arguments only. The file is written in one step. Throws InputError if a value is not finite,
/// a text is not UTF-8, or a variable exceeds the 2 GiB of the format; DataError if the file cannot be written.
void write_mat_variables(const std::filesystem::path& path, const std::string& title,
                         const std::vector<MatVariable>& variables);

/// Reads those of the named variables that the file contains: arrays of numbers of any type (whole ones beyond 2⁵³ are
/// rounded), real sparse matrices of doubles, cell arrays of texts. Files of version 4 (mat4.hpp) and of version
/// 7.3 (HDF5) are read, too. Throws DataError that names the file, and the variable if it is of another kind, contains
/// NaN or infinity or states more entries than the file can contain; and for a truncated file.
[[nodiscard]] MatVariables read_mat_variables(const std::filesystem::path& path, const std::vector<std::string>& names);

/// The names of the variables of a file of version 5 or 7.3, in their order, for messages; none of other files.
[[nodiscard]] std::vector<std::string> mat_variable_names(const std::filesystem::path& path);

/// The variable of that name. Throws DataError "path: has no variable name" if there is none.
[[nodiscard]] const MatVariable& variable(const MatVariables& variables, const std::string& name,
                                          const std::filesystem::path& path);

/// A variable from a real matrix.
[[nodiscard]] MatVariable mat_matrix(const std::string& name, const Eigen::MatrixXd& matrix);

/// A variable from a sparse matrix.
[[nodiscard]] MatVariable mat_sparse(const std::string& name, const Eigen::SparseMatrix<double>& matrix);

/// The variable, sparse or full, as a sparse matrix without zeros. Throws DataError if it is of another kind.
[[nodiscard]] Eigen::SparseMatrix<double> sparse_of(const MatVariable& variable, const std::filesystem::path& path);

/// The variable as a real matrix rows × columns (−1: any number). Throws DataError if it is of another shape.
[[nodiscard]] Eigen::MatrixXd matrix_of(const MatVariable& variable, const std::filesystem::path& path,
                                        Eigen::Index rows = -1, Eigen::Index columns = -1);

/// A table of DOFs as variables: cell arrays <prefix>_name ("P.x"), <prefix>_point, <prefix>_kind ("translation",
/// "rotation", "modal"), <prefix>_unit, all n × 1, and <prefix>_direction, n × 3.
[[nodiscard]] std::vector<MatVariable> dof_variables(const std::string& prefix, const dynamics::DofTable& dofs);

/// The names of the variables of a table, for read_mat_variables().
[[nodiscard]] std::vector<std::string> dof_variable_names(const std::string& prefix);

/// The table from its variables. Throws DataError if one is missing or has another number of rows than `count`.
[[nodiscard]] dynamics::DofTable dofs_of(const MatVariables& variables, const std::string& prefix, Eigen::Index count,
                                         const std::filesystem::path& path);

}  // namespace thinwall::io
