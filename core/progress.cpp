#include "core/progress.hpp"

#include <mutex>
#include <utility>

namespace thinwall::core {

namespace {

std::mutex listener_mutex;
ProgressListener the_listener;  // guarded by listener_mutex
std::atomic<bool> somebody_listens{false};
std::atomic<std::int64_t> interval_ns{0};
std::atomic<std::int64_t> next_report_ns{0};  // time of the steady clock before which no report is due
std::atomic<const Progress*> outermost_loop{nullptr};

}  // namespace

std::optional<double> seconds_left(const ProgressReport& report) {
  if (report.done == 0 || report.total < report.done) return std::nullopt;
  return report.seconds / static_cast<double>(report.done) * static_cast<double>(report.total - report.done);
}

void set_progress_listener(ProgressListener listener, std::chrono::milliseconds interval) {
  const std::scoped_lock lock(listener_mutex);
  interval_ns = std::chrono::nanoseconds(interval).count();
  next_report_ns = 0;
  somebody_listens = static_cast<bool>(listener);
  the_listener = std::move(listener);
}

Progress::Progress(const char* items, std::size_t total) : items_(items), total_(total) {
  const Progress* none = nullptr;
  outermost_ = outermost_loop.compare_exchange_strong(none, this);
}

Progress::~Progress() {
  if (outermost_) outermost_loop = nullptr;
}

void Progress::step() {
  const std::size_t done = done_.fetch_add(1, std::memory_order_relaxed) + 1;
  if (!outermost_ || !somebody_listens.load(std::memory_order_relaxed)) return;
  const Clock::time_point now = Clock::now();
  const std::int64_t now_ns = std::chrono::nanoseconds(now.time_since_epoch()).count();
  std::int64_t next = next_report_ns.load(std::memory_order_relaxed);
  const bool due = now_ns >= next && next_report_ns.compare_exchange_strong(next, now_ns + interval_ns.load());
  if (!due && done != total_) return;
  const std::scoped_lock lock(listener_mutex);
  if (the_listener) the_listener({items_, done, total_, std::chrono::duration<double>(now - start_).count()});
}

}  // namespace thinwall::core
