#include "setup/matrix_faults.hpp"

#include <fmt/format.h>

#include <array>

#include "core/error.hpp"
#include "reduction/trust/sparse_report.hpp"

namespace thinwall::setup {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// The file that holds a matrix: its own, or that of the stiffness.
const std::filesystem::path& matrix_file(const io::MatrixFiles& files, char letter) {
  const std::filesystem::path& own = letter == 'M' ? files.mass : letter == 'C' ? files.damping : files.stiffness;
  return own.empty() ? files.stiffness : own;
}

/// The model with zeros for all matrices but one.
dynamics::SparseModel matrix_alone(const dynamics::SparseModel& model, char letter) {
  dynamics::SparseModel one = model;
  if (letter != 'K') one.K = Matrix(model.size(), model.size());
  if (letter != 'M') one.M = Matrix(model.size(), model.size());
  if (letter != 'C') one.C = Matrix();
  return one;
}

const char* matrix_word(const std::string& letter) {
  return letter == "K" ? "stiffness" : letter == "M" ? "mass" : "damping";
}

}  // namespace

void require_plausible_files(const io::MatrixFiles& files, const dynamics::SparseModel& matrices) {
  for (const char letter : {'K', 'M', 'C'}) {
    try {
      dynamics::require_plausible(matrix_alone(matrices, letter));
    } catch (const core::InputError& error) {
      throw core::DataError(matrix_file(files, letter).string() + ": " + error.what());
    }
  }
}

void require_definite_files(const io::MatrixFiles& files, const dynamics::SparseModel& matrices) {
  reduction::ReducedModelReport report;
  try {
    report = reduction::sparse_report(matrices);
  } catch (const core::Error&) {
    return;  // it tells nothing then
  }
  for (const reduction::MatrixState& matrix : report.matrices) {
    if (!matrix.told || matrix.negative == 0) continue;
    throw core::DataError(fmt::format(
        "{}: the {} matrix is indefinite, which no part alone has: its least eigenvalue is {:.2g} (rows scaled to a "
        "unit diagonal), most at {}; export the matrix again, and check its units and the DOF table",
        matrix_file(files, matrix.name.front()).string(), matrix_word(matrix.name), matrix.least, matrix.place));
  }
}

}  // namespace thinwall::setup
