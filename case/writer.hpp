#pragma once
// A case as text again, with every default filled in.

#include <filesystem>
#include <string>

#include "case/machining_case.hpp"

namespace thinwall::cases {

/// Values as text, table by table, quantities in SI with their unit; `folder` is put before relative file names.
[[nodiscard]] std::string values_text(const CaseValues& values, const std::filesystem::path& folder);

/// The resolved case: every key with its value, quantities in SI with their unit, so that nothing depends on the
/// defaults of a later version. Read again it gives the same Case to the last bit, except that data files are named by
/// their absolute path (the copy lies in another folder).
[[nodiscard]] std::string resolved_text(const Case& source);

}  // namespace thinwall::cases
