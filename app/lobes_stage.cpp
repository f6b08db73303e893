#include "app/lobes_stage.hpp"

#include <numbers>
#include <optional>

#include "app/milling_process.hpp"
#include "core/error.hpp"
#include "dynamics/conversion.hpp"
#include "milling/stability.hpp"
#include "robot/one_mode.hpp"

namespace thinwall::app {

namespace {

std::optional<milling::RelativeStructure> tool_structure(const Case& source) {
  if (source.tool->modes.empty()) return std::nullopt;
  std::vector<robot::OneMode> modes;
  for (const ToolMode& m : source.tool->modes) {
    modes.push_back(robot::one_mode(m.frequency_hz, m.damping_ratio, m.stiffness, m.direction));
  }
  return milling::relative_structure(dynamics::to_modal(robot::spatial_model(modes, "tool")), "tool");
}

/// Part and tool as the cut feels them.
milling::RelativeStructure relative_structure(const Case& source, const dynamics::ModalModel* part) {
  const auto tool = tool_structure(source);
  if (part == nullptr) {
    if (!tool) throw core::InputError("lobes need something that moves: a part, or tool.modes");
    return *tool;
  }
  const auto& limit = source.lobes->modes_up_to_hz;
  const auto kept = limit ? dynamics::truncate(*part, 2.0 * std::numbers::pi * *limit, true) : *part;
  const auto structure = milling::relative_structure(kept, source.cutting->at);
  return tool ? milling::sum(structure, *tool) : structure;
}

}  // namespace

NamedLobes compute_lobes(const Case& source, const std::string& name, const dynamics::ModalModel* structure) {
  const LobesOptions& wanted = *source.lobes;
  const auto relative = relative_structure(source, structure);
  const auto process = milling_process(source);
  milling::StabilityOptions options;
  options.depth_limit_m = wanted.depth_limit;
  options.error_tolerance = wanted.tolerance;
  NamedLobes result;
  result.name = name;
  result.lobes = milling::stability_lobes(
      relative, process, milling::spindle_speeds(wanted.from_rpm, wanted.to_rpm, wanted.count), options);
  if (source.cutting->spindle_speed_rpm) {
    result.at_spindle_speed = milling::limiting_depth(relative, process, *source.cutting->spindle_speed_rpm, options);
  }
  return result;
}

}  // namespace thinwall::app
