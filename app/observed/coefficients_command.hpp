#pragma once
// `thinwall coefficients`: cutting coefficients from measured forces.

#include <string>

namespace thinwall::app {

/// The words of the command.
struct CoefficientsRequest {
  std::string forces;  ///< CSV, a line a cut or an angle
  std::string tool;    ///< TOML with [tool] as in a case; empty: the next two
  int teeth = 0;
  std::string diameter;     ///< "10 mm"; needed where radial depths are given
  std::string on = "tool";  ///< or part: of what the forces were measured, whose signs are opposite
};

/// Reads the table and fits mean forces (learning/mean_force_fit.hpp), or with a column angle_deg or angle_rad forces
/// over the angle of the first tooth with the runout (learning/edge_force_fit.hpp). Its columns: feed_per_tooth_mm or
/// _m; depth_mm or _m; force_feed_n, force_normal_n, force_axis_n or the same in kn; and, where cuts are no slots,
/// radial_depth_mm or _m with milling (up, down). Neighbouring lines of one feed, depth and engagement are one record.
/// Returns the text for the terminal, with [cutting] and [tool] for a case. Edge coefficients are per length of edge,
/// which a helix of the tool makes longer than the depth. Throws UsageError for options that cannot be read, DataError
/// for columns, InputError for a tool that is no cylinder or shorter than a cut, and as the fits and
/// cases::read_tool().
[[nodiscard]] std::string coefficients_of(const CoefficientsRequest& request);

}  // namespace thinwall::app
