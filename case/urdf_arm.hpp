#pragma once
// An arm from a URDF and the file that tells of its joints what a URDF does not.

#include <filesystem>
#include <string>
#include <vector>

#include "robot/serial_arm.hpp"

namespace thinwall::cases {

/// The arm of a URDF, and a sentence for each joint beside its chain whose place nobody has stated.
struct UrdfArm {
  robot::SerialArm arm;
  std::vector<std::string> assumed;
};

/// Links and tip from `urdf`, between the links called `base` and `tip` (io/urdf.hpp), the joints from `joints`, a TOML
/// file with a [[joints]] for each that moves between them, and for those that stand at a stated place. The arm stands
/// at the origin, upright. Throws DataError as io::read_urdf and for a file that cannot be read, CaseError with every
/// problem of `joints`, InputError for a joint that only one of the files has, or without its stiffness.
[[nodiscard]] UrdfArm urdf_arm(const std::filesystem::path& urdf, const std::string& base, const std::string& tip,
                               const std::filesystem::path& joints);

}  // namespace thinwall::cases
