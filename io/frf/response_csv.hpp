#pragma once
// A ResponseModel as a table that can be plotted and read back exactly.

#include <filesystem>

#include "dynamics/response_model.hpp"

namespace thinwall::io {

/// Writes one line for each frequency: frequency_hz, then real and imaginary part of every entry, row by row, in m/N
/// (rad/N, m/(N m), rad/(N m)). Comment lines contain the DOF tables (role, kind, direction, point), and the header
/// names each entry as "re P.x/Q.y m/N" (response P.x, force Q.y). A file of a single entry can also be read by
/// read_frf(). The file is written in one step. Throws InputError if a shape disagrees with the DOF tables or a point's
/// name is empty or contains control characters or outer blanks; NumericalError, with its name, for an entry that is
/// not finite; DataError if the file cannot be written.
void write_response(const std::filesystem::path& path, const dynamics::ResponseModel& model);

/// Reads a file of write_response(), bit by bit. Throws DataError with the file and its line.
[[nodiscard]] dynamics::ResponseModel read_response(const std::filesystem::path& path);

}  // namespace thinwall::io
