#include "app/fit/fit_swap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "case/tool_file.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "study/lobes/tool_swap.hpp"

namespace thinwall::app {

namespace {

setup::ToolSwap swap_of(const std::string& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    throw core::UsageError("--swap " + file + ": is no file; give one with [tool] and [tool.swap]");
  const setup::Tool tool = cases::read_tool(file);
  if (!tool.swap)
    throw core::UsageError("--swap " + file +
                           ": has no [tool.swap]; it tells the tool that was measured and the other");
  if (!tool.swap->measured.empty())
    throw core::UsageError("--swap " + file + ": has [[tool.swap.measured]], but the FRFs are those of the command");
  if (tool.swap->reference.empty() || tool.swap->target.empty())
    throw core::UsageError("--swap " + file +
                           ": needs [[tool.swap.reference]], the tool that was measured, and [[tool.swap.target]]");
  return *tool.swap;
}

/// The axis of a tool that was measured in two directions at both points.
Eigen::Vector3d axis_of(const dynamics::ResponseModel& measured, const setup::ToolSwap& swap) {
  std::vector<Eigen::Vector3d> tip;
  const bool known = std::ranges::all_of(measured.responses, [&](const dynamics::Dof& dof) {
    if (dof.point == swap.tip) tip.push_back(dof.direction);
    return dof.point == swap.tip || dof.point == swap.up;
  });
  if (!known || tip.size() != 2 || measured.responses.size() != 4 || measured.forces.size() != 4)
    throw core::UsageError("--swap: needs the 16 FRFs between two directions of \"" + swap.tip + "\" and of \"" +
                           swap.up + "\", and no others; name the points in tool.swap.tip and tool.swap.up");
  return tip[0].cross(tip[1]).normalized();
}

}  // namespace

std::vector<std::string> with_other_tool(FitMatrix& matrix, const std::string& file) {
  if (file.empty()) return {};
  const setup::ToolSwap swap = swap_of(file);
  study::SwappedResponse swapped = study::swapped_response(swap, axis_of(matrix.measured, swap), matrix.measured);
  matrix.measured = std::move(swapped.tip);
  if (!matrix.coherence.empty()) {
    matrix.coherence.clear();
    matrix.notes.emplace_back("coherence is that of the measured FRFs, not of the exchanged tool, and is not used");
  }
  matrix.notes.push_back(fmt::format(
      "the tool that was measured is exchanged for the target of {}; errors of lines grow up to {} times, at {} Hz",
      file, core::number_text(swapped.worst_condition, 2), core::number_text(swapped.at_frequency_hz, 4)));
  if (swapped.status != coupling::SwapStatus::ill_conditioned) return {};
  return {"the exchange of the tool lost more than half of its digits; leave out the lines where it did"};
}

}  // namespace thinwall::app
