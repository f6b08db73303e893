#pragma once
// From the text of a case file to a Case.

#include <filesystem>
#include <string>
#include <vector>

#include "case/expectation.hpp"
#include "case/machining_case.hpp"
#include "case/problem.hpp"

namespace thinwall::cases {

/// The case file of a folder, or the file itself. Throws InputError if there is none.
[[nodiscard]] std::filesystem::path case_file(const std::filesystem::path& folder_or_file);

/// Reads and validates a case, and reads every file that it names; nothing is read of these files later. `overrides`
/// are "key=value" as on the command line, put over the file before validation; quotes around quantities may be left
/// out, and tables in the middle of a key where that is unambiguous. Throws CaseError with every problem found, and
/// what setup::read_data_files() throws for files that cannot be read.
[[nodiscard]] Case read_case(const std::filesystem::path& folder_or_file,
                             const std::vector<std::string>& overrides = {});

/// Reads a case from text; data files are looked for in `folder`. `name` is shown in messages. `added` are values of
/// tables that are put behind those of the text, "tool.modes[0].stiffness" in the first that is added; problems of them
/// stand at line 0.
[[nodiscard]] Case parse_case(const std::string& text, const std::filesystem::path& folder,
                              const std::string& name = "case.toml", const std::vector<std::string>& overrides = {},
                              const CaseValues& added = {});

/// The expectations that lie beside the case (expected.toml); none if there is no such file. Throws CaseError.
[[nodiscard]] std::vector<Expectation> read_expectations(const std::filesystem::path& case_file);

}  // namespace thinwall::cases
