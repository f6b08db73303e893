#pragma once
// [lobes], [[observed]], [calibration], [machine] and [path], typed.

#include <filesystem>
#include <optional>
#include <vector>

#include "case/machining_case.hpp"
#include "case/table.hpp"

namespace thinwall::cases {

/// `tool` gives the depth limit where the table does not.
[[nodiscard]] setup::LobesOptions bind_lobes(const Table& table, const std::optional<setup::Tool>& tool);

/// The cuts that were made; those of a file are empty until it is read. `folder` is put before relative names.
[[nodiscard]] std::vector<setup::ObservedCuts> bind_observed(const std::vector<Table>& tables,
                                                             const std::filesystem::path& folder);

/// The calibration of the chart by these cuts.
[[nodiscard]] setup::Calibration bind_calibration(const Table& table);

/// The limits of the machine; those that the table does not give stay without bound.
[[nodiscard]] milling::MachineLimits bind_machine(const Table& table);

/// Positions as they are listed, or evenly on the line; none where the path could not be read.
[[nodiscard]] setup::Path bind_path(const Table& table);

}  // namespace thinwall::cases
