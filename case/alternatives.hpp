#pragma once
// The alternatives of a case: which of a shape, a model, a law is chosen, and which keys belong to others.

#include <string>
#include <utility>
#include <vector>

#include "case/schema/schema.hpp"
#include "case/values.hpp"

namespace thinwall::cases {

/// True unless the table of belongings says that the key or table at `path` ("contacts[1].ball") belongs to another
/// alternative than the one that the values choose. An alternative that is not known yet, or could not be read, is
/// taken for the right one. Linear in the values.
[[nodiscard]] bool fits_alternative(const Schema& schema, const CaseValues& values, const std::string& path);

/// The word that the other keys which are given tell of the chooser of that pattern; "" if none of them does.
[[nodiscard]] std::string told_word(const Schema& schema, const CaseValues& values, std::string_view chooser);

/// Every key that is given beside an alternative to which it does not belong, and every key that the chosen alternative
/// needs and that is not there: the key with what is wrong, where it belongs, what is chosen, and the remedy. A table
/// counts as one key.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> faults_of_alternatives(const Schema& schema,
                                                                                      const CaseValues& values);

}  // namespace thinwall::cases
