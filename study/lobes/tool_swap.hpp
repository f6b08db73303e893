#pragma once
// The tip of the case's tool from FRFs that were measured with another tool in its place, or from the modes of the
// robot that carries it.

#include <functional>
#include <optional>
#include <vector>

#include "coupling/tool_swap.hpp"
#include "dynamics/modal_table.hpp"
#include "milling/direct/sampled_receptance.hpp"
#include "setup/machining_setup.hpp"

namespace thinwall::study {

/// The tip's receptance across the tool's axis, part axes, and how well the swap could be done.
struct SwappedTip {
  milling::SampledReceptance tip;
  coupling::SwapStatus status = coupling::SwapStatus::done;
  double worst_condition = 0.0;  ///< of T^A_11 − T^C_11, over all lines
  double at_frequency_hz = 0.0;
};

/// The receptances of the tip with the second tool across its axis, and how well the swap could be done.
struct SwappedResponse {
  dynamics::ResponseModel tip;
  coupling::SwapStatus status = coupling::SwapStatus::done;
  double worst_condition = 0.0;  ///< of T^A_11 − T^C_11, over all lines
  double at_frequency_hz = 0.0;
};

/// The swap of the tools of `swap` in receptances between the tip and the point up with the first of them, in two
/// directions across `axis`. Both tools are free beams (fem/beam.hpp), held alike: only tools differ. Throws InputError
/// for a second point beyond the overhang, a direction that is not across the axis, and as coupling::tool_swap();
/// NumericalError where the holder is not known at some line.
[[nodiscard]] SwappedResponse swapped_response(const setup::ToolSwap& swap, const Eigen::Vector3d& axis,
                                               const dynamics::ResponseModel& measured);

/// swapped_response() on the lines of the first file, or on lines_of_modes() where the swap has a table of modes in
/// place of files, doubled up to 4000 until unresolved_peak_hz() finds none. Throws as it does, InputError for FRFs
/// that are missing (named) and a table that was not given (setup::identify()), and DataError as io::resample().
[[nodiscard]] SwappedTip swapped_tip(const setup::CutSetup& source);

/// Warns of a swap that lost digits, of a peak that the lines of a robot's modes do not resolve, and of lines that give
/// energy (warn_of_energy()).
void warn_of_swap(const setup::Tool& tool, const SwappedTip& swapped);

/// The tip of another table of modes in place of the swap's own, on its lines. It may be called by several threads at
/// once. Errors as swapped_tip(). Cost: some 10 µs a line.
using TipOfModes = std::function<SwappedTip(const dynamics::ModalTable&)>;

/// The part that swaps of other tables have in common is computed once. Errors as swapped_tip().
[[nodiscard]] TipOfModes tip_of_modes(const setup::CutSetup& source);

/// tip_of_modes() of tables, shared out among the threads.
[[nodiscard]] std::vector<SwappedTip> swapped_tips(const setup::CutSetup& source,
                                                   const std::vector<dynamics::ModalTable>& tables);

/// Lines that resolve every mode of a swap's table, in equal steps of ln f: four within the half-power width 2ζf of the
/// least damped of them, up to swap.to_hz, or to the highest frequency; 4000 at most. The first is half of f in 1/f² =
/// 1/f_1² + 1/f_2² (Dunkerley 1894), with the lowest mode f_1 of the table and the lowest f_2 of the target with its
/// root held rigidly: no more than half of either, for the lowest mode with the target lies below both. The modes are
/// those with the reference tool: swapped_tip() takes twice as many lines until the target's peaks are resolved, too.
[[nodiscard]] dynamics::FrequencyAxis lines_of_modes(const setup::ToolSwap& swap);

/// The first peak of a tip on lines in equal steps of ln f that has less than four of them in its half-power width, Hz.
[[nodiscard]] std::optional<double> unresolved_peak_hz(const milling::SampledReceptance& tip);

}  // namespace thinwall::study
