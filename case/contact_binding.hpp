#pragma once
// [[contacts]], typed.

#include <filesystem>
#include <vector>

#include "case/table.hpp"
#include "setup/contact.hpp"

namespace thinwall::cases {

/// The contacts in the order of the file, each with the model that is chosen; data files are in `folder`.
[[nodiscard]] std::vector<setup::SupportContact> bind_contacts(const std::vector<Table>& tables,
                                                               const std::filesystem::path& folder);

}  // namespace thinwall::cases
