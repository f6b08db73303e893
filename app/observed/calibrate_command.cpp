#include "app/observed/calibrate_command.hpp"

#include <fmt/format.h>

#include "case/reader.hpp"

namespace thinwall::app {

cases::Case calibrated_case(const std::string& path, std::vector<std::string> overrides,
                            const CalibrateRequest& request) {
  const auto put = [&](const std::string& key, const std::optional<int>& value) {
    if (value) overrides.push_back("calibration." + key + "=" + std::to_string(*value));
  };
  put("draws", request.draws);
  put("seed", request.seed);
  put("folds", request.folds);
  if (request.risk) overrides.push_back(fmt::format("calibration.risk={}", *request.risk));
  if (!request.speed.empty()) overrides.push_back("calibration.spindle_speed=" + request.speed);
  cases::Case source = cases::read_case(path, overrides);
  if (source.calibration) return source;
  overrides.emplace_back("calibration.seed=1");  // the table with its defaults
  return cases::read_case(path, overrides);
}

}  // namespace thinwall::app
