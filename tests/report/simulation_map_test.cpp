// A map of simulated vibration in files, summary and page: what is not to be trusted is not shown as good.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "io/results/csv_table.hpp"
#include "report/page/simulation_data.hpp"
#include "report/simulation/simulation_files.hpp"
#include "report/simulation/simulation_report.hpp"
#include "report/simulation/simulation_summary.hpp"
#include "tests/core/temporary_folder.hpp"
#include "tests/report/unpacked.hpp"

namespace thinwall::report::simulation_map_test {
namespace {

/// Two speeds and two depths: a good point, one whose forces did not settle, the largest of all, and one that outgrew
/// the cutter.
study::Results mapped() {
  study::Results results;
  results.setup.simulation = setup::Simulation{};
  study::AmplitudeMap map{setup::CutOn::tool,      {1000.0, 2000.0},        {1e-3, 2e-3},
                          Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero(), Eigen::Matrix2i::Zero()};
  map.peak_to_peak_m << 1e-6, 3e-6, 9e-6, INFINITY;
  map.unsettled(1, 0) = 1;
  results.amplitude_maps.push_back(map);
  return results;
}

TEST(SimulationMap, MarksWhatDidNotSettle) {
  const std::filesystem::path folder = tests::temporary_files() / "simulation_map";
  std::filesystem::remove_all(folder);
  const study::Results results = mapped();
  write_simulation(folder, results);
  const std::filesystem::path file = folder / "simulation" / "tool_map.csv";
  const io::Table table = io::read_csv(file);
  EXPECT_EQ(std::get<std::vector<std::string>>(table.back().values),
            (std::vector<std::string>{"completed", "unsettled", "completed", "overflowed"}));

  Summary summary;
  summary.simulation = simulation_summary(results);
  const AmplitudeMapSummary& map = summary.simulation->maps.at(0);
  EXPECT_EQ(map.points_unsettled, 1);
  EXPECT_EQ(map.points_outgrown, 1);
  EXPECT_EQ(map.largest_peak_to_peak_m, 3e-6);
  EXPECT_NE(simulation_text(summary).find("at 1 points forces within steps did not settle"), std::string::npos);

  const auto shown = unpacked<float>(simulation_data(folder, summary)["maps"][0]["peak_to_peak_m"]);
  ASSERT_EQ(shown.size(), 4U);
  EXPECT_TRUE(std::isnan(shown[1]) && std::isnan(shown[3])) << "neither has a colour";
  EXPECT_GT(shown[0], 0.0F);
}

}  // namespace
}  // namespace thinwall::report::simulation_map_test
