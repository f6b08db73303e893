#pragma once
// An arm from a URDF and the file that tells of its joints what a URDF does not.

#include <filesystem>
#include <string>

#include "robot/serial_arm.hpp"

namespace thinwall::cases {

/// Links and tip from `urdf`, between the links called `base` and `tip` (io/urdf.hpp), the joints from `joints`, a TOML
/// file with a [[joints]] for each of them. The arm stands at the origin, upright. Throws DataError as io::read_urdf
/// and for a file that cannot be read, CaseError with every problem of `joints`, InputError for a joint that only one
/// of the files has.
[[nodiscard]] robot::SerialArm urdf_arm(const std::filesystem::path& urdf, const std::string& base,
                                        const std::string& tip, const std::filesystem::path& joints);

}  // namespace thinwall::cases
