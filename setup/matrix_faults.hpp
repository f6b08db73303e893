#pragma once
// Which file of imported matrices is at fault, and where in it.

#include "setup/machining_setup.hpp"

namespace thinwall::setup {

/// Throws DataError with file, DOF and remedy if a matrix is asymmetric or has a negative number on its diagonal, which
/// no part alone has (dynamics::require_plausible()). `matrices` is what the files hold.
void require_plausible_files(const io::MatrixFiles& files, const dynamics::SparseModel& matrices);

/// Throws DataError with file, DOF and remedy if K, M or C of an imported part, in SI, is indefinite. Cost:
/// factorisations of each (reduction/trust/sparse_report.hpp), for when the modes were not found.
void require_definite_files(const io::MatrixFiles& files, const dynamics::SparseModel& matrices);

}  // namespace thinwall::setup
