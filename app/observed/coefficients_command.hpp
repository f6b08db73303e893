#pragma once
// `thinwall coefficients`: cutting coefficients from measured mean forces.

#include <string>

namespace thinwall::app {

/// The words of the command.
struct CoefficientsRequest {
  std::string forces;  ///< CSV, a line a cut
  int teeth = 0;
  std::string diameter;     ///< "10 mm"; needed where radial depths are given
  std::string on = "tool";  ///< or part: of what the forces were measured, whose signs are opposite
};

/// Reads the table and fits (learning/mean_force_fit.hpp). Its columns: feed_per_tooth_mm or _m; depth_mm or _m;
/// force_feed_n, force_normal_n, force_axis_n or the same in kn; and, where cuts are no slots, radial_depth_mm or _m
/// with milling (up, down). Returns the text for the terminal, with [cutting] for a case. Throws UsageError for options
/// that cannot be read, DataError for columns, and as learning::fit_mean_forces().
[[nodiscard]] std::string coefficients_of(const CoefficientsRequest& request);

}  // namespace thinwall::app
