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
  if (tool.swap->to_hz)
    throw core::UsageError("--swap " + file + ": tool.swap.to is for a swap at the modes of a robot; remove it, and " +
                           "bound the FRFs by --to");
  return *tool.swap;
}

[[noreturn]] void refuse_points(const setup::ToolSwap& swap) {
  throw core::UsageError("--swap: needs the 16 FRFs between two directions of \"" + swap.tip + "\" and of \"" +
                         swap.up + "\", and no others; name the points in tool.swap.tip and tool.swap.up");
}

/// The axis of a tool that was measured in two directions at both points.
Eigen::Vector3d axis_of(const dynamics::ResponseModel& measured, const setup::ToolSwap& swap) {
  std::vector<Eigen::Vector3d> tip;
  const bool known = std::ranges::all_of(measured.responses, [&](const dynamics::Dof& dof) {
    if (dof.point == swap.tip) tip.push_back(dof.direction);
    return dof.point == swap.tip || dof.point == swap.up;
  });
  if (!known || tip.size() != 2 || measured.responses.size() != 4 || measured.forces.size() != 4) refuse_points(swap);
  return tip[0].cross(tip[1]).normalized();
}

/// The columns of the forces in the order of the responses, by name.
std::vector<Eigen::Index> columns_of(const dynamics::ResponseModel& measured, const setup::ToolSwap& swap) {
  std::vector<Eigen::Index> columns;
  for (const dynamics::Dof& dof : measured.responses) {
    const auto found = std::ranges::find(measured.forces, dynamics::name(dof),
                                         [](const dynamics::Dof& force) { return dynamics::name(force); });
    if (found == measured.forces.end()) refuse_points(swap);
    columns.push_back(found - measured.forces.begin());
  }
  return columns;
}

/// The lines that are fitted, forces in the order of the responses: another line, such as that at 0 Hz, need not bear
/// the exchange.
dynamics::ResponseModel exchangeable(const dynamics::ResponseModel& measured, const setup::ToolSwap& swap,
                                     const identification::ResponseFitOptions& options) {
  const std::vector<std::size_t> lines = identification::used_lines(measured, options);
  const std::vector<Eigen::Index> columns = columns_of(measured, swap);
  dynamics::ResponseModel kept{{Eigen::VectorXd(std::ssize(lines))}, measured.responses, measured.responses, {}};
  for (const std::size_t line : lines) {
    kept.axis.hz(std::ssize(kept.H)) = measured.axis.hz(static_cast<Eigen::Index>(line));
    kept.H.emplace_back(measured.H[line](Eigen::all, columns));
  }
  return kept;
}

}  // namespace

std::vector<std::string> with_other_tool(FitMatrix& matrix, const std::string& file,
                                         const identification::ResponseFitOptions& options) {
  if (file.empty()) return {};
  const setup::ToolSwap swap = swap_of(file);
  const Eigen::Vector3d axis = axis_of(matrix.measured, swap);
  study::SwappedResponse swapped = study::swapped_response(swap, axis, exchangeable(matrix.measured, swap, options));
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
