#include "core/interrupt.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/time_limit.hpp"

namespace thinwall::core::interrupt_test {
namespace {

TEST(TimeLimit, EndsWhatLooksAtInterruptsAndNothingBeyondItsLife) {
  {
    const TimeLimit limit(0.0);
    EXPECT_THROW(
        {
          while (true) check_interrupt();
        },
        TimeIsOver);
  }
  EXPECT_NO_THROW(check_interrupt());
}

TEST(TimeLimit, AnInterruptComesBeforeIt) {
  const TimeLimit limit(0.0);
  request_interrupt();
  EXPECT_THROW(check_interrupt(), Interrupted);
  clear_interrupt();
}

}  // namespace
}  // namespace thinwall::core::interrupt_test
