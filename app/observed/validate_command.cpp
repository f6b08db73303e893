#include "app/observed/validate_command.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <regex>
#include <utility>
#include <vector>

#include "app/log.hpp"
#include "case/reader.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "report/lobes/observed_summary.hpp"
#include "report/result_folder.hpp"
#include "report/validation/validation_chart.hpp"
#include "report/validation/validation_page.hpp"

namespace thinwall::app {

namespace {

namespace fs = std::filesystem;

/// False of the text of a case that has neither [[observed]] nor `observed =`, however they are spaced.
bool may_have_cuts(const std::string& text) {
  static const std::regex written(R"(\[\[\s*"?observed"?\s*\]\]|(^|\n)\s*"?observed"?\s*=)");
  return std::regex_search(text, written);
}

/// The cases of a folder that have cuts, in the order of their names.
std::vector<cases::Case> cases_with_cuts(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw core::InputError("there is no folder \"" + folder.string() + "\"; name one that holds cases");
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (fs::exists(entry.path() / "case.toml")) paths.push_back(entry.path());
  }
  std::ranges::sort(paths);
  std::vector<cases::Case> list;
  for (const fs::path& path : paths) {
    // Most cases have none, and reading one may mean reading a mesh.
    if (!may_have_cuts(core::read_file(path / "case.toml"))) continue;
    cases::Case source = cases::read_case(path);
    if (!source.observed.empty()) list.push_back(std::move(source));
  }
  if (list.empty())
    throw core::InputError("no case in \"" + folder.string() + "\" has [[observed]]; add the cuts that were made");
  return list;
}

/// The text of README.md beside a case; empty if there is none.
std::string readme_of(const cases::Case& source) {
  const fs::path file = source.folder / "README.md";
  return fs::exists(file) ? core::read_file(file) : "";
}

report::ValidatedCase validated(const cases::Case& source, const RunCase& run_case) {
  report::ResultFolder folder(report::default_result_folder(source.name));
  log_to_file(folder.path() / "run.log");
  RunOptions options;
  options.out = folder.path();
  options.held = &folder;
  const RunResult run = run_case(source, options);
  return {source.name, run.summary, readme_of(source), folder.path()};
}

/// True if the file has that text.
bool holds(const fs::path& file, const std::string& text) {
  return fs::exists(file) && core::read_file(file) == text;
}

fs::path pictures_of(const fs::path& page) {
  return page.parent_path() / "pictures";
}

/// The text of not-held.md of the folder of cases, which ends the page: sets that lack what a case needs. Empty if
/// there is none.
std::string sets_not_held(const fs::path& cases) {
  const fs::path file = cases / "not-held.md";
  return fs::exists(file) ? "\n" + core::read_file(file) : "";
}

/// Paths and texts of the drawings and, last, of the page.
using Files = std::vector<std::pair<fs::path, std::string>>;

Files files_of(const fs::path& cases, const fs::path& page, const std::vector<report::ValidatedCase>& all) {
  Files files;
  for (const report::ValidatedCase& one : all)
    files.emplace_back(pictures_of(page) / report::chart_name(one), report::validation_chart(one));
  files.emplace_back(page, report::validation_page(all) + sets_not_held(cases));
  return files;
}

}  // namespace

Validation validate_cases(const ValidateRequest& request, const RunCase& run_case) {
  std::vector<report::ValidatedCase> all;
  Validation result;
  for (const cases::Case& source : cases_with_cuts(request.cases)) {
    all.push_back(validated(source, run_case));
    const report::ObservedSummary* observed = report::observed_of(all.back());
    if (observed != nullptr)
      result.text += fmt::format("  {:<26} {}\n", source.name, report::share_text(observed->prediction));
  }
  const Files files = files_of(request.cases, request.page, all);
  if (request.check) {
    for (const auto& [file, text] : files) {
      if (holds(file, text)) continue;
      result.page_is_true = false;
      result.text += file.string() + " differs from what the cases give now; write it anew without --check\n";
    }
    if (result.page_is_true) result.text += request.page + " is what the cases give\n";
    return result;
  }
  fs::create_directories(pictures_of(request.page));
  for (const auto& [file, text] : files) core::write_file_atomically(file, text);
  result.text += "wrote " + request.page + "\n";
  return result;
}

}  // namespace thinwall::app
