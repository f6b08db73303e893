#pragma once
// Tables of identified modes: frequency, damping, left and right vectors, a line a mode.

#include <filesystem>
#include <string>
#include <vector>

#include "dynamics/modal_table.hpp"

namespace thinwall::io {

/// The place of a point of the table: so far up the tool from its tip, m; one number, or one a line of the file.
struct PointPlace {
  std::string point;
  std::vector<double> place_m;
};

/// The meaning of the numbers of a file. Nothing here has a default: a file states what it holds.
struct ModalTableFormat {
  double left_unit;   ///< the unit of the L columns in √(s/kg)
  double right_unit;  ///< the unit of the R columns in √(s/kg)
  std::vector<PointPlace> places;
};

/// "sqrt(s/kg)" or "1e-7 sqrt(s/kg)" as a number of √(s/kg). Throws InputError for anything else.
[[nodiscard]] double modal_unit(const std::string& text);

/// Reads a file (io/csv_text.hpp tells what a line may look like) whose header names frequency_hz, damping_percent or
/// damping_ratio, optionally mode, and for each DOF a point and one of X, Y, Z: L_1X_re, L_1X_im, R_1X_re, R_1X_im of
/// point 1 along x. Throws DataError, with file and line, for columns that are missing (all are named), doubled or
/// unknown, a frequency that is not positive, a damping ratio outside 0 to 1 (percent in a column of ratios), text,
/// NaN; and InputError for a unit that is not positive, or places that do not fit points and lines. A point whose place
/// is not told has NaN there, and no modal_model() but at_point() takes it.
[[nodiscard]] dynamics::ModalTable read_modal_table(const std::filesystem::path& path, const ModalTableFormat& format);

}  // namespace thinwall::io
