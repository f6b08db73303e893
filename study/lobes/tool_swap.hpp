#pragma once
// The tip of the case's tool from FRFs that were measured with another tool in its place.

#include "coupling/tool_swap.hpp"
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

/// Both tools as free beams (fem/beam.hpp), held alike: only tools differ. On the lines of the first file. Throws
/// InputError for a second point beyond the overhang, FRFs that are missing (named), and as coupling::tool_swap();
/// DataError as io::resample(); NumericalError where the holder is not known at some line.
[[nodiscard]] SwappedTip swapped_tip(const setup::CutSetup& source);

}  // namespace thinwall::study
