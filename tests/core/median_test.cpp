#include "core/median.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace thinwall::core {
namespace {

TEST(Median, IsTheValueInTheMiddleOrTheMeanOfTwo) {
  EXPECT_EQ(median({3.0, 1.0, 7.0}), 3.0);
  EXPECT_EQ(median({9.0, 1.0, 4.0, 2.0}), 3.0);
  EXPECT_EQ(median({5.0}), 5.0);
  EXPECT_TRUE(std::isnan(median({})));
}

}  // namespace
}  // namespace thinwall::core
