#include "case/joint_binding.hpp"

namespace thinwall::cases {

robot::Joint bind_joint(const Table& table) {
  return {table.number("stiffness"),  table.number("damping"),         table.number("motor_inertia"),
          table.number("gear_ratio"), table.number("servo_stiffness"), table.number("servo_damping")};
}

}  // namespace thinwall::cases
