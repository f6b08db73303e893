#pragma once
// The content of a case file, in SI and typed (frequencies in Hz, spindle speeds in rpm, as their names tell).
// Every key is described in case/schema/schema.cpp and docs/case-file.md. A run does what the case holds.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "case/urdf_arm.hpp"
#include "case/values.hpp"
#include "setup/machining_setup.hpp"

namespace thinwall::cases {

/// A data file that a case names.
struct DataFile {
  std::filesystem::path path;
  std::string section;  ///< of the case that names it: "part", "robot", "contacts", "tool", "observed", "damping"
  std::string sha256;   ///< of its bytes, in hexadecimal digits, as they were when the case was loaded
};

/// A set-up with the text that it was written as, and what its data files hold.
struct Case : setup::Setup {
  std::string name;  ///< name of the case's folder
  std::string title;
  std::filesystem::path file;
  std::filesystem::path folder;  ///< where relative names of data files start
  std::string source;            ///< text of the file, as read
  CaseValues values;             ///< what all of the above was bound from, defaults included
  std::vector<DataFile> data_files;
  std::shared_ptr<const UrdfArm> urdf_arm;  ///< as robot.urdf and robot.joints give it, upright at the origin
};

/// The data files that a set-up names, besides the case file itself, with their sections and without checksums.
[[nodiscard]] std::vector<DataFile> named_files(const setup::Setup& source);

/// The paths of the data files that the case names.
[[nodiscard]] std::vector<std::filesystem::path> input_files(const Case& source);

}  // namespace thinwall::cases
