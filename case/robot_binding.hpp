#pragma once
// [robot], typed.

#include <vector>

#include "case/machining_case.hpp"
#include "case/table.hpp"

namespace thinwall::cases {

/// The robot of [robot] with the model that is chosen. Data files are in `folder`. An arm's world is the part's axes;
/// one of a URDF has no links until that is read (case/data_files.hpp).
[[nodiscard]] setup::Robot bind_robot(const Table& table, const std::filesystem::path& folder);

/// The chains of [[robot.elements]]. Throws InputError for a section that no beam has.
[[nodiscard]] std::vector<robot::Chain> bind_chains(const Table& robot);

/// An arm with what the case says of it beside its links: counterbalances, base, tip and gravity. `arm` stands upright
/// at the origin.
[[nodiscard]] robot::SerialArm arm_in_place(const Table& robot, robot::SerialArm arm);

/// [[robot.modes]] or [[tool.modes]].
[[nodiscard]] std::vector<setup::TipMode> bind_modes(const std::vector<Table>& tables);

}  // namespace thinwall::cases
