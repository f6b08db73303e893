#pragma once
// The report on a reduced or imported model for scripts.

#include <nlohmann/json.hpp>

#include "reduction/trust/model_report.hpp"

namespace thinwall::report {

/// reduction::report() as JSON: trustworthy, findings, frequencies_hz, rigid_body with mass, centre, inertia, effective
/// masses; names carry units. What is not finite is null.
[[nodiscard]] nlohmann::json report_json(const reduction::ReducedModelReport& report);

}  // namespace thinwall::report
