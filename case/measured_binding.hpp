#pragma once
// Measured FRFs and the sensors that sat there meanwhile, typed: of the part, the robot, the tool, a contact.

#include <filesystem>
#include <vector>

#include "case/table.hpp"
#include "setup/measured_frf.hpp"

namespace thinwall::cases {

/// One measured FRF; data files are in `folder`.
[[nodiscard]] setup::MeasuredFrf bind_measured(const Table& table, const std::filesystem::path& folder);

/// The FRFs of an array of tables, in order.
[[nodiscard]] std::vector<setup::MeasuredFrf> bind_all_measured(const std::vector<Table>& tables,
                                                                const std::filesystem::path& folder);

/// The sensors of an array of tables, in order.
[[nodiscard]] std::vector<setup::Sensor> bind_sensors(const std::vector<Table>& tables);

}  // namespace thinwall::cases
