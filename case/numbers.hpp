#pragma once
// The numbers of a case by their keys: read, and replaced by others.

#include <string>

#include "case/machining_case.hpp"
#include "setup/variation.hpp"

namespace thinwall::cases {

/// Value of a numeric key by its dotted name, "part.length", "damping.ratios[0]", "robot.stiffness", in the unit of the
/// schema (SI; Hz; rpm). Tables in the middle may be left out where that is unambiguous ("part.element_size"). Throws
/// InputError with the nearest key if the case has no such number.
[[nodiscard]] double get_value(const Case& source, const std::string& key);

/// Sets it and binds the case anew, so that everything that follows from the key follows; no file is opened. Throws
/// InputError if the value is not finite or outside the schema's bounds. Cost: microseconds; for model updating and
/// sweeps.
void set_value(Case& target, const std::string& key, double value);

/// Access to the case's numbers for fits: set-ups with other values. The case is copied.
[[nodiscard]] setup::Variation variation_of(const Case& source);

}  // namespace thinwall::cases
