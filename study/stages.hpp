#pragma once
// The stages of a run: timed, interruptible, and told to whoever shows them.

#include <chrono>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace thinwall::study {

/// Hears the name of a stage when it begins, and an empty text when it has ended.
using StageListener = std::function<void(const std::string& stage)>;

/// Keeps the wall time of each stage and tells the listener of it.
class Stages {
 public:
  explicit Stages(StageListener listener = {}) : listener_(std::move(listener)) {}

  /// Ends the stage before and begins this one. Stages of one name add up. Throws Interrupted if a stop was requested.
  void begin(const std::string& name);

  /// Ends the last stage.
  void end();

  /// Name and seconds of each stage, and "total" since construction.
  [[nodiscard]] std::vector<std::pair<std::string, double>> timings_s() const;

 private:
  using Clock = std::chrono::steady_clock;

  StageListener listener_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point stage_start_ = start_;
  std::string current_;
  std::vector<std::pair<std::string, double>> timings_;
};

}  // namespace thinwall::study
