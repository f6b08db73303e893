#include "case/checks/simulation_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "case/operating_point.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "setup/milling_process.hpp"
#include "setup/simulation_faults.hpp"
#include "setup/simulation_options.hpp"

namespace thinwall::cases {

namespace {

std::string length(double metres) {
  return core::readable_text(metres, core::kind::length);
}

void check_points(const Case& source, Findings& findings) {
  const CaseValue* given = find(source.values, "simulation.at");
  const auto* texts = given == nullptr ? nullptr : std::get_if<std::vector<std::string>>(&given->value);
  if (texts == nullptr) return;
  for (const std::string& text : *texts) {
    try {
      const milling::OperatingPoint point = operating_point(text);
      for (const double height : source.simulation->wall_heights_m) {
        if (height > point.depth_m)
          findings.report("simulation.wall_heights", length(height) + " is above the depth of \"" + text +
                                                         "\", where there is no wall; give a lower height");
      }
      if (source.tool && point.depth_m > source.tool->length)
        findings.report("simulation.at", "\"" + text + "\" is deeper than the tool's length of " +
                                             length(source.tool->length) + "; give a smaller depth");
    } catch (const core::InputError& error) {
      findings.report("simulation.at", "\"" + text + "\": " + error.what() + "; write \"5000 rpm, 0.5 mm\"");
    }
  }
}

void check_structures(const Case& source, Findings& findings) {
  if (source.tool && setup::known_by_lines(*source.tool))
    findings.report("simulation",
                    "tool.measured has no poles, and a simulation needs them; give tool.fit = true, or tool.modes");
  if (!source.measured_part.empty())
    findings.report("simulation",
                    "part.measured has no poles, and a simulation needs them; describe the part "
                    "(part.length …)");
  if (!setup::fault_of_arm(source).empty()) return;  // reported of the arm
  const std::string key = findings.given("simulation.structures") ? "simulation.structures" : "simulation";
  for (const setup::CutOn structure : setup::simulated_structures(source)) {
    if (!source.measured_part.empty() && structure == setup::CutOn::part) continue;  // reported above
    if (const std::string fault = setup::fault_of_structure(source, structure); !fault.empty())
      findings.report(key, fault);
  }
}

void check_exact_paths(const Case& source, Findings& findings) {
  if (source.simulation->paths == setup::ToothPaths::circular) {
    if (source.simulation->start == setup::CutStart::border)
      findings.report("simulation.start",
                      "teeth on circles know no border; give simulation.paths = \"exact\" or \"region\"");
    return;
  }
  if (source.simulation->start == setup::CutStart::border && findings.written("simulation.settling_turns") &&
      source.simulation->settling_turns > 0)
    findings.report("simulation.settling_turns",
                    std::to_string(source.simulation->settling_turns) +
                        " turns, but all that follow a border are recorded; give 0, or leave it out");
  if (source.cutting && !source.cutting->radial_depth)
    findings.report("simulation.paths",
                    "angles of entry and exit do not say where the material lies; paths that are not circles need "
                    "cutting.radial_depth");
  if (source.tool && source.tool->end != setup::ToolEnd::flat)
    findings.report("simulation.paths", "paths that are not circles are known for flat ends only; take \"circular\"");
}

/// The longest path that fits on the part along the feed, m; none where its size is not known.
std::optional<double> longest_path(const Case& source) {
  if (!source.part) return std::nullopt;
  const double along = setup::box_size(*source.part).dot(source.cutting->feed_direction.cwiseAbs());
  return along > 0.0 ? std::optional(along) : std::nullopt;
}

/// The key by which the case makes its record long: one that is written, if any is.
std::string key_of_length(const Findings& findings) {
  for (const char* key :
       {"simulation.trace", "simulation.turns", "simulation.length", "simulation.wall", "simulation.wall_heights"}) {
    if (findings.written(key)) return key;
  }
  return "simulation";
}

/// Means over the parts of a turn are taken from whole steps.
void check_means(const Case& source, const milling::SimulationOptions& options, Findings& findings) {
  const int steps = source.simulation->steps_a_turn;
  const bool equal = setup::cutter_of(*source.tool).equal_teeth();
  if (options.means_a_turn < 2 || !equal || steps % options.means_a_turn == 0) return;
  findings.report("simulation.steps_a_turn", std::to_string(steps) + " steps do not divide into the " +
                                                 std::to_string(options.means_a_turn) +
                                                 " periods of teeth over which means are taken; take a multiple");
}

void check_record(const Case& source, double feed_per_tooth_m, Findings& findings) {
  const setup::Simulation& simulation = *source.simulation;
  const double radius_m = 0.5 * source.tool->diameter;
  if (feed_per_tooth_m >= radius_m)
    findings.report(findings.given("cutting.feed_per_tooth") ? "cutting.feed_per_tooth" : "cutting.feed_rate",
                    length(feed_per_tooth_m) + " a tooth, must be below the cutter's radius of " + length(radius_m) +
                        ": teeth would miss the material between them; check number and unit");
  const std::optional<double> longest = longest_path(source);
  if (simulation.length_m && longest && *simulation.length_m > *longest)
    findings.report("simulation.length", length(*simulation.length_m) + " is more than the part's extent of " +
                                             length(*longest) + " along the feed; shorten it");
  if (findings.given("simulation.turns") && simulation.length_m)
    findings.report("simulation.length", "give either simulation.turns or simulation.length, not both");
  if (simulation.length_m && !std::isfinite(*simulation.length_m)) return;  // reported as it was read
  const milling::SimulationOptions options =
      setup::simulation_options(simulation, feed_per_tooth_m, source.tool->teeth);
  for (const std::string& violation : milling::validate(options)) findings.report(key_of_length(findings), violation);
  if (findings.written("simulation.wall") && simulation.wall_turns > 0 && options.wall.turns == 0)
    findings.report("simulation.wall", std::to_string(simulation.wall_turns) + " turns of " +
                                           std::to_string(options.recorded_turns) +
                                           " that are recorded, must be 4 or more; record more, or give 0");
  const double wall_m = milling::recorded_length_m(options.wall, feed_per_tooth_m * source.tool->teeth);
  if (options.wall.turns > 0 && 2.0 * options.wall.cutoff_m >= wall_m && options.wall.cutoff_m > 0.0)
    findings.report("simulation.wall_cutoff", length(options.wall.cutoff_m) +
                                                  " is taken from either end of a wall of " + length(wall_m) +
                                                  "; give a shorter one, or more turns of wall");
  check_means(source, options, findings);
}

/// False if one of the numbers that give the feed could not be read, which is reported.
bool readable_feed(const setup::Cutting& cutting) {
  return !std::isnan(cutting.feed_per_tooth.value_or(0.0)) && !std::isnan(cutting.feed_rate.value_or(0.0)) &&
         !std::isnan(cutting.spindle_speed_rpm.value_or(0.0));
}

void check_map(const Case& source, Findings& findings) {
  const setup::SimulationMap& map = *source.simulation->map;
  if (!source.lobes) {
    findings.report("simulation.map", "a map spans the chart's speeds and depths; add [lobes]");
  } else if (source.tool && map.depth_limit_m > source.tool->length) {
    findings.report("simulation.map.deepest",
                    length(map.depth_limit_m) + " is more than the tool's length of " + length(source.tool->length));
  }
}

}  // namespace

void check_simulation(const Case& source, Findings& findings) {
  check_points(source, findings);
  check_exact_paths(source, findings);
  if (const std::string fault = setup::fault_of_opening(source); !fault.empty())
    findings.report("simulation.support", fault);
  if (const std::string fault = setup::fault_of_arm(source); !fault.empty()) findings.report("simulation.robot", fault);
  if (source.simulation->map) check_map(source, findings);
  if (!source.tool || !source.cutting) {
    findings.report("simulation", "there is no cut; add [tool] and [cutting]");
    return;
  }
  check_structures(source, findings);
  if (!readable_feed(*source.cutting)) return;
  if (const auto feed = setup::feed_per_tooth(source)) {
    check_record(source, *feed, findings);
  } else {
    findings.report("simulation",
                    "chips depend on the feed; give cutting.feed_per_tooth, or cutting.feed_rate and "
                    "cutting.spindle_speed");
  }
}

}  // namespace thinwall::cases
