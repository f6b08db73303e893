#pragma once
// A case as text again, with every default filled in.

#include <string>

#include "case/machining_case.hpp"

namespace thinwall::cases {

/// The resolved case: every key with its value, quantities in SI with their unit, so that nothing depends on the
/// defaults of a later version. Read again it gives the same Case to the last bit, except that data files are named by
/// their absolute path (the copy lies in another folder).
[[nodiscard]] std::string resolved_text(const Case& source);

}  // namespace thinwall::cases
