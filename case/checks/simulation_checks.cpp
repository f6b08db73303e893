#include "case/checks/simulation_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "case/operating_point.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "setup/contact_model.hpp"
#include "setup/milling_process.hpp"
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
      if (source.tool && point.depth_m > source.tool->length)
        findings.report("simulation.at", "\"" + text + "\" is deeper than the tool's length of " +
                                             length(source.tool->length) + "; give a smaller depth");
    } catch (const core::InputError& error) {
      findings.report("simulation.at", "\"" + text + "\": " + error.what() + "; write \"5000 rpm, 0.5 mm\"");
    }
  }
}

/// The reason why a structure cannot be simulated in this case; empty if there is none.
std::string fault_of_structure(const Case& source, setup::CutOn structure) {
  const bool modelled = source.part && setup::may_be_held(*source.part);
  switch (structure) {
    case setup::CutOn::part:
      return modelled ? "" : "a simulation needs a part that is held and modelled; describe it with [[part.supports]]";
    case setup::CutOn::supported:
      if (!source.robot || source.contacts.empty()) return "no robot holds the part; add [robot] and [[contacts]]";
      if (!setup::is_measured(*source.robot)) return "";
      return "the robot is known by measured FRFs alone, and a simulation needs poles; fit modes to them and give "
             "robot.modes, or take simulation.structures = \"part\"";
    case setup::CutOn::tool:
      return source.part ? "the tool cuts a part, not a rigid block; take \"part\" or \"supported\"" : "";
    case setup::CutOn::carried:
      if (!setup::carries_tool(source.robot)) return "no robot carries the tool; give robot.carries = \"tool\"";
      if (!setup::is_measured(*source.robot)) return "";
      return "the robot is known by measured FRFs alone, and a simulation needs poles; fit modes to them and give "
             "robot.modes";
  }
  return "";
}

void check_structures(const Case& source, Findings& findings) {
  if (source.tool && setup::known_by_lines(*source.tool))
    findings.report("simulation",
                    "tool.measured has no poles, and a simulation needs them; give tool.fit = true, or tool.modes");
  if (!source.measured_part.empty())
    findings.report("simulation",
                    "part.measured has no poles, and a simulation needs them; describe the part "
                    "(part.length …)");
  std::vector<setup::CutOn> structures = source.simulation->structures;
  const bool supported = source.robot && !source.contacts.empty();
  if (structures.empty() && source.part) structures.push_back(setup::CutOn::part);
  if (structures.size() == 1 && !findings.given("simulation.structures") && supported)
    structures.push_back(setup::CutOn::supported);
  if (structures.empty() && setup::carries_tool(source.robot)) structures.push_back(setup::CutOn::carried);
  for (const setup::CutOn structure : structures) {
    if (const std::string fault = fault_of_structure(source, structure); !fault.empty())
      findings.report("simulation.structures", fault);
  }
}

/// A contact that may open: the only one, of a known stiffness, pressed.
void check_one_sided(const Case& source, Findings& findings) {
  if (source.simulation->support != setup::SupportSides::one_sided) return;
  if (source.contacts.size() != 1 || !source.robot) {
    findings.report("simulation.support",
                    std::to_string(source.contacts.size()) +
                        " contacts of a robot, must be one that opens; give one, or \"two_sided\"");
    return;
  }
  const auto* springs = std::get_if<setup::SpringContact>(&source.contacts.front().model);
  if (springs != nullptr && !springs->stiffness.empty() && !std::isfinite(springs->stiffness.front())) {
    findings.report("simulation.support",
                    "a rigid contact does not open; give contacts.stiffness, or contacts.model = \"hertz\"");
  } else if (!setup::preload_of(source, source.contacts.front())) {
    findings.report("simulation.support", "nothing presses the contact that may open; give robot.preload");
  } else if (source.contacts.front().directions.size() > 1) {
    findings.report("simulation.support",
                    std::to_string(source.contacts.front().directions.size()) +
                        " directions of the contact, must be one, its normal, for the others do not open; give one");
  } else if (source.robot->preload.dot(source.contacts.front().directions.front()) == 0.0) {
    findings.report("simulation.support",
                    "the side on which the robot stands is told by the sign of robot.preload along the contact's "
                    "direction; give it");
  }
}

void check_exact_paths(const Case& source, Findings& findings) {
  if (source.simulation->paths == setup::ToothPaths::circular) return;
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

void check_record(const Case& source, double feed_per_tooth_m, Findings& findings) {
  const setup::Simulation& simulation = *source.simulation;
  const std::optional<double> longest = longest_path(source);
  if (simulation.length_m && longest && *simulation.length_m > *longest)
    findings.report("simulation.length", length(*simulation.length_m) + " is more than the part's extent of " +
                                             length(*longest) + " along the feed; shorten it");
  if (findings.given("simulation.turns") && simulation.length_m)
    findings.report("simulation.length", "give either simulation.turns or simulation.length, not both");
  if (simulation.length_m && !std::isfinite(*simulation.length_m)) return;  // reported as it was read
  const auto violations =
      milling::validate(setup::simulation_options(simulation, feed_per_tooth_m, source.tool->teeth));
  for (const std::string& violation : violations) findings.report("simulation.trace", violation);
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
  check_one_sided(source, findings);
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
