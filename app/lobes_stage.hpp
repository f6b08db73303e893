#pragma once
// Stability charts of the part alone and of the supported part.

#include "app/case.hpp"
#include "app/results.hpp"

namespace thinwall::app {

/// The chart of one structure at the case's cutting point, the tool's modes added. `structure` must hold that point;
/// null: a rigid part, the tool alone.
[[nodiscard]] NamedLobes compute_lobes(const Case& source, const std::string& name,
                                       const dynamics::ModalModel* structure);

}  // namespace thinwall::app
