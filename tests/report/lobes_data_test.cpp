#include "report/page/lobes_data.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "io/results/csv_table.hpp"
#include "result_folder.hpp"
#include "unpacked.hpp"

namespace thinwall::report::lobes_data_test {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;
using Numbers = std::vector<double>;
using Words = std::vector<std::string>;

Summary summary() {
  Summary summary;
  summary.case_name = "small";
  summary.cutting.emplace();
  summary.cutting->teeth = 4;
  summary.cutting->depth_limit_m = 0.02;
  summary.lobes.emplace_back();
  summary.lobes[0].name = study::ChartOf::tool;
  summary.lobes[0].main_modes_hz = {855.0, 1610.0};
  summary.lobes[0].best_pockets = {{2000.0, 0.01, false, "stability", 8.0}};
  return summary;
}

void write_chart(const fs::path& folder, const Words& status) {
  io::write_csv(folder / "lobes" / "tool.csv", {{"spindle_speed_rpm", Numbers{1000.0, 2000.0, 3000.0}},
                                                {"limiting_depth_m", Numbers{0.001, 0.02, 1.0 / 3.0}},
                                                {"chatter_frequency_hz", Numbers{100.5, 0.0, 300.25}},
                                                {"bifurcation", Words{"hopf", "hopf", "flip"}},
                                                {"error_estimate_relative", Numbers{1e-5, 0.0, 2e-5}},
                                                {"status", status},
                                                {"truncation_m", Numbers{-1e-4, HUGE_VAL, 2e-4}}});
}

TEST(LobesData, TheArraysAreTheFile) {
  const fs::path folder = result_folder("lobes_arrays");
  write_chart(folder, {"converged", "stable_to_depth_limit", "node_limit_reached"});
  io::write_csv(folder / "lobes" / "tool_crossings.csv", {{"spindle_speed_rpm", Numbers{1000.0, 1000.0}},
                                                          {"depth_m", Numbers{0.001, 0.004}},
                                                          {"chatter_frequency_hz", Numbers{100.5, 120.0}},
                                                          {"bifurcation", Words{"hopf", "flip"}}});
  const json run = lobes_data(folder, summary());
  const json& chart = run["lobes"][0];
  EXPECT_EQ(unpacked<double>(chart["rpm"]), (Numbers{1000.0, 2000.0, 3000.0}));
  EXPECT_EQ(unpacked<double>(chart["depth_m"]), (Numbers{0.001, 0.02, 1.0 / 3.0}));
  EXPECT_EQ(unpacked<float>(chart["chatter_hz"])[2], 300.25F);
  EXPECT_NEAR(unpacked<float>(chart["truncation_m"])[0], -1e-4, 1e-8);
  EXPECT_TRUE(std::isnan(unpacked<float>(chart["truncation_m"])[1])) << "not known";
  EXPECT_EQ(chart["kind"], (Words{"hopf", "hopf", "flip"}));
  EXPECT_EQ(chart["status"], (Words{"converged", "stable_to_depth_limit", "not_converged"}));
  write_chart(folder, {"data_limited", "data_insufficient", "converged"});
  EXPECT_EQ(lobes_data(folder, summary())["lobes"][0]["status"], (Words{"converged", "not_converged", "converged"}));
  EXPECT_EQ(unpacked<double>(chart["crossings"]["depth_m"]), (Numbers{0.001, 0.004}));
  EXPECT_EQ(chart["tooth_passing_hz"], (Numbers{855.0, 1610.0}));
  EXPECT_DOUBLE_EQ(run["cutting"]["removal_cm3_per_min_per_m_rpm"].get<double>(), 8.0 / (0.01 * 2000.0));
}

TEST(LobesData, AChartWithoutAnyCrossingIsShown) {
  const fs::path folder = result_folder("lobes_stable");
  write_chart(folder, {"stable_to_depth_limit", "stable_to_depth_limit", "stable_to_depth_limit"});
  io::write_csv(folder / "lobes" / "tool_crossings.csv", {{"spindle_speed_rpm", Numbers{}},
                                                          {"depth_m", Numbers{}},
                                                          {"chatter_frequency_hz", Numbers{}},
                                                          {"bifurcation", Words{}}});
  const json chart = lobes_data(folder, summary())["lobes"][0];
  EXPECT_TRUE(unpacked<double>(chart["crossings"]["depth_m"]).empty());
  EXPECT_EQ(chart["crossings"]["kind"], json::array());
}

TEST(LobesData, RobustLimitsAndOtherMethodsAreThereWhereTheCaseAsksForThem) {
  const fs::path folder = result_folder("lobes_asked");
  const io::Table limits{
      {"spindle_speed_rpm", Numbers{1000.0, 2000.0}},   {"limiting_depth_m", Numbers{0.001, 0.002}},
      {"chatter_frequency_hz", Numbers{100.5, 110.0}},  {"bifurcation", Words{"hopf", "hopf"}},
      {"error_estimate_relative", Numbers{1e-5, 2e-5}}, {"status", Words{"converged", "not_converged"}}};
  io::Table robust = limits;
  robust.push_back({"robust_depth_m", Numbers{0.0008, 0.0}});
  io::write_csv(folder / "lobes" / "tool.csv", robust);
  Summary with = summary();
  EXPECT_FALSE(lobes_data(folder, with)["lobes"][0].contains("compared"));
  with.lobes[0].compared.resize(2);
  with.lobes[0].compared[0].name = "zeroth_order";
  with.lobes[0].compared[1].name = "left_out";
  io::write_csv(folder / "lobes" / "tool_zeroth_order.csv", limits);
  const json chart = lobes_data(folder, with)["lobes"][0];
  EXPECT_NEAR(unpacked<float>(chart["robust_depth_m"])[0], 0.0008, 1e-8);
  EXPECT_EQ(unpacked<float>(chart["robust_depth_m"])[1], 0.0F) << "not robust at any depth";
  ASSERT_EQ(chart["compared"].size(), 1U) << "a file that is gone is left out";
  EXPECT_EQ(chart["compared"][0]["name"], "zeroth_order");
  EXPECT_EQ(unpacked<double>(chart["compared"][0]["rpm"]), (Numbers{1000.0, 2000.0}));
  EXPECT_NEAR(unpacked<float>(chart["compared"][0]["depth_m"])[1], 0.002, 1e-7) << "rounded for a picture";
  EXPECT_EQ(chart["compared"][0]["status"], (Words{"converged", "not_converged"}));
}

TEST(LobesData, ForcedMotionIsACurveADepthWithGapsWhereTheCutChatters) {
  const fs::path folder = result_folder("lobes_forced");
  write_chart(folder, {"converged", "converged", "converged"});
  EXPECT_FALSE(lobes_data(folder, summary())["lobes"][0].contains("forced"));
  io::write_csv(folder / "lobes" / "tool_forced.csv",
                {{"depth_m", Numbers{1e-3, 1e-3, 2e-3, 2e-3}},
                 {"spindle_speed_rpm", Numbers{1000.0, 2000.0, 1000.0, 2000.0}},
                 {"verdict", Words{"stable", "chatter", "chatter", "stable"}},
                 {"surface_location_error_m", Numbers{1e-5, NAN, NAN, -2e-5}, true},
                 {"peak_force_n", Numbers{100.0, NAN, NAN, 200.0}, true}});
  const json curves = lobes_data(folder, summary())["lobes"][0]["forced"];
  ASSERT_EQ(curves.size(), 2U);
  EXPECT_EQ(curves[1]["depth_m"], 2e-3);
  EXPECT_EQ(unpacked<double>(curves[0]["rpm"]), (Numbers{1000.0, 2000.0}));
  EXPECT_EQ(unpacked<float>(curves[0]["peak_force_n"])[0], 100.0F);
  EXPECT_TRUE(std::isnan(unpacked<float>(curves[0]["peak_force_n"])[1]));
  EXPECT_TRUE(std::isnan(unpacked<float>(curves[1]["surface_location_error_m"])[0]));
  EXPECT_NEAR(unpacked<float>(curves[1]["surface_location_error_m"])[1], -2e-5, 1e-9);
  EXPECT_FALSE(curves[0].contains("least_contact_force_n"));
}

TEST(LobesData, ForcesOverAPeriodBelongToTheirOperatingPoint) {
  const fs::path folder = result_folder("lobes_forces");
  write_chart(folder, {"converged", "converged", "converged"});
  io::write_csv(folder / "lobes" / "tool_forces.csv", {{"point", Numbers{2, 2, 2}},
                                                       {"rotation_rad", Numbers{0.0, 0.5, 1.5}},
                                                       {"force_feed_n", Numbers{1.0, 2.0, 3.0}},
                                                       {"force_normal_n", Numbers{-1.0, -2.0, -3.0}},
                                                       {"force_axis_n", Numbers{0.0, 0.5, 0.0}},
                                                       {"torque_n_m", Numbers{0.1, 0.2, 0.3}}});
  Summary with = summary();
  EXPECT_THROW((void)lobes_data(folder, with), core::DataError) << "of a point that the summary does not have";
  with.operating_points.resize(3);
  with.operating_points[0].chart = with.operating_points[2].chart = study::ChartOf::tool;
  with.operating_points[1].chart = study::ChartOf::part;
  with.operating_points[2].spindle_speed_rpm = 7000.0;
  with.operating_points[2].depth_m = 2e-3;
  const json forces = lobes_data(folder, with)["lobes"][0]["forces"];
  ASSERT_EQ(forces.size(), 1U);
  EXPECT_EQ(forces[0]["spindle_speed_rpm"], 7000.0) << "the second of its own chart";
  EXPECT_EQ(forces[0]["depth_m"], 2e-3);
  EXPECT_EQ(unpacked<float>(forces[0]["rotation_rad"]), (std::vector<float>{0.0F, 0.5F, 1.5F}));
  EXPECT_EQ(unpacked<float>(forces[0]["force_normal_n"]), (std::vector<float>{-1.0F, -2.0F, -3.0F}));
}

TEST(LobesData, OfAPathAreRowsOfPositions) {
  const fs::path folder = result_folder("lobes_path");
  write_chart(folder, {"converged", "converged", "converged"});
  io::write_csv(folder / "lobes" / "tool_path.csv", {{"position", Numbers{1, 1, 2, 2, 3, 3}},
                                                     {"x_m", Numbers{0, 0, 0, 0, 0, 0}},
                                                     {"y_m", Numbers{0.1, 0.1, 0.2, 0.2, 0.3, 0.3}},
                                                     {"z_m", Numbers{0, 0, 0, 0, 0, 0}},
                                                     {"spindle_speed_rpm", Numbers{900, 950, 900, 950, 900, 950}},
                                                     {"limiting_depth_m", Numbers{1, 2, 3, 4, 5, 6}}});
  const json path = lobes_data(folder, summary())["paths"][0];
  EXPECT_EQ(path["depth_m"]["shape"], (std::vector<int>{3, 2}));
  EXPECT_EQ(unpacked<float>(path["depth_m"]), (std::vector<float>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(unpacked<double>(path["rpm"]), (Numbers{900, 950}));
  EXPECT_EQ(unpacked<double>(path["positions"])[4], 0.2);
}

TEST(LobesData, AColumnThatIsMissingIsNamed) {
  const fs::path folder = result_folder("lobes_missing");
  io::write_csv(folder / "lobes" / "tool.csv", {{"spindle_speed_rpm", Numbers{1000.0}}});
  try {
    (void)lobes_data(folder, summary());
    FAIL();
  } catch (const core::DataError& error) {
    EXPECT_NE(std::string(error.what()).find("tool.csv"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace thinwall::report::lobes_data_test
