#include "core/split.hpp"

#include <gtest/gtest.h>

namespace thinwall::core::split_test {
namespace {

using Parts = std::vector<std::string>;

TEST(Split, KeepsEmptyParts) {
  EXPECT_EQ(split("49 Hz:51 Hz", ':'), (Parts{"49 Hz", "51 Hz"}));
  EXPECT_EQ(split("a,,b,", ','), (Parts{"a", "", "b", ""}));
  EXPECT_EQ(split("alone", '|'), Parts{"alone"});
  EXPECT_EQ(split("", ','), Parts{});
  EXPECT_EQ(split(",", ','), (Parts{"", ""}));
}

}  // namespace
}  // namespace thinwall::core::split_test
