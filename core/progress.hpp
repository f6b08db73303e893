#pragma once
// How far a long loop is, for whoever shows it: the loop counts, a listener hears of it now and then.

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>

namespace thinwall::core {

/// The state of a loop.
struct ProgressReport {
  const char* items = "";  ///< what it counts: "speeds"
  std::size_t done = 0;
  std::size_t total = 0;
  double seconds = 0.0;  ///< since it began
};

/// Seconds that the rest will take at the rate so far; none before the first item.
[[nodiscard]] std::optional<double> seconds_left(const ProgressReport& report);

/// Hears of a loop's state.
using ProgressListener = std::function<void(const ProgressReport&)>;

/// From now on `listener` hears of loops, from whichever thread did the item, one call at a time, at most once in
/// `interval` and at the end of each loop; an empty one ends that, and after the call none is under way. What it throws
/// ends the loop.
void set_progress_listener(ProgressListener listener,
                           std::chrono::milliseconds interval = std::chrono::milliseconds(100));

/// One loop, for as long as it lives. Of loops within loops the outermost is told of.
///
///     core::Progress progress("speeds", rows.size());
///     core::parallel_for(rows.size(), [&](std::size_t i) { rows[i] = …; progress.step(); });
class Progress {
 public:
  Progress(const char* items, std::size_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// One more item is done. From any thread; an atomic addition, and with a listener a look at the clock.
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
