#include "case/checks/tool_checks.hpp"

#include <algorithm>
#include <functional>
#include <string>

#include "case/checks/measured_checks.hpp"

namespace thinwall::cases {

namespace {

void check_swap(const setup::Tool& tool, Findings& findings) {
  if (!tool.modes.empty() || !tool.measured.empty())
    findings.report("tool.swap", "stands in place of tool.modes and tool.measured; remove them");
  if (tool.swap->reference.empty())
    findings.report("tool.swap", "needs [[tool.swap.reference]], the tool that was measured");
  if (tool.swap->target.empty()) findings.report("tool.swap", "needs [[tool.swap.target]], the tool that cuts");
  if (tool.swap->measured.empty()) {
    findings.report("tool.swap", "needs [[tool.swap.measured]], the FRFs with the reference tool");
    return;
  }
  for (const std::string& point : {tool.swap->tip, tool.swap->up}) {
    const bool there = std::ranges::any_of(
        tool.swap->measured, [&](const setup::MeasuredFrf& frf) { return frf.response.starts_with(point + "."); });
    if (!there)
      findings.report("tool.swap", "no FRF of tool.swap.measured is of point \"" + point + "\"; measure there too");
  }
  check_layout("tool.swap.measured", tool.swap->measured, findings);
}

}  // namespace

void check_measured_tool(const setup::Tool& tool, Findings& findings) {
  if (tool.swap) check_swap(tool, findings);
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
