#include "app/observed/calibrate_command.hpp"

#include <fmt/format.h>

#include <array>

#include "app/option_keys.hpp"

namespace thinwall::app {

namespace {

constexpr std::array<OptionKey, 5> keys_of_options{{{"calibration.draws", "--draws"},
                                                    {"calibration.seed", "--seed"},
                                                    {"calibration.folds", "--folds"},
                                                    {"calibration.risk", "--risk"},
                                                    {"calibration.spindle_speed", "--speed"}}};

}  // namespace

cases::Case calibrated_case(const std::string& path, std::vector<std::string> overrides,
                            const CalibrateRequest& request) {
  const std::size_t written = overrides.size();
  const auto put = [&](const std::string& key, const std::optional<int>& value) {
    if (value) overrides.push_back("calibration." + key + "=" + std::to_string(*value));
  };
  put("draws", request.draws);
  put("seed", request.seed);
  put("folds", request.folds);
  if (request.risk) overrides.push_back(fmt::format("calibration.risk={}", *request.risk));
  if (!request.speed.empty()) overrides.push_back("calibration.spindle_speed=" + request.speed);
  cases::Case source = read_with_options(path, overrides, written, keys_of_options);
  if (source.calibration) return source;
  overrides.emplace_back("calibration.seed=1");  // the table with its defaults
  return read_with_options(path, overrides, written, keys_of_options);
}

}  // namespace thinwall::app
