#pragma once
// A joint of a robot from its table.

#include "case/table.hpp"
#include "robot/serial_arm.hpp"

namespace thinwall::cases {

/// Stiffness, damping, motor and servo of a joint, from [[robot.links]] or [[joints]].
[[nodiscard]] robot::Joint bind_joint(const Table& table);

}  // namespace thinwall::cases
