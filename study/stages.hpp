#pragma once
// The stages of a run: announced, timed, interruptible; and how far the long loops within them are.

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "core/progress.hpp"

namespace thinwall::study {

/// How a run shows where it is.
enum class ProgressDisplay {
  none,   ///< not at all; the stages are in run.log
  lines,  ///< a line of the log for each stage, and every ten seconds of a long loop
  line,   ///< one line of the terminal's, overwritten: for stderr on a terminal only
};

/// "8 s", "3 min", "2 h": whole numbers, rounded up, for what is left.
[[nodiscard]] std::string duration_text(double seconds);

/// "lobes: 120 of 200 speeds, 8 s left"; the time left from the first second on, by the rate so far.
[[nodiscard]] std::string progress_text(const std::string& stage, const core::ProgressReport& report);

/// Announces each stage, shows what loops within it count, and keeps its wall time. One at a time: it listens to
/// core::Progress.
class Stages {
 public:
  explicit Stages(ProgressDisplay display);
  ~Stages();
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
  void show(const core::ProgressReport& report) const;
  void write_line(const std::string& text) const;
  void clear_line() const;

  ProgressDisplay display_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point stage_start_ = start_;
  std::string current_;
  std::vector<std::pair<std::string, double>> timings_;
};

}  // namespace thinwall::study
