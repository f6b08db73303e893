#include "app/simulate_command.hpp"

#include <algorithm>

#include "app/log.hpp"
#include "case/numbers.hpp"
#include "core/atomic_file.hpp"
#include "report/publish.hpp"
#include "report/result_folder.hpp"
#include "report/simulation_report.hpp"
#include "study/kept/stage_keys.hpp"
#include "study/run.hpp"

namespace thinwall::app {

namespace {

study::SimulationRequest simulation_of(const std::vector<milling::OperatingPoint>& points,
                                       const SimulateRequest& request) {
  study::SimulationRequest simulation;
  simulation.points = points;
  simulation.paths = request.paths == "exact" ? study::ToothPaths::exact : study::ToothPaths::circular;
  simulation.options.settling_turns = request.settling_turns;
  simulation.options.recorded_turns = request.turns;
  simulation.options.traced_turns = std::min(request.traced_turns, request.turns);
  simulation.options.wall.turns = request.turns >= 4 ? std::min(request.turns, 20) : 0;
  simulation.options.steps.steps_in_cut = request.steps;
  return simulation;
}

}  // namespace

std::string simulate_case(cases::Case source, const std::vector<milling::OperatingPoint>& points,
                          const std::filesystem::path& out, const SimulateRequest& request) {
  const study::SimulationRequest simulation = simulation_of(points, request);
  source.lobes.reset();
  source.path.reset();
  const report::ResultFolder folder(out.empty() ? report::default_result_folder(source.name) : out);
  log_to_file(folder.path() / "run.log");  // marks the folder as ours
  messages_to_log();
  study::Kept kept{source.part ? study::Checkpoint(folder.path() / "cache" / "part.bin", study::part_key(source), false)
                               : study::Checkpoint(),
                   {},
                   {}};
  StageDisplay display(request.display);
  const study::Results results =
      study::run(source, cases::variation_of(source), kept, {.on_stage = display.listener()});
  study::Stages stages(display.listener());
  stages.begin("simulation");
  const auto simulated = study::simulate_points(results.setup, results, simulation);
  stages.end();
  const auto staging = core::partial_path(folder.path() / "simulated");
  report::write_simulation(staging, simulated);
  report::publish_folder(staging / "simulation", folder.path() / "simulation");
  std::filesystem::remove(staging);
  return (source.title.empty() ? "" : source.title + "\n") + report::simulation_text(simulated) +
         "  tables: " + (folder.path() / "simulation").string() + "\n";
}

}  // namespace thinwall::app
