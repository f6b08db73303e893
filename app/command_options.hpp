#pragma once
// The options of all commands, and the values that they take.

#include <string>
#include <vector>

#include "app/fit/fit_command.hpp"
#include "app/inspect_command.hpp"
#include "app/lobes_input.hpp"
#include "app/observed/calibrate_command.hpp"
#include "app/observed/coefficients_command.hpp"
#include "app/observed/validate_command.hpp"
#include "app/postures_command.hpp"
#include "app/ranks_option.hpp"
#include "app/reduce_command.hpp"
#include "app/simulate_command.hpp"
#include "app/sweep/command_sweep.hpp"
#include "report/page/phases.hpp"

namespace CLI {
class App;
}

namespace thinwall::app {

/// Everything that the words of the command line can carry.
struct Arguments {
  std::string case_path, out, template_name = "plate", folder, left, right, html;
  std::string progress = "auto", shell, schema = "case";
  std::vector<std::string> overrides, points;
  LobesInput lobes;
  FitRequest fit;
  ReduceRequest reduce;
  InspectRequest inspect;
  report::PhasesRequest phases;
  SimulateRequest simulate;
  PosturesRequest postures;
  CalibrateRequest calibrate;
  ValidateRequest validate;
  CoefficientsRequest coefficients;
  SweepRequest sweep;
  MergeRequest merge;
  bool fresh = false, quiet = false, verbose = false, all = false;
  int threads = 0;
  RanksRequest ranks;
  double tolerance = 1e-9;
};

/// Adds all commands and their options to `app`; parsing then fills `arguments`.
void describe(CLI::App& app, Arguments& arguments);

}  // namespace thinwall::app
