#pragma once
// Errors of part, robot and both together: the noise of what was measured, what the part's reduction leaves out.

#include <optional>

#include "setup/machining_setup.hpp"
#include "study/results.hpp"

namespace thinwall::study {

/// All that the error budget reads beside the results of the earlier stages.
struct BudgetInput : setup::MeasuredPart {
  setup::Damping damping;
  std::optional<setup::Robot> robot;
  setup::CouplingChoice coupling;
};

/// The error budget's input of a set-up.
[[nodiscard]] inline BudgetInput budget_input(const setup::Setup& source) {
  return {source, source.damping, source.robot, source.coupling};
}

/// The error budget of the responses in `results`: noise as the case states it, carried into the coupled response to
/// first order (coupling/error_budget.hpp); truncation as the difference of the models with and without what was left
/// out, coupled anew: no expansion. With a regularised kernel the coupled response has neither, which is logged as a
/// warning, as is noise that a sensor's mass hides. Errors as coupling::error_budget() and coupling::couple().
[[nodiscard]] ErrorBudget error_budget(const BudgetInput& input, const Results& results);

}  // namespace thinwall::study
