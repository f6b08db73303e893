#pragma once
// [simulation], typed.

#include <optional>

#include "case/machining_case.hpp"
#include "case/table.hpp"

namespace thinwall::cases {

/// Points that cannot be read are left out; the checks report them. `lobes` gives the map's range.
[[nodiscard]] setup::Simulation bind_simulation(const Table& table, const std::optional<setup::LobesOptions>& lobes);

}  // namespace thinwall::cases
