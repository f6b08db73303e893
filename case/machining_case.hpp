#pragma once
// The content of a case file, in SI and typed (frequencies in Hz, spindle speeds in rpm, as their names tell).
// Every key is described in case/schema/schema.cpp and docs/case-file.md. A run does what the case holds.

#include <filesystem>
#include <string>
#include <vector>

#include "case/values.hpp"
#include "setup/machining_setup.hpp"

namespace thinwall::cases {

/// A set-up with the text that it was written as.
struct Case : setup::Setup {
  std::string name;  ///< name of the case's folder
  std::string title;
  std::filesystem::path file;
  std::filesystem::path folder;  ///< where relative names of data files start
  std::string source;            ///< text of the file, as read
  CaseValues values;             ///< what all of the above was bound from, defaults included
};

/// Data files that the case names, besides the case file itself.
[[nodiscard]] std::vector<std::filesystem::path> input_files(const Case& source);

/// The data files without those that only the given sections name ("robot", "tool").
[[nodiscard]] std::vector<std::filesystem::path> input_files(const Case& source,
                                                             const std::vector<std::string>& without_sections);

}  // namespace thinwall::cases
