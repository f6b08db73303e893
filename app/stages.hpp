#pragma once
// The stages of a run: announced, timed, interruptible.

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace thinwall::app {

/// Announces each stage on the log (and with its number on a terminal) and keeps its wall time.
class Stages {
 public:
  /// `terminal`: overwrite one line on stderr instead of adding log lines.
  explicit Stages(bool terminal) : terminal_(terminal) {}
  ~Stages() { clear_line(); }
  Stages(const Stages&) = delete;
  Stages& operator=(const Stages&) = delete;

  /// Ends the stage before and begins this one. Stages of one name add up. Throws Interrupted if a stop was requested.
  void begin(const std::string& name);

  /// Ends the last stage.
  void end();

  /// Name and seconds of each stage, and "total" since construction.
  [[nodiscard]] std::vector<std::pair<std::string, double>> timings_s() const;

 private:
  using Clock = std::chrono::steady_clock;
  void clear_line() const;

  bool terminal_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point stage_start_ = start_;
  std::string current_;
  std::vector<std::pair<std::string, double>> timings_;
};

}  // namespace thinwall::app
