#include "report/mesh_answer.hpp"

#include <fmt/format.h>

namespace thinwall::report {

std::string tolerance_not_met(const Summary& summary) {
  if (!summary.mesh || !summary.mesh->error_estimate) return {};
  const MeshEstimateSummary& estimate = *summary.mesh->error_estimate;
  if (estimate.met || !estimate.tolerance) return {};
  std::string text = fmt::format("the tolerance is not met: frequencies of the part are within {:.1e} by estimate",
                                 estimate.max_relative_frequency_error);
  if (estimate.max_relative_receptance_error > 0.0)
    text += fmt::format(", receptances within {:.1e}", estimate.max_relative_receptance_error);
  text += fmt::format(", {:g} was asked for", *estimate.tolerance);
  return estimate.held_back_by.empty() ? text : text + "; " + estimate.held_back_by;
}

}  // namespace thinwall::report
