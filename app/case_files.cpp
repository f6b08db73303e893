#include "app/case_files.hpp"

#include <algorithm>

#include "app/doctor.hpp"
#include "case/writer.hpp"
#include "core/atomic_file.hpp"
#include "core/parallel.hpp"
#include "io/manifest.hpp"

namespace thinwall::app {

namespace fs = std::filesystem;

void write_cases(const fs::path& folder, const cases::Case& source, const cases::Case& fitted) {
  core::write_file_atomically(folder / "case.toml", source.source);
  core::write_file_atomically(folder / "case.resolved.toml", cases::resolved_text(source));
  if (!source.updating.empty()) core::write_file_atomically(folder / "case.fitted.toml", cases::resolved_text(fitted));
}

nlohmann::json manifest_of(const cases::Case& source, const report::Summary& summary, const std::string& started_utc) {
  nlohmann::json manifest;
  manifest["program"] = {{"name", "thinwall"}, {"version", program_version()}, {"built_with", doctor_report()}};
  if (!program_commit().empty()) manifest["program"]["commit"] = program_commit();
  manifest["threads"] = core::thread_count();
  manifest["started_utc"] = started_utc;
  manifest["timings_s"] = summary.timings_s;
  manifest["inputs"] = nlohmann::json::array();
  for (const cases::DataFile& input : source.data_files)
    manifest["inputs"].push_back({{"name", input.path.string()}, {"sha256", input.sha256}});
  manifest["inputs"].push_back({{"name", source.file.string()}, {"sha256", io::sha256(source.source)}});
  const fs::path expected = source.file.parent_path() / "expected.toml";
  if (fs::exists(expected)) {
    manifest["inputs"].push_back({{"name", expected.string()}, {"sha256", io::sha256_of_file(expected)}});
  }
  manifest["seeds"] = nlohmann::json::array();
  const auto drawn = [](const report::LobesSummary& chart) {
    const auto& row = chart.at_case_speed;
    return row && row->error_budget && row->error_budget->sampled;
  };
  if (std::ranges::any_of(summary.lobes, drawn)) manifest["seeds"].push_back(source.lobes->seed);
  return manifest;
}

}  // namespace thinwall::app
