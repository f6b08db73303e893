#include "case/reader.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "case/binding.hpp"
#include "case/checks/checks.hpp"
#include "case/schema/schema.hpp"
#include "case/toml_values.hpp"
#include "core/atomic_file.hpp"
#include "setup/file_stamps.hpp"
#include "setup/imported_part.hpp"
#include "setup/matrix_faults.hpp"

namespace thinwall::cases {

namespace {

/// The part's file; of matrices that are refused the one at fault is named.
std::shared_ptr<const setup::ImportedPart> read_imported(const setup::Part& part) {
  try {
    return setup::read_part_file(part);
  } catch (const core::InputError&) {
    if (const auto* matrices = std::get_if<setup::MatrixShape>(&part.shape))
      setup::require_plausible_files(matrices->files);
    throw;
  }
}

}  // namespace

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
                const std::vector<std::string>& overrides) {
  ReadValues read = read_values(text, name, case_schema(), overrides);
  Case result = bind_case(std::move(read.values), folder);
  result.source = text;
  auto problems = std::move(read.problems);
  std::ranges::move(check_case(result), std::back_inserter(problems));
  if (!problems.empty()) throw CaseError({name, text, overrides}, std::move(problems));
  setup::stamp_files(result);
  if (!result.part || !setup::from_file(*result.part)) return result;
  result.part->imported = read_imported(*result.part);
  problems = check_case(result);  // what could not be told before its size was known
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
  if (!std::filesystem::exists(file)) return {};
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
