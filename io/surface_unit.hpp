#pragma once
// The unit of length of a surface or mesh file. The formats, except STEP, do not contain it, and it has no default.

#include <string>

namespace thinwall::io {

/// Metres in one unit of length, from "mm", "inch" or any other that core::parse_unit() knows: "mm" gives 1e-3. `file`
/// is for the message. Throws InputError if the text is empty, unknown or no length.
[[nodiscard]] double metres_per_unit(const std::string& unit, const std::string& file);

/// Throws InputError unless metres_per_unit is finite and positive. `file` is for the message.
void require_metres_per_unit(double metres_per_unit, const std::string& file);

}  // namespace thinwall::io
