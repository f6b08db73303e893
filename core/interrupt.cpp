#include "core/interrupt.hpp"

#include <atomic>
#include <chrono>

#include "core/error.hpp"
#include "core/time_limit.hpp"

namespace thinwall::core {

namespace {

using Clock = std::chrono::steady_clock;

std::atomic<bool> requested{false};
thread_local bool limited = false;
thread_local Clock::time_point limit;  // of this thread, where it is limited

}  // namespace

void request_interrupt() noexcept {
  requested.store(true, std::memory_order_relaxed);
}
void clear_interrupt() noexcept {
  requested.store(false, std::memory_order_relaxed);
}
bool interrupt_requested() noexcept {
  return requested.load(std::memory_order_relaxed);
}

void check_interrupt() {
  if (interrupt_requested()) throw Interrupted();
  if (limited && Clock::now() > limit) throw TimeIsOver();
}

TimeLimit::TimeLimit(double seconds) {
  limit = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  limited = true;
}
TimeLimit::~TimeLimit() {
  limited = false;
}

}  // namespace thinwall::core
