// Limits of the draws of a posterior where some were not found.

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/messages.hpp"
#include "study/lobes/learned_chart.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::study {
namespace {

/// The rows of answered_rows(), and its warnings.
struct ToldRows {
  std::vector<LearnedChart::Row> rows;
  std::string told;
};

ToldRows told_rows(const std::vector<LimitsAtSpeed>& limits) {
  ToldRows result;
  const auto before =
      core::set_message_listener([&](core::MessageLevel, const std::string& text) { result.told += text; });
  result.rows = answered_rows(limits);
  core::set_message_listener(before);
  return result;
}

TEST(LearnedRows, LeaveOutDrawsWhoseCrossingWasMissedAndTellThem) {
  // Ten limits of 1 to 10 mm, two more that were not found: nine of ten are stable at 2 mm, as without the two.
  LimitsAtSpeed at{9000.0, 5e-3, {}};
  for (int i = 10; i >= 1; --i) at.of_draws.emplace_back(1e-3 * i);
  const ToldRows whole = told_rows({at});
  EXPECT_TRUE(whole.told.empty()) << whole.told;
  at.of_draws.insert(at.of_draws.begin() + 3, 2, std::nullopt);
  const ToldRows some = told_rows({at});
  ASSERT_EQ(some.rows.size(), 1u);
  EXPECT_EQ(some.rows[0].stable_90_m, 2e-3);
  EXPECT_EQ(some.rows[0].stable_90_m, whole.rows.at(0).stable_90_m);
  EXPECT_EQ(some.rows[0].median_m, whole.rows[0].median_m);
  EXPECT_NE(some.told.find("of 12 limits of draws 2 are left out"), std::string::npos) << some.told;
}

TEST(LearnedRows, HaveNoRowWhereMostDrawsOrTheNominalCutHaveNoLimit) {
  const LimitsAtSpeed few{8000.0, 1e-3, {1e-3, std::nullopt, std::nullopt}};
  const LimitsAtSpeed none{9000.0, std::nullopt, {1e-3, 1e-3}};
  const LimitsAtSpeed whole{10000.0, 1e-3, {1e-3, 2e-3}};
  const ToldRows result = told_rows({few, none, whole});
  ASSERT_EQ(result.rows.size(), 1u);
  EXPECT_EQ(result.rows[0].spindle_speed_rpm, 10000.0);
  EXPECT_NE(result.told.find("of 3 speeds 2 have no learned limit"), std::string::npos) << result.told;
}

/// The parameters of a tool of so many modes, each with three, and of three coefficients, and what was told.
struct ToldModel {
  learning::CutModel model;
  std::string told;
};

ToldModel told_model(int modes, std::optional<double> speed_exponent) {
  std::vector<milling::testing::Mode> list;
  for (int i = 0; i < modes; ++i) list.push_back({500.0 + 100.0 * i, 0.02, 0.3, Eigen::Vector3d::UnitX()});
  milling::Cut nominal;
  nominal.structure = milling::relative_structure(milling::testing::modal_model(list), "P");
  nominal.process.coefficients = {1.1e9, 2e8, 1e8};
  setup::CutSetup source;
  source.lobes.emplace().robust.emplace().uncertainty = {0.02, 0.1, 0.1, 0.1};
  source.observed = {{{}, {{9000.0, 1e-3, milling::CutOutcome::stable}}}};
  source.calibration.emplace().speed_exponent = speed_exponent;
  ToldModel result;
  const auto before =
      core::set_message_listener([&](core::MessageLevel, const std::string& text) { result.told += text; });
  try {
    result.model = cut_model(source, nominal, {});
  } catch (const core::InputError& error) {
    result.told += error.what();
  }
  core::set_message_listener(before);
  return result;
}

TEST(CutModel, TellsThatAUsualSpeedExponentHasNoRoomAndRefusesOneThatIsAskedFor) {
  EXPECT_EQ(told_model(6, std::nullopt).model.parameters.size(), 22u) << "18 of modes, 3 coefficients, the exponent";
  const ToldModel full = told_model(7, std::nullopt);
  EXPECT_EQ(full.model.parameters.size(), 24u);
  EXPECT_NE(full.told.find("no speed exponent, since 24 parameters are uncertain"), std::string::npos) << full.told;
  EXPECT_NE(told_model(7, 0.2).told.find("25 parameters are uncertain"), std::string::npos);
  EXPECT_EQ(told_model(7, 0.0).told, "");
}

}  // namespace
}  // namespace thinwall::study
