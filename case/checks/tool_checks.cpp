#include "case/checks/tool_checks.hpp"

#include <algorithm>
#include <functional>
#include <string>

#include "case/checks/measured_checks.hpp"
#include "core/units.hpp"
#include "setup/identified/posture_tables.hpp"

namespace thinwall::cases {

namespace {

/// Reports a point up the tool that the table has not, or has along other directions than the tip.
void check_point_up(const setup::ToolSwap& swap, const setup::TabledRobot& robot, Findings& findings) {
  const dynamics::ModalTable& table = robot.tapped ? robot.tapped->tables.front() : *robot.table_modes;
  if (swap.up == robot.table_point) {
    findings.report("tool.swap.up",
                    "\"" + swap.up + "\" is robot.table_point, the tip; name the second point, up the tool");
    return;
  }
  if (std::ranges::none_of(table.dofs, [&](const dynamics::Dof& dof) { return dof.point == swap.up; })) {
    findings.report("tool.swap.up", "\"" + swap.up +
                                        "\" is no point of the robot's tables of modes; a swap needs the " +
                                        "modes of two points of the tool: name the second, or tap it, too");
    return;
  }
  const dynamics::DofTable dofs = setup::used_part(robot, table).dofs;
  const auto directions = [&](const std::string& point) {
    std::vector<Eigen::Vector3d> found;
    for (const int row : dynamics::rows_of_point(dofs, point))
      found.push_back(dofs[static_cast<std::size_t>(row)].direction);
    return found;
  };
  const auto tip = directions(robot.table_point), up = directions(swap.up);
  if (tip.size() == 2 && std::ranges::is_permutation(tip, up)) return;
  findings.report("tool.swap.up", "across cutting.tool_axis the robot's tables have " + std::to_string(tip.size()) +
                                      " directions at \"" + robot.table_point + "\" and " + std::to_string(up.size()) +
                                      " at \"" + swap.up + "\", must have two at each, the same ones");
}

/// Reports steps of `table` whose bore is not inside of them; what could not be read is reported elsewhere.
void check_bores(const std::string& table, const std::vector<setup::ToolStep>& steps, Findings& findings) {
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (steps[i].inner_diameter >= steps[i].outer_diameter)
      findings.report(indexed(table, i) + ".inner_diameter",
                      core::readable_text(steps[i].inner_diameter, core::kind::length) +
                          " is no less than outer_diameter, " +
                          core::readable_text(steps[i].outer_diameter, core::kind::length) + "; must be below it");
  }
}

/// Reports what is missing for a swap at the robot's own modes.
void check_swap_on_robot(const Case& source, Findings& findings) {
  const setup::ToolSwap& swap = *source.tool->swap;
  const setup::TabledRobot* robot = setup::tabled_robot(source.robot);
  if (robot == nullptr || !setup::carries_tool(source.robot)) {
    findings.report("tool.swap",
                    "needs [[tool.swap.measured]], the FRFs with the reference tool, or a robot that carries it and is "
                    "known by tables of modes with it (robot.model = \"modal_table\")");
    return;
  }
  if (findings.written("tool.swap.tip"))
    findings.report("tool.swap.tip", "the tip in the robot's tables is robot.table_point; remove the key");
  if (swap.rotations != setup::SwapRotations::none)
    findings.report("tool.swap.rotations",
                    "the robot's modes are taken at both points as they are; set it to \"none\"");
  if (!robot->cross_terms)
    findings.report("robot.cross_terms", "a swap of the tool needs those between its points; remove the key");
  if (!(swap.distance > 0.0) || !robot->up || !(robot->tapped || robot->table_modes)) return;  // reported
  check_point_up(swap, *robot, findings);
}

void check_swap(const Case& source, Findings& findings) {
  const setup::Tool& tool = *source.tool;
  check_swapped_tools(tool, findings);
  if (setup::swapped_on_robot(tool)) return check_swap_on_robot(source, findings);
  if (tool.swap->to_hz)
    findings.report("tool.swap.to", "is for a swap at the modes of a robot; bound the FRFs by tool.swap.measured.to");
  for (const std::string& point : {tool.swap->tip, tool.swap->up}) {
    const bool there = std::ranges::any_of(
        tool.swap->measured, [&](const setup::MeasuredFrf& frf) { return frf.response.starts_with(point + "."); });
    if (!there)
      findings.report("tool.swap", "no FRF of tool.swap.measured is of point \"" + point + "\"; measure there too");
  }
  check_layout("tool.swap.measured", tool.swap->measured, findings);
}

}  // namespace

void check_swapped_tools(const setup::Tool& tool, Findings& findings) {
  if (!tool.modes.empty() || !tool.measured.empty())
    findings.report("tool.swap", "stands in place of tool.modes and tool.measured; remove them");
  if (tool.swap->reference.empty())
    findings.report("tool.swap", "needs [[tool.swap.reference]], the tool that was measured");
  if (tool.swap->target.empty()) findings.report("tool.swap", "needs [[tool.swap.target]], the tool that cuts");
  check_bores("tool.swap.reference", tool.swap->reference, findings);
  check_bores("tool.swap.target", tool.swap->target, findings);
}

void check_measured_tool(const Case& source, Findings& findings) {
  const setup::Tool& tool = *source.tool;
  if (tool.swap) check_swap(source, findings);
  if (!tool.modes.empty() && !tool.measured.empty())
    findings.report("tool.measured", "give either tool.modes or tool.measured, not both");
  if (tool.fit && tool.measured.empty())
    findings.report("tool.fit",
                    "finds poles of [[tool.measured]], of which there is none; give the FRFs, or remove it");
  for (std::size_t i = 0; i < tool.measured.size(); ++i) {
    const auto& frf = tool.measured[i];
    const auto same = [&](const setup::MeasuredFrf& other) {
      return other.response == frf.response && other.force == frf.force;
    };
    const auto first = std::ranges::find_if(tool.measured, same) - tool.measured.begin();
    if (first < static_cast<std::ptrdiff_t>(i) && !frf.response.empty())
      findings.report("tool.measured[" + std::to_string(i) + "].response",
                      "the same entry of the FRF matrix is tool.measured[" + std::to_string(first) + "]; keep one");
  }
}

}  // namespace thinwall::cases
