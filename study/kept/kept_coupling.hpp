#pragma once
// Part and robot joined, from a checkpoint.

#include <functional>

#include "study/kept/checkpoint.hpp"
#include "study/results.hpp"

namespace thinwall::study {

/// The coupling as an earlier run left it, or by `compute`, whose result is kept.
[[nodiscard]] CouplingResult coupling_of_checkpoint(Checkpoint& kept, const std::function<CouplingResult()>& compute);

}  // namespace thinwall::study
