#include "app/simulate_command.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "app/forecast.hpp"
#include "app/lobes_input.hpp"
#include "app/log.hpp"
#include "app/option_keys.hpp"
#include "case/checks/doubts.hpp"
#include "case/numbers.hpp"
#include "core/atomic_file.hpp"
#include "core/messages.hpp"
#include "report/publish.hpp"
#include "report/result_folder.hpp"
#include "report/simulation/simulation_files.hpp"
#include "report/simulation/simulation_report.hpp"
#include "report/summary.hpp"
#include "study/kept/stage_keys.hpp"
#include "study/run.hpp"

namespace thinwall::app {

namespace {

/// The points as a list of TOML.
std::string list_of(const std::vector<std::string>& points) {
  std::string list;
  for (const std::string& point : points) {
    (void)operating_point(point);  // throws what is said of --at
    list += (list.empty() ? "\"" : ", \"") + point + "\"";
  }
  return "[" + list + "]";
}

constexpr std::array<OptionKey, 6> keys_of_options{{{"simulation.at", "--at"},
                                                    {"simulation.paths", "--paths"},
                                                    {"simulation.settling_turns", "--settle"},
                                                    {"simulation.turns", "--turns"},
                                                    {"simulation.trace", "--trace"},
                                                    {"simulation.steps", "--steps"}}};

/// Simulates a case and publishes its tables; returns the text for the terminal.
std::string simulated_into(const cases::Case& source, const report::ResultFolder& folder, ProgressDisplay display) {
  const auto first_mesh = tell_of_long_run(source);
  for (const std::string& doubt : cases::doubts_about(source)) core::warn(doubt);
  const auto cache = folder.path() / "cache";
  const auto kept_under = [&cache](const std::string& stage, const std::string& key) {
    return key.empty() ? study::Checkpoint() : study::Checkpoint(cache / (stage + ".bin"), key, false);
  };
  study::Kept kept{kept_under("part", source.part ? study::part_key(source) : ""),
                   {},
                   {},
                   {cache / "simulated.bin", study::simulation_key(source), false},
                   kept_under("tool", study::tool_key(source)),
                   kept_under("robot", study::robot_key(source))};
  StageDisplay stages(display);
  const study::Results results =
      study::run(source, cases::variation_of(source), kept, {.on_stage = stages.listener(), .first_mesh = first_mesh});
  const auto staging = core::partial_path(folder.path() / "simulated");
  report::write_simulation(staging, results);
  report::publish_folder(staging / "simulation", folder.path() / "simulated");
  std::filesystem::remove(staging);
  return (source.title.empty() ? "" : source.title + "\n") +
         report::simulation_text(report::summary_of(results.setup, results)) +
         "  tables: " + (folder.path() / "simulated").string() + "\n";
}

}  // namespace

cases::Case simulated_case(const std::filesystem::path& path, std::vector<std::string> overrides,
                           const SimulateRequest& request) {
  const std::size_t written = overrides.size();
  const auto put = [&overrides](const char* key, const auto& value) {
    if (value) overrides.push_back(fmt::format("simulation.{}={}", key, *value));
  };
  if (!request.points.empty()) overrides.push_back("simulation.at=" + list_of(request.points));
  put("paths", request.paths);
  put("settling_turns", request.settling_turns);
  put("turns", request.turns);
  put("trace", request.traced_turns);
  put("steps", request.steps);
  cases::Case source = read_with_options(path, overrides, written, keys_of_options);
  if (source.simulation) return source;
  overrides.emplace_back("simulation.paths=circular");
  return read_with_options(path, overrides, written, keys_of_options);
}

std::string simulate_case(cases::Case source, const std::filesystem::path& out, ProgressDisplay display) {
  source.lobes.reset();
  source.path.reset();
  report::ResultFolder folder(out.empty() ? report::default_result_folder(source.name) : out);
  log_to_file(folder.path() / "run.log");  // marks the folder as ours
  messages_to_log();
  return report::unless_refused(folder, [&] { return simulated_into(source, folder, display); });
}

}  // namespace thinwall::app
