#pragma once
// Depths and limits in words.

#include <optional>
#include <string>

#include "report/summary/summary.hpp"

namespace thinwall::report {

/// "13.7 mm".
[[nodiscard]] std::string millimetres(double metres);

/// "tool length" of "tool_length".
[[nodiscard]] std::string in_words(std::string name);

/// The text with a capital letter.
[[nodiscard]] std::string capital(std::string text);

/// True if a row or a point of this `status` is right within its error: converged, stable to the depth limit, or
/// limited by its data.
[[nodiscard]] bool is_sound(const std::string& status);

/// A limiting depth with all that is to be said of it.
struct Limit {
  double depth_m = 0.0;
  std::string at;  ///< " at 1900 rpm", " at every speed"
  bool converged = true;
  std::string of_depth_limit;  ///< what the depth limit is, where the depth is no more than that: "tool length"
  std::string more;            ///< "weakest at position 6 of 7"
  std::string range = {};      ///< ", 95 %: 4.95 to 5.42 mm", of a limit that hangs on what was identified
  std::string provided = {};   ///< " if the contact holds; it is lost above 0.31 mm"
};

/// ", 95 %: 4.95 to 5.42 mm" of a depth with a range by what was identified, else "".
[[nodiscard]] std::string range_text(const std::optional<DepthErrorsSummary>& errors);

/// "stable up to 20 mm at 1900 rpm (tool length)", "not converged: 13.7 mm at 1900 rpm".
[[nodiscard]] std::string text_of(const Limit& limit);

/// The text of a limit that follows another of the same speed: "20 mm (tool length)".
[[nodiscard]] std::string short_text_of(const Limit& limit);

/// Of a chart of summary.json: at the case's speed, else its least depth. `cutting` says what the depth limit is.
[[nodiscard]] Limit limit_of_chart(const LobesSummary& chart, const std::optional<CuttingSummary>& cutting);

/// Of a path of summary.json, over all positions.
[[nodiscard]] Limit limit_of_path(const PathSummary& path, const std::optional<CuttingSummary>& cutting);

}  // namespace thinwall::report
