#pragma once
// The structures of a chart by each draw of what was identified from measurements.

#include <Eigen/Core>
#include <vector>

#include "milling/cut/tool.hpp"
#include "milling/structure/relative_structure.hpp"
#include "study/lobes/chart_of.hpp"
#include "study/results.hpp"

namespace thinwall::study {

/// The poles that the cut feels by each draw (setup::take_draw()): fitted tool and learned robot as they were drawn,
/// the part as it is, so that nothing of it is computed anew. `part`: the part's modes or those of the supported part,
/// null for a rigid one. Part axes; empty where nothing that the chart feels was identified. Cost: draws times
/// cut_poles().
[[nodiscard]] std::vector<milling::RelativeStructure> drawn_poles(const setup::Setup& source, ChartOf of,
                                                                  const dynamics::ModalModel* part,
                                                                  const Results& results);

/// The changes of the samples of the supported part where its robot has no poles to be joined by, by each draw: the
/// coupled response at the point that is cut, and the tool's. Tool axes, one 3 × 3 a line; empty where nothing was
/// identified. Cost: draws times a coupling.
[[nodiscard]] std::vector<std::vector<Eigen::Matrix3cd>> drawn_changes(const setup::Setup& source,
                                                                       const milling::ToolFrame& frame,
                                                                       const Results& results);

/// The changes of the lines of a tool that is swapped in at a robot's modes, by each draw of these; empty where they
/// were not learned. Tool axes, one 3 × 3 a line of swapped_tip(). Cost: that of swapped_tips().
[[nodiscard]] std::vector<std::vector<Eigen::Matrix3cd>> drawn_swaps(const setup::Setup& source,
                                                                     const milling::ToolFrame& frame);

}  // namespace thinwall::study
