#pragma once
// [robot], typed.

#include <vector>

#include "app/case.hpp"
#include "app/case_table.hpp"

namespace thinwall::app {

/// `measured`: its FRF files, bound as those of the part and the tool. An arm's world is the part's axes.
[[nodiscard]] Robot bind_robot(const Table& table, std::vector<MeasuredFrf> measured);

/// [[robot.modes]] or [[tool.modes]].
[[nodiscard]] std::vector<TipMode> bind_modes(const std::vector<Table>& tables);

}  // namespace thinwall::app
