#pragma once
// What a case file says, in SI and typed (frequencies in Hz, spindle speeds in rpm, as their names tell).
// Every key is described in case/schema.cpp and docs/case-file.md. A run does what the case holds.

#include <filesystem>
#include <string>
#include <vector>

#include "case/values.hpp"
#include "setup/machining_setup.hpp"
#include "setup/variation.hpp"

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

/// The same without those that only the given sections name ("robot", "tool").
[[nodiscard]] std::vector<std::filesystem::path> input_files(const Case& source,
                                                             const std::vector<std::string>& without_sections);

/// Value of a numeric key by its dotted name, "part.length", "damping.ratios[0]", "robot.stiffness", in the unit of the
/// schema (SI; Hz; rpm). Tables in the middle may be left out where that is unambiguous ("part.element_size"). Throws
/// InputError with the nearest key if the case has no such number.
[[nodiscard]] double get_value(const Case& source, const std::string& key);

/// Sets it and binds the case anew, so that everything that follows from the key follows. Throws InputError if the
/// value is not finite or outside the schema's bounds. Cost: microseconds; for model updating and sweeps.
void set_value(Case& target, const std::string& key, double value);

/// Access to the case's numbers for fits: set-ups with other values. The case is copied.
[[nodiscard]] setup::Variation variation_of(const Case& source);

}  // namespace thinwall::cases
