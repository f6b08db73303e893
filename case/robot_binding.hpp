#pragma once
// [robot], typed.

#include <vector>

#include "case/machining_case.hpp"
#include "case/table.hpp"

namespace thinwall::cases {

/// The robot of [robot] with the model that is chosen. Data files are in `folder`. An arm's world is the part's axes;
/// one whose URDF cannot be read has no links (check_robot() says why).
[[nodiscard]] setup::Robot bind_robot(const Table& table, const std::filesystem::path& folder);

/// The chains of [[robot.elements]]. Throws InputError for a section that no beam has.
[[nodiscard]] std::vector<robot::Chain> bind_chains(const Table& robot);

/// The arm of robot.urdf where the case stands it. Errors as urdf_arm().
[[nodiscard]] robot::SerialArm bind_urdf(const Table& robot, const std::filesystem::path& folder);

/// [[robot.modes]] or [[tool.modes]].
[[nodiscard]] std::vector<setup::TipMode> bind_modes(const std::vector<Table>& tables);

}  // namespace thinwall::cases
