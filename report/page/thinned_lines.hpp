#pragma once
// Fewer lines of receptances, with their peaks.

#include <vector>

#include "dynamics/response_model.hpp"

namespace thinwall::report {

/// Ascending numbers of at most `most` lines (4 at least), the first and the last among them; all if there are no more.
/// The lines are cut into equal stretches, of each of which two stay: where a diagonal entry rises highest above its
/// mean of the stretch, and where one falls deepest below. The responses must have the same lines. Cost O(lines ·
/// DOFs).
[[nodiscard]] std::vector<std::size_t> thinned_lines(const std::vector<const dynamics::ResponseModel*>& responses,
                                                     std::size_t most);

}  // namespace thinwall::report
