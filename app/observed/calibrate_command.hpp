#pragma once
// `thinwall calibrate`: what the cuts that were made teach of a case's chart.

#include <optional>
#include <string>
#include <vector>

#include "case/machining_case.hpp"

namespace thinwall::app {

/// The options of the command, each put over [calibration] of the case.
struct CalibrateRequest {
  std::optional<int> draws, seed, folds;
  std::optional<double> risk;
  std::string speed;  ///< "9000 rpm"; empty: as the case has it
};

/// The case with the options, and with [calibration] where it has none. Throws as cases::read_case().
[[nodiscard]] cases::Case calibrated_case(const std::string& path, std::vector<std::string> overrides,
                                          const CalibrateRequest& request);

}  // namespace thinwall::app
