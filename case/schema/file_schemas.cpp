// The schemas of the files beside a case: joints of a URDF, and expectations.

#include "case/schema/schema.hpp"
#include "case/schema/schema_bounds.hpp"

namespace thinwall::cases {

namespace {

namespace kind = core::kind;
using namespace bounds;

// clang-format off
constexpr Section joint_sections[] = {
    Section{"joints[]", "What a URDF does not know of a joint: the stiffness of one that moves between base and tip, or the place at which a joint stands still. Motors are of joints that turn.", ""},
};
constexpr Key joint_keys[] = {
    Key{"joints[].name", Type::text, kind::number, "", any, "", "Name of the joint in the URDF.", required},
    Key{"joints[].stiffness", Type::quantity, kind::torsional_stiffness, "", positive, "", "Of the gearbox of a joint that turns."},
    Key{"joints[].damping", Type::quantity, kind::torsional_damping, "0", damper, "", "Beside it."},
    Key{"joints[].linear_stiffness", Type::quantity, kind::stiffness, "", positive, "", "Of the drive of a joint that slides."},
    Key{"joints[].linear_damping", Type::quantity, kind::damping, "0", damper, "", "Beside it."},
    Key{"joints[].angle", Type::quantity, kind::angle, "", any, "", "The joint stands still at this angle, on the chain or beside it. Joints beside the chain stand at 0, or at the limit nearest to it, if not given."},
    Key{"joints[].distance", Type::quantity, kind::length, "", any, "", "The joint, which slides, stands still at this distance."},
    Key{"joints[].motor_inertia", Type::quantity, kind::inertia, "0", inertia_bounds, "", "Of the rotor about its shaft."},
    Key{"joints[].gear_ratio", Type::quantity, kind::number, "1", gear_ratio, "", "Turns of the rotor for one of the joint."},
    Key{"joints[].servo_stiffness", Type::quantity, kind::torsional_stiffness, "\"inf\"", {0.0, infinity, false, false, true, "\"inf\" for a locked motor"}, "", "Position gain at the joint; `inf` for a locked motor."},
    Key{"joints[].servo_damping", Type::quantity, kind::torsional_damping, "0", damper, "", "Speed gain at the joint."},
};
constexpr Section expectation_sections[] = {
    Section{"expect[]", "One figure of summary.json: `value` with `tolerance` or `relative`, or a bound.", ""},
};
constexpr Key expectation_keys[] = {
    Key{"expect[].name", Type::text, kind::number, "", any, "", "What it is, for people.", required},
    Key{"expect[].quantity", Type::text, kind::number, "", any, "", "Path into summary.json, `coupling.modes[0].frequency_hz`.", required},
    Key{"expect[].value", Type::quantity, kind::number, "", any, "", "The expected number, in the unit of the summary."},
    Key{"expect[].same_as", Type::text, kind::number, "", any, "", "Path into summary.json of the number that it must equal, in place of `value`."},
    Key{"expect[].tolerance", Type::quantity, kind::number, "", not_negative, "", "Largest deviation, absolute."},
    Key{"expect[].relative", Type::quantity, kind::number, "", not_negative, "", "Largest deviation relative to the value."},
    Key{"expect[].at_least", Type::quantity, kind::number, "", any, "", "Least value."},
    Key{"expect[].at_most", Type::quantity, kind::number, "", any, "", "Largest value."},
    Key{"expect[].origin", Type::text, kind::number, "", any, "", "Where the figure comes from: published (where), analytic, another program (which), recorded.", required},
};
// clang-format on

}  // namespace

const Schema& joints_schema() {
  static constexpr Schema schema{joint_sections, joint_keys};
  return schema;
}

const Schema& expectation_schema() {
  static constexpr Schema schema{expectation_sections, expectation_keys};
  return schema;
}

}  // namespace thinwall::cases
