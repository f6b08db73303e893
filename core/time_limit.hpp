#pragma once
// A bound on the time of a computation, seen wherever it looks at interrupts.

namespace thinwall::core {

/// The object that check_interrupt() throws once the time of a TimeLimit is over. It is no Error: only who set the
/// limit knows it.
struct TimeIsOver {};

/// Bounds what the calling thread computes while the object lives: the next check_interrupt() after `seconds` throws
/// TimeIsOver. Other threads, those of a core::parallel_for within among them, are not bounded. Not to be nested.
class TimeLimit {
 public:
  explicit TimeLimit(double seconds);
  ~TimeLimit();
  TimeLimit(const TimeLimit&) = delete;
  TimeLimit& operator=(const TimeLimit&) = delete;
};

}  // namespace thinwall::core
