#pragma once
// The sentence of an answer on a mesh whose estimated error is above the tolerance.

#include <string>

#include "report/summary/summary.hpp"

namespace thinwall::report {

/// "the tolerance is not met: frequencies of the part are within 2.1e-02 by estimate, 0.01 was asked for; the 24 s for
/// its solutions were over". Empty if the tolerance is met, or none was asked for.
[[nodiscard]] std::string tolerance_not_met(const Summary& summary);

}  // namespace thinwall::report
