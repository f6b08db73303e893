#pragma once
// Progress of a long loop: the loop counts its items, and a listener is told of the count from time to time.

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>

namespace thinwall::core {

/// The state of a loop.
struct ProgressReport {
  const char* items = "";  ///< name of the items: "speeds"
  std::size_t done = 0;
  std::size_t total = 0;
  double seconds = 0.0;  ///< time since the loop began
};

/// Seconds that the remaining items will take at the mean rate so far; empty before the first item is done.
[[nodiscard]] std::optional<double> seconds_left(const ProgressReport& report);

/// A function that receives the state of a loop.
using ProgressListener = std::function<void(const ProgressReport&)>;

/// Sets the function that receives reports of loops; an empty one ends the reports. It is called from whichever thread
/// completed an item, one call at a time, at most once in `interval` and at the end of each loop. After
/// set_progress_listener() has returned, no call of the earlier listener is running. An exception of the listener ends
/// the loop.
void set_progress_listener(ProgressListener listener,
                           std::chrono::milliseconds interval = std::chrono::milliseconds(100));

/// The progress of one loop; the loop lasts as long as the object lives. Of nested loops only the outermost is
/// reported.
///
///     core::Progress progress("speeds", rows.size());
///     core::parallel_for(rows.size(), [&](std::size_t i) { rows[i] = …; progress.step(); });
class Progress {
 public:
  Progress(const char* items, std::size_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Counts one more item as done. It may be called from any thread and costs an atomic addition, and, if a listener is
  /// set, a reading of the clock.
  void step();

 private:
  using Clock = std::chrono::steady_clock;

  const char* items_;
  std::size_t total_;
  Clock::time_point start_ = Clock::now();
  std::atomic<std::size_t> done_{0};
  bool outermost_ = false;
};

}  // namespace thinwall::core
