#include "core/memory.hpp"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include "core/error.hpp"

namespace thinwall::core::memory_test {
namespace {

TEST(Memory, AvailableIsPositiveAndNoMoreThanTheMachineHas) {
  const double installed = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  EXPECT_GT(available_memory_bytes(), 0.0);
  EXPECT_LE(available_memory_bytes(), installed);
}

/// A limit that ends with the test.
struct Limit {
  explicit Limit(double bytes) { set_memory_limit(bytes); }
  ~Limit() { set_memory_limit(0.0); }
  Limit(const Limit&) = delete;
  Limit& operator=(const Limit&) = delete;
};

TEST(Memory, WhatIsLeftOfALimitIsWhatTheProcessDoesNotHold) {
  const double held = held_memory_bytes();
  EXPECT_GT(held, 1e6);
  const Limit limit(held + 2e8);
  const double left = memory_left_bytes();
  EXPECT_NEAR(left, 2e8, 5e7);
  constexpr std::size_t bytes = 100'000'000;
  void* more = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_POPULATE, -1, 0);
  EXPECT_NEAR(left - memory_left_bytes(), 1e8, 2e7);
  ::munmap(more, bytes);
}

TEST(Memory, AStageThatNeedsMoreThanIsLeftIsRefusedWithBothFigures) {
  const Limit limit(held_memory_bytes() + 2e8);
  EXPECT_NO_THROW(require_memory(1e8, "a matrix"));
  try {
    require_memory(1e9, "a matrix");
    FAIL() << "accepted";
  } catch (const NumericalError& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.find("a matrix needs 1 GB, and "), 0U) << text;
    EXPECT_NE(text.find("--memory"), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  }
}

TEST(Memory, WithoutALimitTheMachineIsTheLimit) {
  EXPECT_GE(memory_left_bytes(), 0.5 * available_memory_bytes());
  EXPECT_THROW(require_memory(1e18, "a matrix"), NumericalError);
}

}  // namespace
}  // namespace thinwall::core::memory_test
