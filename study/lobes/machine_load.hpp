#pragma once
// The limits of the machine, held against a cut.

#include <optional>

#include "milling/chart/machine_limits.hpp"
#include "milling/chart/operating_point.hpp"
#include "setup/machining_setup.hpp"

namespace thinwall::study {

/// What a static chip asks of the machine; none without a feed, or if the end of the tool is not flat.
[[nodiscard]] std::optional<milling::CutLoad> load_of(const setup::CutSetup& source,
                                                      const milling::MillingProcess& process);

/// True of a cut within the limits of speed and, where its load is known, of feed rate, torque and power.
[[nodiscard]] bool can_do(const milling::MachineLimits& machine, const std::optional<milling::CutLoad>& load,
                          const milling::OperatingPoint& point);

}  // namespace thinwall::study
