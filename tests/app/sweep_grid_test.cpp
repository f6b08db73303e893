// The grid of a sweep: values as one writes them, points in their order, shards.

#include "app/sweep/sweep_grid.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/error.hpp"

namespace thinwall::tests::sweep_grid_test {

using namespace app;

namespace {

using Texts = std::vector<std::string>;

TEST(SweepGrid, ValuesAreThoseThatOneWouldWrite) {
  const SweepAxis axis = sweep_axis("part.thickness=4 mm:8 mm:0.5 mm");
  EXPECT_EQ(axis.values, (Texts{"4 mm", "4.5 mm", "5 mm", "5.5 mm", "6 mm", "6.5 mm", "7 mm", "7.5 mm", "8 mm"}));
  EXPECT_EQ(axis.title(), "part.thickness [mm]");
  EXPECT_EQ(axis.entry(1), "4.5");
  EXPECT_EQ(sweep_axis("damping.ratio=0.1:0.3:0.1").values, (Texts{"0.1", "0.2", "0.3"}));
  EXPECT_EQ(sweep_axis("damping.ratio=-0.2:0.2:0.1").values, (Texts{"-0.2", "-0.1", "0", "0.1", "0.2"}));
  EXPECT_EQ(sweep_axis("damping.ratio=1 %:2 %:0.5 %").values, (Texts{"1 %", "1.5 %", "2 %"}));
  EXPECT_EQ(sweep_axis("tool.teeth=6:2:-2").values, (Texts{"6", "4", "2"}));
  EXPECT_EQ(sweep_axis("cutting.spindle_speed=1000 rpm:3000 rpm:1000 rpm").values,
            (Texts{"1000 rpm", "2000 rpm", "3000 rpm"}));
}

TEST(SweepGrid, UnitsMayDifferAndTheFirstIsKept) {
  EXPECT_EQ(sweep_axis("part.thickness=1 mm:0.2 cm:250 um").values,
            (Texts{"1 mm", "1.25 mm", "1.5 mm", "1.75 mm", "2 mm"}));
}

TEST(SweepGrid, TheLastValueIsThereOnlyWhereItLiesOnTheGrid) {
  EXPECT_EQ(sweep_axis("part.thickness=1 mm:2 mm:0.3 mm").values, (Texts{"1 mm", "1.3 mm", "1.6 mm", "1.9 mm"}));
  EXPECT_EQ(sweep_axis("part.thickness=5 mm:5 mm:1 mm").values, (Texts{"5 mm"}));
  const auto thousand = sweep_axis("part.thickness=0 mm:100 mm:0.1 mm").values;
  ASSERT_EQ(thousand.size(), 1001U);
  EXPECT_EQ(thousand[3], "0.3 mm");
  EXPECT_EQ(thousand.back(), "100 mm");
}

TEST(SweepGrid, ListsAreTakenAsTheyStand) {
  const SweepAxis methods = sweep_axis("lobes.method=direct, zeroth_order");
  EXPECT_EQ(methods.values, (Texts{"direct", "zeroth_order"}));
  EXPECT_EQ(methods.title(), "lobes.method");
  const SweepAxis depths = sweep_axis("part.element_size=8 mm, 6 mm");
  EXPECT_EQ(depths.key, "part.mesh.element_size");
  EXPECT_EQ(depths.title(), "part.mesh.element_size [mm]");
  EXPECT_EQ(depths.numbers, (std::vector<double>{8.0, 6.0}));
  EXPECT_EQ(sweep_axis("points.P.at=[1, 0.5, 0.9], [1, 0.5, 1]").values, (Texts{"[1, 0.5, 0.9]", "[1, 0.5, 1]"}));
}

TEST(SweepGrid, ARangeWithoutAStepIsAnsweredWithHowOneIsWritten) {
  try {
    (void)sweep_axis("part.thickness=2 mm - 4 mm");
    FAIL() << "no error";
  } catch (const core::UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("write part.thickness=\"2 mm:4 mm:STEP\""), std::string::npos)
        << error.what();
  }
}

TEST(SweepGrid, WhatMakesNoGridIsAUsageError) {
  for (const auto* text :
       {"part.thickness", "=1", "part.thickness=", "part.thicknes=1 mm", "part.thickness=1 mm:2 mm",
        "part.thickness=1 mm:2 mm:0 mm", "part.thickness=1 mm:2 mm:-1 mm", "part.thickness=1 mm:2 mm:1 kg",
        "part.thickness=1 mm:2 mm:1 nm", "part.thickness=a:b:c", "part.thickness=1 mm,,2 mm"}) {
    EXPECT_THROW((void)sweep_axis(text), core::UsageError) << text;
  }
  EXPECT_THROW((void)sweep_axes({"part.length=1 m", "part.length=2 m"}), core::UsageError);
  EXPECT_THROW((void)sweep_axes({}), core::UsageError);
  for (const auto* text : {"0/4", "5/4", "a/4", "2", "1/0", "-1/4", "1/4/2"})
    EXPECT_THROW((void)shard_of(text), core::UsageError) << text;
}

TEST(SweepGrid, TheLastKeyGoesFastestAndShardsShareThePoints) {
  const auto axes = sweep_axes({"tool.teeth=2, 4", "part.thickness=1 mm:3 mm:1 mm"});
  const auto points = grid_points(axes);
  ASSERT_EQ(points.size(), 6U);
  EXPECT_EQ(overrides_at(axes, points[1]), (Texts{"tool.teeth=2", "part.thickness=2 mm"}));
  EXPECT_EQ(overrides_at(axes, points[3]), (Texts{"tool.teeth=4", "part.thickness=1 mm"}));
  for (std::size_t number = 1; number <= points.size(); ++number) {
    int holders = 0;
    for (const auto* shard : {"1/4", "2/4", "3/4", "4/4"}) holders += shard_of(shard).holds(number) ? 1 : 0;
    EXPECT_EQ(holders, 1) << number;
  }
  EXPECT_TRUE(shard_of("2/4").holds(2));
  EXPECT_TRUE(shard_of("4/4").holds(4));
}

}  // namespace
}  // namespace thinwall::tests::sweep_grid_test
