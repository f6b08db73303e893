#pragma once
// A request to stop the computation, set by a signal handler and polled between pieces of work.

namespace thinwall::core {

/// Asks the running computation to stop. Safe to call from a signal handler.
void request_interrupt() noexcept;

/// Forgets an earlier request (tests, repeated runs in one process).
void clear_interrupt() noexcept;

/// True once request_interrupt() was called.
[[nodiscard]] bool interrupt_requested() noexcept;

/// Throws Interrupted if a stop was requested, and TimeIsOver where a TimeLimit of this thread has passed
/// (core/time_limit.hpp). Cost: one relaxed atomic load, with a limit a reading of the clock.
void check_interrupt();

}  // namespace thinwall::core
