// The tool with which FRFs were measured, exchanged before they are fitted, against the machine with the other tool.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <utility>
#include <vector>

#include "app/fit/fit_command.hpp"
#include "core/error.hpp"
#include "io/frf/modal_table_csv.hpp"
#include "io/frf/response_csv.hpp"
#include "io/frf/uff.hpp"
#include "tests/system/machine_in_postures.hpp"

namespace thinwall::tests::swap_before_a_fit_test {
namespace {

using namespace swap_on_robot;

/// The frequencies and damping ratios of modes from 500 Hz to 3 kHz by rising frequency.
std::vector<std::pair<double, double>> modes_of(const dynamics::ModalTable& table) {
  std::vector<std::pair<double, double>> modes;
  for (const dynamics::ModalTableRow& row : table.rows) {
    if (row.frequency_hz > 500.0 && row.frequency_hz < 3000.0) modes.emplace_back(row.frequency_hz, row.damping_ratio);
  }
  std::ranges::sort(modes);
  return modes;
}

/// Files with the machine's FRFs with the rod and with the carbide tool, and with both tools.
class SwapBeforeAFit : public testing::Test {
 protected:
  SwapBeforeAFit() {
    write("rod.uff", with(reference(), dynamics::linear_axis(300.0, 3500.0, 801), four));
    std::ofstream(folder / "tools.toml") << for_a_fit;
  }
  static dynamics::ResponseModel with(const dynamics::SpatialModel& tool, const dynamics::FrequencyAxis& axis,
                                      const std::vector<std::string>& dofs) {
    return machine::only(dynamics::direct_response(assembled(1.0, tool), axis), dofs);
  }
  void write(const std::string& file, const dynamics::ResponseModel& response) const {
    io::write_uff(folder / file, response, {});
  }
  [[nodiscard]] FitRequest request(const std::string& file, const std::string& tools_file) const {
    FitRequest request;
    request.input.sources = {(folder / file).string()};
    if (!tools_file.empty()) request.swap = (folder / tools_file).string();
    request.order = 16;
    request.out = (folder / "fit").string();
    return request;
  }
  [[nodiscard]] std::vector<std::pair<double, double>> fitted(const FitRequest& request) const {
    const std::string said = fit_files(request);
    EXPECT_EQ(said.find("exchanged for") != std::string::npos, !request.swap.empty()) << said;
    return modes_of(io::read_modal_table(folder / "fit" / "modal_table.csv",
                                         {io::modal_unit("sqrt(s/kg)"), io::modal_unit("sqrt(s/kg)"), {}}));
  }
  /// Expects the fit with these tools to be refused with that part of a line.
  void refused(const std::string& text, const std::string& part) const {
    std::ofstream(folder / "wrong.toml") << text;
    try {
      (void)fit_files(request("rod.uff", "wrong.toml"));
      ADD_FAILURE() << "accepted, though " << part;
    } catch (const core::Error& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }

  const std::vector<std::string> four{"1.x", "1.y", "1a.x", "1a.y"};
  const std::string for_a_fit = replaced(tools(carbide), "to = \"6 kHz\"\n", "");
  const fs::path folder = own_folder();
};

/// FRFs with the rod whose rod is exchanged before the fit give the modes of the machine with the carbide tool.
TEST_F(SwapBeforeAFit, AnExchangeGivesTheModesOfTheOtherTool) {
  write("carbide.uff", with(target(), dynamics::linear_axis(300.0, 3500.0, 801), {"1.x", "1.y"}));
  const auto exchanged = fitted(request("rod.uff", "tools.toml")), wanted = fitted(request("carbide.uff", ""));
  ASSERT_EQ(exchanged.size(), wanted.size());
  EXPECT_GE(wanted.size(), 3U);
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    EXPECT_NEAR(exchanged[k].first, wanted[k].first, 1e-5 * wanted[k].first);
    EXPECT_NEAR(exchanged[k].second, wanted[k].second, 1e-4 * wanted[k].second);
  }
  EXPECT_THROW((void)fitted(request("carbide.uff", "tools.toml")), core::UsageError) << "one point alone";
}

/// A line at 0 Hz, where a free tool has no receptance, is left out by --from, and the order of the forces is free.
TEST_F(SwapBeforeAFit, AnExchangeTakesTheLinesOfTheBandAndForcesInAnyOrder) {
  dynamics::ResponseModel all = with(reference(), dynamics::linear_axis(0.0, 3500.0, 876), four);
  std::ranges::reverse(all.forces);
  for (Eigen::MatrixXcd& H : all.H) H = H.rowwise().reverse().eval();
  io::write_response(folder / "reversed.csv", all);
  FitRequest asked = request("reversed.csv", "tools.toml");
  asked.from = "300 Hz";
  const auto of_reversed = fitted(asked), of_band = fitted(request("rod.uff", "tools.toml"));
  ASSERT_EQ(of_reversed.size(), of_band.size());
  for (std::size_t k = 0; k < of_band.size(); ++k)
    EXPECT_NEAR(of_reversed[k].first, of_band[k].first, 1e-5 * of_band[k].first);
}

/// What a case refuses is refused here, too.
TEST_F(SwapBeforeAFit, AnExchangeRefusesKeysThatACaseRefuses) {
  refused(tools(carbide), "tool.swap.to is for a swap at the modes of a robot");
  refused(
      replaced(
          for_a_fit, "[cutting]",
          "[[tool.modes]]\nfrequency = \"900 Hz\"\ndamping_ratio = 0.02\nstiffness = \"1e7 N/m\"\ndirection = \"x\"\n"
          "[cutting]"),
      "stands in place of tool.modes");
  refused(replaced(for_a_fit, "outer_diameter = \"12 mm\"", "outer_diameter = \"12 mm\"\ninner_diameter = \"13 mm\""),
          "tool.swap.target[0].inner_diameter: 13 mm is no less than outer_diameter, 12 mm");
  refused(for_a_fit.substr(0, for_a_fit.find("[[tool.swap.target]]")), "needs [[tool.swap.target]]");
}

}  // namespace
}  // namespace thinwall::tests::swap_before_a_fit_test
