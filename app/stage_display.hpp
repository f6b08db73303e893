#pragma once
// The stages of a run and its long loops, shown on a terminal or in the log.

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include "core/progress.hpp"
#include "study/stages.hpp"

namespace thinwall::app {

/// The ways in which a run shows where it is.
enum class ProgressDisplay {
  none,   ///< not at all; the stages are in run.log
  lines,  ///< a line of the log for each stage, and every ten seconds of a long loop
  line,   ///< one line of the terminal's, overwritten: for stderr on a terminal only
};

/// "8 s", "3 min", "2 h": whole numbers, rounded up, for what is left.
[[nodiscard]] std::string duration_text(double seconds);

/// "lobes: 120 of 200 speeds, 8 s left"; the time left from the first second on, by the rate so far.
[[nodiscard]] std::string progress_text(const std::string& stage, const core::ProgressReport& report);

/// Shows each stage as it begins, and how far the loops within it are; in a stage without a loop, that it goes on: its
/// time each second on a terminal's line, a line of the log every fifteen seconds. One at a time: it listens to
/// core::Progress.
class StageDisplay {
 public:
  explicit StageDisplay(ProgressDisplay display);
  ~StageDisplay();
  StageDisplay(const StageDisplay&) = delete;
  StageDisplay& operator=(const StageDisplay&) = delete;

  /// Tells this display of stages; not to be called after the display is gone.
  [[nodiscard]] study::StageListener listener();

 private:
  using Clock = std::chrono::steady_clock;
  void show(const core::ProgressReport& report);
  void stage(const std::string& name);
  void tell_that_it_goes_on(const std::stop_token& stop);
  void write_line() const;
  void clear_line() const;

  ProgressDisplay display_;
  Clock::time_point start_ = Clock::now();
  std::mutex mutex_;  // guards what follows, which the loops' threads and the ticker see, too
  std::string current_, text_;
  Clock::time_point stage_start_ = start_, told_ = start_;
  std::condition_variable_any stopped_;
  std::jthread ticker_;
};

}  // namespace thinwall::app
