#include "app/observed/validate_command.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
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
    if (core::read_file(path / "case.toml").find("[[observed]]") == std::string::npos) continue;
    list.push_back(cases::read_case(path));
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
  const std::string page = report::validation_page(all);
  if (request.check) {
    result.page_is_true = holds(request.page, page);
    result.text += result.page_is_true ? request.page + " is what the cases give\n"
                                       : request.page +
                                             " differs from what the cases give now; write it anew without "
                                             "--check\n";
    return result;
  }
  const fs::path pictures = fs::path(request.page).parent_path() / "pictures";
  fs::create_directories(pictures);
  for (const report::ValidatedCase& one : all)
    core::write_file_atomically(pictures / report::chart_name(one), report::validation_chart(one));
  core::write_file_atomically(request.page, page);
  result.text += "wrote " + request.page + "\n";
  return result;
}

}  // namespace thinwall::app
