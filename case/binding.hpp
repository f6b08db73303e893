#pragma once
// The typed Case from its values.

#include "case/expectation.hpp"
#include "case/machining_case.hpp"

namespace thinwall::cases {

/// Fills every typed member from the values; `folder` is put before relative file names. A number that could not be
/// read is NaN, a name that could not be read is empty: check_case() passes over those, the reader has reported them.
/// No file is opened: what files hold is empty (case/data_files.hpp).
[[nodiscard]] Case bind_case(CaseValues values, const std::filesystem::path& folder);

/// The expectations that the values of an expected.toml state.
[[nodiscard]] std::vector<Expectation> bind_expectations(const CaseValues& values);

}  // namespace thinwall::cases
