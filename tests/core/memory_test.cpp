#include "core/memory.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

namespace thinwall::core::memory_test {
namespace {

TEST(Memory, AvailableIsPositiveAndNoMoreThanTheMachineHas) {
  const double installed = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  EXPECT_GT(available_memory_bytes(), 0.0);
  EXPECT_LE(available_memory_bytes(), installed);
}

}  // namespace
}  // namespace thinwall::core::memory_test
