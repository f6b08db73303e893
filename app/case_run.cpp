#include "app/case_run.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <ctime>

#include "app/case_files.hpp"
#include "app/doctor.hpp"
#include "app/expectation_checks.hpp"
#include "app/forecast.hpp"
#include "app/log.hpp"
#include "app/signals.hpp"
#include "app/stage_display.hpp"
#include "case/checks/doubts.hpp"
#include "case/expectation.hpp"
#include "case/numbers.hpp"
#include "case/reader.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/messages.hpp"
#include "report/kept_files.hpp"
#include "report/page/page.hpp"
#include "report/publish.hpp"
#include "report/result_files.hpp"
#include "report/summary.hpp"
#include "study/kept/stage_keys.hpp"
#include "study/run.hpp"

namespace thinwall::app {

namespace {

std::string now_utc() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

/// The checkpoint of a stage that points of a sweep have in common: of this result folder, or one of those that several
/// runs share. None for an empty key.
study::Checkpoint shared_checkpoint(const std::string& stage, const std::string& key, const RunOptions& options) {
  if (key.empty()) return {};
  if (options.parts.empty()) return {options.out / "cache" / (stage + ".bin"), key, options.fresh};
  return {options.parts / (stage + "-" + key.substr(0, 16) + ".bin"), key, false};
}

/// The case with the values that the fits found.
cases::Case fitted_case(const cases::Case& source, const study::Results& results) {
  cases::Case fitted = source;
  for (const auto& fit : results.updating) {
    for (const auto& parameter : fit.parameters) cases::set_value(fitted, parameter.key, parameter.fitted);
  }
  return fitted;
}

/// The page is a picture of results that are there; a run does not fail for it.
void write_report(const std::filesystem::path& results, const report::RunAtHand& run,
                  const report::KeptSections& kept) {
  try {
    report::write_page(results / "report.html",
                       {.folders = {results}, .program = app::program_name(), .kept = kept, .at_hand = run});
  } catch (const core::Interrupted&) {
    throw;
  } catch (const core::Error& error) {
    spdlog::warn("report.html was not written: {}", error.what());
  }
}

/// Says the whole time of a run that takes long. A run that finds charts or simulations of an earlier one may take
/// less, and a point of a sweep is one of many. Returns as tell_of_long_run().
std::shared_ptr<const fem::FirstMesh> tell_of_first_run(const cases::Case& source, const RunOptions& options,
                                                        const study::StageListener& on_stage) {
  const std::filesystem::path cache = options.out / "cache";
  const bool known = std::filesystem::exists(cache / "lobes.bin") || std::filesystem::exists(cache / "simulation.bin");
  if ((!options.fresh && known) || !options.parts.empty()) return {};
  on_stage("forecast");
  return tell_of_long_run(source, options.points);
}

report::Summary summary_of(const cases::Case& source, const study::Results& results) {
  report::Summary summary = report::summary_of(results.setup, results);
  summary.case_name = source.name;
  summary.title = source.title;
  return summary;
}

/// The expectations of a case, without those of a simulation that it has and `lobes` leaves out.
std::vector<cases::Expectation> expectations_of(const cases::Case& source) {
  std::vector<cases::Expectation> all = cases::read_expectations(source.file);
  const bool left_out = !source.simulation && std::ranges::any_of(source.values, [](const cases::CaseValue& value) {
    return value.key.starts_with("simulation.");
  });
  if (left_out) std::erase_if(all, [](const auto& expected) { return expected.quantity.starts_with("simulation."); });
  return all;
}

}  // namespace

RunResult run_case(const cases::Case& source, const RunOptions& options) {
  const std::string started = now_utc();
  messages_to_log();
  const auto expectations = expectations_of(source);
  StageDisplay display(options.progress      ? ProgressDisplay::line
                       : options.stage_lines ? ProgressDisplay::lines
                                             : ProgressDisplay::none);
  const auto first_mesh = tell_of_first_run(source, options, display.listener());
  for (const std::string& doubt : cases::doubts_about(source)) core::warn(doubt);
  study::Kept kept{shared_checkpoint("part", source.part ? study::part_key(source) : "", options),
                   {options.out / "cache" / "structure.bin", study::structure_key(source), options.fresh},
                   {options.out / "cache" / "lobes.bin", study::charts_key(source), options.fresh},
                   source.simulation ? study::Checkpoint(options.out / "cache" / "simulation.bin",
                                                         study::simulation_key(source), options.fresh)
                                     : study::Checkpoint(),
                   shared_checkpoint("tool", study::tool_key(source), options),
                   shared_checkpoint("robot", study::robot_key(source), options)};
  study::Results results =
      study::run(source, cases::variation_of(source), kept, {options.points, display.listener(), first_mesh});
  study::Stages stages(display.listener());
  stages.begin("output");
  const auto staging = core::partial_path(options.out / "results");
  if (!report::take_files(kept.structure, options.out, staging)) {
    report::write_structure(staging, results.setup, results);
    report::keep_files(kept.structure, staging);
  }
  report::write_cuts(staging, source, results);
  write_cases(staging, source, fitted_case(source, results));
  stages.begin("report");
  RunResult run{summary_of(source, results), true};
  run.expectations_hold = add_checks(run.summary, expectations);
  if (!run.expectations_hold) run.summary.status = "expectation_not_met";
  const nlohmann::json manifest = manifest_of(source, run.summary, started);
  write_report(staging, {run.summary, manifest}, report::kept_sections(kept.structure));
  stages.end();
  double total = 0.0;
  for (const auto& [stage, seconds] : results.timings_s) total = stage == "total" ? seconds : total;
  for (const auto& [stage, seconds] : stages.timings_s())
    run.summary.timings_s[stage] = stage == "total" ? total + seconds : seconds;
  report::write_summary(staging, run.summary, manifest);
  const Undisturbed publishing;
  if (options.held != nullptr) {
    options.held->publish(staging);
  } else {
    report::publish(staging, options.out);
  }
  return run;
}

}  // namespace thinwall::app
