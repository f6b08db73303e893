#pragma once
// [lobes], [machine] and [path], typed.

#include <optional>

#include "case/machining_case.hpp"
#include "case/table.hpp"

namespace thinwall::cases {

/// `tool` gives the depth limit where the table does not.
[[nodiscard]] setup::LobesOptions bind_lobes(const Table& table, const std::optional<setup::Tool>& tool);

/// The limits of the machine; those that the table does not give stay without bound.
[[nodiscard]] milling::MachineLimits bind_machine(const Table& table);

/// Positions as they are listed, or evenly on the line; none where the path could not be read.
[[nodiscard]] setup::Path bind_path(const Table& table);

}  // namespace thinwall::cases
