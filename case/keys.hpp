#pragma once
// A key of what a case says, by which a sweep knows a point that it has run before.

#include <string>
#include <vector>

#include "case/machining_case.hpp"

namespace thinwall::cases {

/// Hash of the program, of the case's values but those under the given keys or sections ("lobes.count", "cutting"), and
/// of the checksums of the files that the other sections name.
[[nodiscard]] std::string key_of(const Case& source, const std::vector<std::string>& without);

}  // namespace thinwall::cases
