#pragma once
// FRFs in Universal Files, the format in which modal-analysis programs exchange them. Files are written by the
// specification, and read with the deviations of real analysers.
//
// Layout: "Universal File Datasets Summary" (SDRC, I-DEAS Test; data set 58 as of 23-Apr-1993), whose FORMAT statements
// give the columns. Records of text are filled with blanks to their full width.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "dynamics/response_model.hpp"
#include "io/frf/frf_quantity.hpp"
#include "io/frf/measured_response.hpp"
#include "io/frf/uff_function.hpp"

namespace thinwall::io {

/// Writes data sets 151 (header) and 164 (units: SI), then one data set 58 for each entry, row by row, as ASCII text in
/// double precision unless `form` says otherwise: function type 4 (FRF), frequency (18) in Hz, displacement (8) in m or
/// rad over excitation force (13) in N or N m, e^{+iωt}.
///
/// Points are numbered as nodes in the order in which they appear, responses first; directions are ±1…±3 (translation
/// along ±x, ±y, ±z), ±4…±6 (rotation) or 0 (any other direction). ID lines: 1 "receptance at <point>", 2 "force at
/// <point>", 3 "NONE", 4 "response <direction>", 5 "force <direction>", both as unit vectors in the part's axes to the
/// last bit. There are no dates, so that the bytes depend on the model only.
///
/// Precision of a value: 13 significant digits (E20.12) or six (E13.5, single precision) as ASCII, all bits of a double
/// or a float as binary. Precision of a frequency: six digits (E13.5) as ASCII, that of the values as binary. The
/// abscissa is written as even, by its first frequency and step, if these two in six digits reproduce every line
/// (relative 1e-12), otherwise line by line. Cost O(entries · lines).
///
/// The file is written in one step. Throws InputError if a shape disagrees with the DOF tables or is empty, a DOF is a
/// modal amplitude, a point's name is empty, longer than 66 bytes or contains control characters or outer blanks, or
/// two frequencies are equal in the digits that are kept; NumericalError, with its name, for an entry or a frequency
/// that is not finite, or beyond single precision if that is asked for; DataError if the file cannot be written.
void write_uff(const std::filesystem::path& path, const dynamics::ResponseModel& model, const UffForm& form = {});

/// Writes the entries, each followed by its coherence if it has one: function type 6 (coherence), ID line 1 "coherence
/// at <point>".
void write_uff(const std::filesystem::path& path, const MeasuredResponse& measured, const UffForm& form = {});

/// Knowledge of the caller about the FRFs in a file. Quantity and units, including that of frequencies, supply what the
/// file does not state, which is noted; a file that contradicts them is refused (io/frf/uff_meaning.hpp).
struct UffReading {
  std::optional<FrfFormat> stated;
};

/// Every FRF of a file as receptance in SI, with its coherence if the file contains it (function type 6 between the
/// same DOFs on the same axis). io/frf/universal_file.hpp lists the faults of analysers that are tolerated,
/// io/frf/uff_meaning.hpp the way in which DOFs, quantity and units are found. A line at 0 Hz of a mobility or
/// accelerance, which has no receptance, is left out; functions of other types and other data sets are skipped; all
/// this is noted. `bytes` is the file, `source` its name for messages. Throws DataError with file and line for a file
/// without FRF, for facts that are missing or contradict each other, values that are not finite, frequencies that do
/// not rise, and a coherence outside of 0 to 1. Cost O(bytes), with memory in proportion.
[[nodiscard]] MeasuredEntries uff_entries(std::string_view bytes, const std::string& source,
                                          const UffReading& reading = {});

/// Every FRF of a file, as uff_entries() gives it.
[[nodiscard]] MeasuredEntries read_uff_entries(const std::filesystem::path& path, const UffReading& reading = {});

/// The FRFs of a file as a matrix: read_uff_entries(), then response_matrix(), with the errors of both.
[[nodiscard]] MeasuredResponse read_uff(const std::filesystem::path& path, const UffReading& reading = {});

}  // namespace thinwall::io
