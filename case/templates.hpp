#pragma once
// Commented cases to start from.

#include <filesystem>
#include <string>
#include <vector>

namespace thinwall::cases {

/// A file that lies beside a template's case.toml.
struct TemplateFile {
  std::string name;
  std::string content;
};

/// Names that case_template() knows: plate, wall, stl-part, robot, frf-only, lobes.
[[nodiscard]] std::vector<std::string> template_names();

/// Text of a commented case.toml that runs as it is, beside template_files(); throws UsageError with the nearest name.
[[nodiscard]] std::string case_template(const std::string& name);

/// The data files that the case reads: a surface in STL, made-up FRFs in CSV; none of most templates. Throws
/// UsageError.
[[nodiscard]] std::vector<TemplateFile> template_files(const std::string& name);

/// Writes case.toml and the files beside it into `folder` (made if need be) and returns the path of case.toml. Throws
/// DataError rather than overwrite any of them; then nothing is written.
std::filesystem::path write_template(const std::string& name, const std::filesystem::path& folder);

}  // namespace thinwall::cases
