#pragma once
// The stages of a run and its long loops, shown on a terminal or in the log.

#include <chrono>
#include <string>

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

/// Shows each stage as it begins, and how far the loops within it are. One at a time: it listens to core::Progress.
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
  void show(const core::ProgressReport& report) const;
  void stage(const std::string& name);
  void write_line(const std::string& text) const;
  void clear_line() const;

  ProgressDisplay display_;
  Clock::time_point start_ = Clock::now();
  std::string current_;
};

}  // namespace thinwall::app
