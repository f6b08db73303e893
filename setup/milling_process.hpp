#pragma once
// The cut that a case describes, as milling/ knows it.

#include <vector>

#include "milling/cut/process.hpp"
#include "setup/machining_setup.hpp"

namespace thinwall::setup {

/// The cutter of [tool]: `end`, `runout` and all; its edges as high as the tool is long.
[[nodiscard]] milling::Cutter cutter_of(const Tool& tool);

/// The arcs in which a tooth cuts: that of the radial depth, or those between the angles that are given, one of each
/// without a partner left out. Throws InputError as milling::engagement_of does.
[[nodiscard]] std::vector<milling::Engagement> engagement_arcs(const Cutting& cutting, const milling::Cutter& cutter);

/// [tool] and [cutting] together. A law that is not linear is linearised at the mean chip of each tooth, at the feed
/// per tooth, or the feed rate over teeth and spindle speed, whatever the speed of a row of the chart. Throws
/// InputError as milling::set_force_law and engagement_of do.
[[nodiscard]] milling::MillingProcess milling_process(const CutSetup& source);

/// The force of [cutting] as a law of the chip; the linear and the oblique one are the coefficients of `process`.
[[nodiscard]] milling::ForceLaw force_law(const Cutting& cutting, const milling::MillingProcess& process);

/// Feed per tooth in m, if the case gives it or what it follows from.
[[nodiscard]] std::optional<double> feed_per_tooth(const CutSetup& source);

}  // namespace thinwall::setup
