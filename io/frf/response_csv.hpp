#pragma once
// A ResponseModel as a table that people can plot and that comes back exactly.

#include <filesystem>

#include "dynamics/response_model.hpp"

namespace thinwall::io {

/// Writes one line a frequency: frequency_hz, then real and imaginary part of every entry, row by row, in m/N (rad/N,
/// m/(N m), rad/(N m)). Comment lines carry the DOF tables (role, kind, direction, point), the header names each entry
/// as "re P.x/Q.y m/N" (response P.x, force Q.y). A single entry can be read back by read_frf, too. Written in one
/// step. Throws InputError if a shape disagrees with the DOF tables or a point's name is empty or holds control
/// characters or outer blanks, NumericalError for an entry that is not finite (named), DataError if the file cannot be
/// written.
void write_response(const std::filesystem::path& path, const dynamics::ResponseModel& model);

/// Reads what write_response wrote, to the last bit. Throws DataError with the file and its line.
[[nodiscard]] dynamics::ResponseModel read_response(const std::filesystem::path& path);

}  // namespace thinwall::io
