#pragma once
// A ResponseModel as a Universal File, the text format that modal-analysis programs exchange FRFs in.
//
// Layout: "Universal File Datasets Summary" (SDRC, I-DEAS Test; data set 58 as of 23-Apr-1993), whose FORMAT statements
// give the columns. Records of text are filled with blanks to their full width.

#include <filesystem>

#include "dynamics/response_model.hpp"

namespace thinwall::io {

/// Writes data sets 151 (header) and 164 (units: SI), then one data set 58 (ASCII, complex double precision) an entry,
/// row by row: function type 4 (FRF), frequency (18) in Hz, displacement (8) in m or rad over excitation force (13) in
/// N or N m, e^{+iωt}.
///
/// Points are numbered as nodes in the order in which they appear, responses first; directions are ±1…±3 (translation
/// along ±x, ±y, ±z), ±4…±6 (rotation) or 0 (any other direction). ID lines: 1 "receptance at <point>", 2 "force at
/// <point>", 3 "NONE", 4 "response <direction>", 5 "force <direction>", both as unit vectors in the part's axes to the
/// last bit. There are no dates: the bytes depend on the model only.
///
/// What the format keeps: 13 significant digits of every value (E20.12), six of a frequency (E13.5). The abscissa is
/// written as even, first frequency and step, where these two in six digits give every line back (relative 1e-12), else
/// line by line, rounded to six digits. Cost O(entries · lines).
///
/// Written in one step. Throws InputError if a shape disagrees with the DOF tables or is empty, a DOF is a modal
/// amplitude, a point's name is empty, longer than 66 bytes or holds control characters or outer blanks, or two
/// frequencies are one in six digits; NumericalError for an entry or a frequency that is not finite (named); DataError
/// if the file cannot be written.
void write_uff(const std::filesystem::path& path, const dynamics::ResponseModel& model);

/// Reads what write_uff wrote, within the digits above; trailing blanks may be absent or more, and data sets of other
/// kinds are passed over. Throws DataError with the file and its line: no number where one belongs, another function
/// or unit, an entry that is absent or there twice, entries on different frequencies.
[[nodiscard]] dynamics::ResponseModel read_uff(const std::filesystem::path& path);

}  // namespace thinwall::io
