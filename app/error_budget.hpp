#pragma once
// What part, robot and both together are off by: the noise of what was measured, what the part's reduction leaves out.

#include "app/case.hpp"
#include "app/results.hpp"

namespace thinwall::app {

/// The part with what its reduction left out (reduction/truncation.hpp), damped as the part is. None of a measured
/// part, or where nothing was left out.
[[nodiscard]] std::optional<Component> richer_part(const Case& source, const Results& results,
                                                   const dynamics::FrequencyAxis& axis);

/// Of the responses in `results`: noise as the case states it, carried into the coupled response to first order
/// (coupling/error_budget.hpp); truncation as the difference of the models with and without what was left out, coupled
/// anew: no expansion. Warns where the noise cannot be carried over (a regularised kernel).
[[nodiscard]] ErrorBudget error_budget(const Case& source, const Results& results);

}  // namespace thinwall::app
