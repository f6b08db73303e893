#include "case/reader.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "case/binding.hpp"
#include "case/checks/checks.hpp"
#include "case/checks/findings.hpp"
#include "case/data_files.hpp"
#include "case/material_values.hpp"
#include "case/schema/schema.hpp"
#include "case/toml_values.hpp"
#include "core/atomic_file.hpp"

namespace thinwall::cases {

std::filesystem::path case_file(const std::filesystem::path& folder_or_file) {
  std::error_code ignored;
  auto file = std::filesystem::is_directory(folder_or_file, ignored) ? folder_or_file / "case.toml" : folder_or_file;
  if (!std::filesystem::is_regular_file(file, ignored)) {
    throw core::InputError("no case at \"" + folder_or_file.string() +
                           "\": a case is a folder with a case.toml, or that file; \"thinwall init\" makes one");
  }
  return file;
}

Case parse_case(const std::string& text, const std::filesystem::path& folder, const std::string& name,
                const std::vector<std::string>& overrides, const CaseValues& added) {
  ReadValues read = read_values(text, name, case_schema(), overrides, added);
  fill_in_material(read.values);
  Case result = bind_case(std::move(read.values), folder);
  result.source = text;
  Findings findings{result.values, std::move(read.problems)};
  read_described_files(result, findings);
  std::vector<Problem> problems = findings.problems;
  for (Problem& problem : check_case(result)) {  // what could not be read is not judged, too
    const bool unread = findings.reported(problem.text.substr(0, problem.text.find(": ")));
    if (!unread) problems.push_back(std::move(problem));
  }
  if (!problems.empty()) throw CaseError({name, text, overrides}, std::move(problems));
  if (result.data_files.empty()) return result;
  read_data_files(result);
  problems = check_case(result);  // what could not be told before the files were read
  if (!problems.empty()) throw CaseError({name, text, overrides}, std::move(problems));
  return result;
}

Case read_case(const std::filesystem::path& folder_or_file, const std::vector<std::string>& overrides) {
  const auto file = case_file(folder_or_file);
  Case result = parse_case(core::read_file(file), file.parent_path(), file.string(), overrides);
  result.file = file;
  result.name = std::filesystem::absolute(file).lexically_normal().parent_path().filename().string();
  return result;
}

std::vector<Expectation> read_expectations(const std::filesystem::path& case_file) {
  const auto file = case_file.parent_path() / "expected.toml";
  const auto status = std::filesystem::status(file);
  if (!std::filesystem::exists(status)) return {};
  if (!std::filesystem::is_regular_file(status))
    throw core::InputError(file.string() + " is no plain file; write the expectations in one, or remove it");
  const std::string text = core::read_file(file);
  ReadValues read = read_values(text, file.string(), expectation_schema());
  for (int i = 0; i < array_size(read.values, "expect"); ++i) {
    const std::string item = "expect[" + std::to_string(i) + "]";
    const auto given = [&](const char* key) { return find(read.values, item + key) != nullptr; };
    const bool comparable = given(".value") != given(".same_as") && (given(".tolerance") || given(".relative"));
    const bool both = given(".value") && given(".same_as");
    if (!both && (comparable || given(".at_least") || given(".at_most"))) continue;
    const auto* name = find(read.values, item + ".name");
    read.problems.push_back({name->line, name->column,
                             item + ": give value or same_as with tolerance or relative, or at_least or at_most"});
  }
  if (!read.problems.empty()) throw CaseError({file.string(), text}, std::move(read.problems));
  return bind_expectations(read.values);
}

}  // namespace thinwall::cases
