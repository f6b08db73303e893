#pragma once
// What the cut of a case feels: the part at the point that is cut, and the tool.

#include <variant>

#include "app/case.hpp"
#include "dynamics/modal_model.hpp"
#include "dynamics/response_model.hpp"
#include "milling/relative_structure.hpp"
#include "milling/sampled_stability.hpp"
#include "milling/tool.hpp"

namespace thinwall::app {

/// Poles where everything is known by its modes (part axes); samples, with the part's poles beside them, where the tool
/// tip is measured.
using CutStructure = std::variant<milling::RelativeStructure, milling::SampledStructure>;

/// Part and tool together; `frame` is the cut's, `part` must hold the point that is cut, null: a rigid part. Samples
/// lie on the lines of the first measured file; what speaks against them is logged as a warning: a driving point that
/// gives energy, the highest resonance with fewer than two lines in half its width. Throws InputError if nothing moves,
/// DataError as io::read_frf and io::resample.
[[nodiscard]] CutStructure cut_structure(const Case& source, const milling::ToolFrame& frame,
                                         const dynamics::ModalModel* part);

/// The part as it is held by a robot that has no poles: samples of `coupled` (part axes) at the point that is cut, on
/// its lines, and the tool: its modes as poles, or its measured receptance put on these lines. Warns as above. Throws
/// DataError as io::resample.
[[nodiscard]] milling::SampledStructure sampled_structure(const Case& source, const milling::ToolFrame& frame,
                                                          const dynamics::ResponseModel& coupled);

}  // namespace thinwall::app
