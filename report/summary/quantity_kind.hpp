#pragma once
// Kinds of the values of summary.json: they say the unit, and how two values are compared.

#include <array>
#include <string>
#include <string_view>

#include "core/words.hpp"

namespace thinwall::report {

/// The kind of a value. A dimensionless number is a ratio, a residual or an error estimate: a residual is what should
/// vanish but for round-off, an error estimate what should vanish under refinement, and of both only their size counts.
enum class Kind {
  text,
  sentence,  ///< says in words what other entries say in numbers
  truth,
  count,
  ratio,
  residual,
  error_estimate,
  length,
  volume,
  angle,
  angle_deg,
  mass,
  frequency,
  spindle_speed,
  force,
  torque,
  power,
  pressure,
  stiffness,
  damping,
  compliance,
  removal_rate,
  time,         ///< of what is computed
  run_time,     ///< of the computation itself, which is another one each time
  of_quantity,  ///< of the kind, and in the unit, that another text of the same entry names
  section       ///< no value, but entries or a list of them
};

/// The unit in which values of a kind are written; empty of what has none or names it elsewhere.
[[nodiscard]] std::string_view unit_of(Kind kind);

/// True of residuals and error estimates, numbers of the size of round-off or of an estimate: two of them agree if both
/// stay small, while a relative comparison would tell nothing.
[[nodiscard]] bool stays_small(Kind kind);

/// True of numbers, whatever their unit.
[[nodiscard]] bool is_number(Kind kind);

/// The kind of a column of the tables (CSV) of a result folder, by its whole name: "error_estimate_relative",
/// "relative_residual". A column of no such name is a quantity that is compared relatively, here a ratio.
[[nodiscard]] Kind kind_of_column(std::string_view name);

}  // namespace thinwall::report

namespace thinwall::core {

template <>
inline constexpr std::array<std::string_view, 26> words<report::Kind>{
    "text",         "sentence", "truth",    "count",       "ratio",     "residual",  "error_estimate",
    "length",       "volume",   "angle",    "angle_deg",   "mass",      "frequency", "spindle_speed",
    "force",        "torque",   "power",    "pressure",    "stiffness", "damping",   "compliance",
    "removal_rate", "time",     "run_time", "of_quantity", "section"};

}  // namespace thinwall::core
