#pragma once
// The tip of the case's tool from FRFs that were measured with another tool in its place, or from the modes of the
// robot that carries it.

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
/// place of files. Throws as it does, InputError for FRFs that are missing (named) and a table that was not given
/// (setup::identify()), and DataError as io::resample().
[[nodiscard]] SwappedTip swapped_tip(const setup::CutSetup& source);

/// The tips of other tables of modes in place of the swap's own, on its lines. Errors as swapped_tip(). Cost: a swap of
/// some 10 µs a line for each table, shared out among the threads.
[[nodiscard]] std::vector<SwappedTip> swapped_tips(const setup::CutSetup& source,
                                                   const std::vector<dynamics::ModalTable>& tables);

/// Lines that resolve every mode of a swap's table, in equal steps of ln f: four within the half-power width 2ζf of the
/// least damped of them, from half the lowest frequency to swap.to_hz, or to the highest frequency; 4000 at most.
[[nodiscard]] dynamics::FrequencyAxis lines_of_modes(const setup::ToolSwap& swap);

}  // namespace thinwall::study
