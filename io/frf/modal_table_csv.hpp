#pragma once
// Tables of identified modes: frequency, damping, left and right vectors, one line for each mode.

#include <filesystem>
#include <string>
#include <vector>

#include "dynamics/modal_table.hpp"

namespace thinwall::io {

/// The place of a point of the table as a distance up the tool from its tip, m: one number, or one for each line of the
/// file.
struct PointPlace {
  std::string point;
  std::vector<double> place_m;
};

/// The meaning of the numbers of a file. The units have no default, because the caller must state them.
struct ModalTableFormat {
  double left_unit;   ///< the unit of the L columns in √(s/kg)
  double right_unit;  ///< the unit of the R columns in √(s/kg)
  std::vector<PointPlace> places;
};

/// The unit named by a text such as "sqrt(s/kg)" or "1e-7 sqrt(s/kg)", in √(s/kg). Throws InputError for any other
/// text.
[[nodiscard]] double modal_unit(const std::string& text);

/// Reads a file (in the form that io/csv_text.hpp describes) whose header contains frequency_hz, damping_percent or
/// damping_ratio, optionally mode, and for each DOF a point and one of X, Y, Z: L_1X_re, L_1X_im, R_1X_re, R_1X_im of
/// point 1 along x. Throws DataError, with file and line, for columns that are missing (all are named), repeated or
/// unknown, a frequency that is not positive, a damping ratio outside 0 to 1 (such as percent in a column of ratios),
/// text, NaN; and InputError for a unit that is not positive, or places that do not fit points and lines. A point whose
/// place is not given has NaN there, which robot::at_point() accepts and robot::modal_model() does not.
[[nodiscard]] dynamics::ModalTable read_modal_table(const std::filesystem::path& path, const ModalTableFormat& format);

}  // namespace thinwall::io
