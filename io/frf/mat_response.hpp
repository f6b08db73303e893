#pragma once
// FRFs in MAT files of version 5, for MATLAB, Octave and SciPy, and from measuring programs that export them.

#include <filesystem>
#include <string>

#include "dynamics/dof.hpp"
#include "io/frf/frf_quantity.hpp"
#include "io/frf/measured_response.hpp"

namespace thinwall::io {

/// Writes frequency_hz (lines × 1), H (responses × forces × lines, complex, receptance in m/N, rad/N, m/(N m) or rad/(N
/// m)), also coherence if every entry has one (the same shape, real), and the tables of DOFs: response_name ("P.x"),
/// response_point, response_kind, response_unit (cell arrays), response_direction (n × 3), and the same with force_.
/// The bytes depend on the model only. The file is written in one step. Throws InputError if shapes disagree, a value
/// is not finite, only some entries have a coherence, or H exceeds the 2 GiB of the format; DataError if the file
/// cannot be written.
void write_mat_response(const std::filesystem::path& path, const MeasuredResponse& measured);

/// Reads a file of write_mat_response(), bit by bit. Throws DataError that names the file and the variable that is
/// missing, of another shape or out of range.
[[nodiscard]] MeasuredResponse read_mat_response(const std::filesystem::path& path);

/// The names of the variables in the file of a measuring program.
struct MatFrfNames {
  std::string frequency;    ///< a vector of n lines
  std::string frf;          ///< complex array: n numbers, or with responses and forces as below
  std::string coherence{};  ///< real array of the same shape; empty: none
};

/// Reads FRFs as plain variables, whose meaning the caller states. The array has two or three dimensions: responses ×
/// forces × lines, lines × responses × forces, or, for a single response or a single force, lines × entries or entries
/// × lines. A line at 0 Hz of a mobility or accelerance is left out and noted. Throws InputError if responses or forces
/// are empty; DataError that names file and variable for a shape that fits none of these, or several of them with
/// different results, for frequencies that do not rise, and for a coherence outside of 0 to 1.
[[nodiscard]] MeasuredResponse read_mat_frf(const std::filesystem::path& path, const MatFrfNames& names,
                                            const FrfFormat& format, const dynamics::DofTable& responses,
                                            const dynamics::DofTable& forces);

/// One FRF of a MAT file of any program: `frequency` names a real vector, `frf` a vector with as many numbers ("H00"),
/// or an entry of an array with the place of its lines as a colon and the other indices from 1, as MATLAB writes it
/// ("H(2,1,:)", "FRF(:,3)").
struct MatEntryNames {
  std::string frequency;
  std::string frf;
};

/// Reads one FRF and converts it to receptance. A line at 0 Hz of a mobility or accelerance is left out and noted.
/// Throws InputError for a text that is neither a name nor an entry; DataError that names file and variable for one
/// that is missing, has other dimensions than indices or another number of lines than there are frequencies, for an
/// index beyond its dimension, and for frequencies that do not rise.
[[nodiscard]] MeasuredEntries read_mat_entry(const std::filesystem::path& path, const MatEntryNames& names,
                                             const FrfFormat& format);

}  // namespace thinwall::io
