// Power laws of materials from published specific forces: the printed numbers, the middle of sources, and their use.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "case/checks/doubts.hpp"
#include "case/problem.hpp"
#include "case/reader.hpp"
#include "case/schema/schema.hpp"
#include "case/writer.hpp"
#include "core/atomic_file.hpp"
#include "setup/materials/cut_materials.hpp"
#include "setup/materials/specific_forces.hpp"
#include "setup/milling_process.hpp"

namespace thinwall::cases::specific_force_test {
namespace {

const std::string with_feed = "\nfeed_per_tooth = \"0.2 mm\"";

Case case_with(const std::string& cutting) {
  return parse_case(R"([tool]
teeth = 2
diameter = "10 mm"
length = "5 mm"
[[tool.modes]]
frequency = "922 Hz"
damping_ratio = 0.03
stiffness = "1.34e6 N/m"
direction = "x"
[cutting]
radial_depth = "10 mm"
feed_direction = "x"
tool_axis = "z"
)" + cutting + "\n[lobes]\nfrom = \"9000 rpm\"\nto = \"16000 rpm\"\n",
                    ".");
}

/// The doubt that is told of cutting.material.
std::string told_of(const Case& source) {
  for (const std::string& doubt : doubts_about(source))
    if (doubt.starts_with("cutting.material")) return doubt;
  return "";
}

TEST(SpecificForces, OfTwoFeedsGoThroughBoth) {
  // 2000 N/mm² at 0.1 mm and 1000 N/mm² at 0.4 mm: m = ln 2/ln 4 = 1/2, and k_1 = 1000 √0.4.
  const double chips[] = {0.1e-3, 0.4e-3}, forces[] = {2000e6, 1000e6};
  const auto law = setup::kienzle_constants({"", 0.0, 0.0, chips, forces, ""});
  EXPECT_NEAR(law.exponent, 0.5, 1e-12);
  EXPECT_NEAR(law.k_1, 1000e6 * std::sqrt(0.4), 1e-3);
}

TEST(SpecificForces, OfEveryTableAreNearTheirPowerLaw) {
  // The printed tables are rounded and smooth. Every wrong thousand leaves its line by more than 8 %, and of wrong
  // hundreds seven in ten do; wrong tens and ones hardly ever do.
  for (const setup::AlloyClasses& alloy : setup::alloy_classes()) {
    for (const setup::PublishedSpecificForce* published : alloy.classes) {
      const auto law = setup::kienzle_constants(*published);
      EXPECT_GT(law.exponent, 0.0) << published->material_class;
      EXPECT_LT(law.exponent, 0.5) << published->material_class;
      ASSERT_EQ(published->chips.size(), published->forces.size());
      EXPECT_TRUE(std::ranges::is_sorted(published->chips));
      for (std::size_t i = 0; i < published->forces.size(); ++i) {
        EXPECT_NEAR(law.k_1 * std::pow(published->chips[i] / 1e-3, -law.exponent) / published->forces[i], 1.0, 0.08)
            << published->material_class << " of " << published->source << ", number " << i;
      }
    }
  }
}

TEST(SpecificForces, HaveASourceAndAClassAndAreChoicesOfTheCase) {
  std::string names;
  for (const setup::AlloyClasses& alloy : setup::alloy_classes()) {
    names += (names.empty() ? "" : "|") + std::string(alloy.material);
    ASSERT_FALSE(alloy.classes.empty());
    for (const setup::PublishedSpecificForce* published : alloy.classes) {
      EXPECT_FALSE(published->source.empty());
      EXPECT_FALSE(published->material_class.empty());
    }
  }
  EXPECT_EQ(names, std::ranges::find(case_schema().keys, "cutting.material", &Key::path)->choices);
  EXPECT_GE(setup::alloy_classes().size(), 20U);
  for (const setup::PublishedCut& cut : setup::published_cuts()) EXPECT_TRUE(setup::power_law_of(cut.material));
  EXPECT_FALSE(setup::power_law_of("unobtainium"));
}

TEST(SpecificForces, HaveTheirRowInTheDocs) {
  const std::string page =
      core::read_file(std::filesystem::path(THINWALL_SOURCE_DIR) / "docs" / "theory" / "cutting.md");
  for (const setup::AlloyClasses& alloy : setup::alloy_classes()) {
    const auto middle = setup::power_law_of(alloy.material).value();
    const std::string row = fmt::format("| {} | **{:.0f}, {:.3f}** | {:.0f} % |", alloy.material, middle.K_t / 1e6,
                                        middle.exponent, 100.0 * middle.spread);
    const auto at = page.find(row);
    ASSERT_NE(at, std::string::npos) << row;
    const std::string line = page.substr(at, page.find('\n', at) - at);
    for (const setup::PublishedSpecificForce* published : alloy.classes) {
      const auto law = setup::kienzle_constants(*published);
      const std::string source =
          fmt::format("{} ({:.0f}, {:.3f})", published->material_class, law.k_1 / 1e6, law.exponent);
      EXPECT_NE(line.find(source), std::string::npos) << source;
    }
  }
}

TEST(SpecificForces, OfAnAlloyAreTheMiddleOfItsSourcesAtEveryChip) {
  const auto middle = setup::power_law_of("Ti6Al4V").value();  // 2110 and 0.22, 1245 and 0.24, as printed
  EXPECT_EQ(middle.sources, 2);
  EXPECT_NEAR(middle.K_t, std::sqrt(2110e6 * 1245e6), 1.0);
  EXPECT_NEAR(middle.exponent, 0.23, 1e-12);
  // |ln(a/b)|/√2 of the forces at 0.1 mm.
  EXPECT_NEAR(middle.spread, (std::log(2110.0 / 1245.0) - 0.02 * std::log(10.0)) / std::sqrt(2.0), 1e-12);
  EXPECT_EQ(middle.thinnest_chip_m, 0.0) << "no source prints the chips";
  EXPECT_EQ(setup::power_law_of("C45")->thinnest_chip_m, 0.1e-3);
}

TEST(SpecificForces, OfFewSourcesHaveThePooledSpreadAtLeast) {
  const auto pooled = setup::pooled_spread();
  EXPECT_EQ(setup::power_law_of("Inconel718")->spread, pooled);
  EXPECT_EQ(setup::power_law_of("Inconel718")->sources, 1);
  EXPECT_EQ(setup::power_law_of("S235")->spread, pooled) << "three tables that agree within 2 %";
  EXPECT_GT(setup::power_law_of("Al5083")->spread, pooled);
  EXPECT_GT(pooled, 0.1);
  EXPECT_LT(pooled, 0.5);
}

TEST(SpecificForces, FillInThePowerLawOfAMaterialThatHasNoOther) {
  const auto middle = setup::power_law_of("C45").value();
  const Case source = case_with("material = \"C45\"" + with_feed);
  EXPECT_EQ(source.cutting->law, setup::ForceLawKind::power);
  EXPECT_EQ(source.cutting->Kt, middle.K_t);
  EXPECT_EQ(source.cutting->Kr, setup::usual_radial_share() * middle.K_t);
  EXPECT_EQ(source.cutting->exponents, std::vector<double>(3, middle.exponent));
  ASSERT_TRUE(source.lobes->robust);
  // One spread stands for all coefficients, the larger one: that of ln K_r = ln K_t + ln share, of 0.81 by six tools.
  EXPECT_EQ(source.lobes->robust->uncertainty.coefficients, middle.spread_with_radial);
  EXPECT_NEAR(middle.spread_with_radial, std::hypot(middle.spread, 0.81), 2e-3);
  // The tangent of a slot at its mean chip, f_z 2/π: (1 − m) k_1 (h/1 mm)^−m.
  const auto process = setup::milling_process(source);
  const double chip_mm = 0.2 * 2.0 / M_PI;
  EXPECT_NEAR(process.coefficients.K_t / ((1.0 - middle.exponent) * middle.K_t * std::pow(chip_mm, -middle.exponent)),
              1.0, 1e-6)
      << "the mean chip is integrated by steps";
  // The resolved case reads as the same one.
  const Case again = parse_case(resolved_text(source), ".");
  EXPECT_EQ(again.cutting->exponents, source.cutting->exponents);
  EXPECT_EQ(again.cutting->Kr, source.cutting->Kr);
}

TEST(SpecificForces, TellTheirSourcesAndWhatIsNotPublished) {
  const std::string steel = told_of(case_with("material = \"C45\"" + with_feed));
  EXPECT_NE(steel.find("the middle of 2 published tables of its class"), std::string::npos) << steel;
  EXPECT_NE(steel.find("Kr 381.7 MPa is not published"), std::string::npos) << steel;
  EXPECT_NE(steel.find("85 %, which the robust chart takes"), std::string::npos) << steel;
  const std::string nickel = told_of(case_with("material = \"Inconel718\"\nKr = \"900 N/mm^2\"" + with_feed));
  EXPECT_NE(nickel.find("that of one published table"), std::string::npos) << nickel;
  EXPECT_NE(nickel.find("range of chip thickness is not published"), std::string::npos) << nickel;
  EXPECT_EQ(nickel.find("Kr"), std::string::npos) << nickel;
  EXPECT_NE(nickel.find("25 %, which the robust chart takes; the range"), std::string::npos)
      << "that of Kt alone: " << nickel;
}

TEST(SpecificForces, BesideAKtOfOnesOwnAreToldAndTheShareIsOfThatKt) {
  const std::string own = "material = \"C45\"\nlaw = \"power\"\nKt = \"3000 N/mm^2\"" + with_feed;
  const Case source = case_with(own);
  EXPECT_NEAR(source.cutting->Kr, setup::usual_radial_share() * 3000e6, 1e-3);
  EXPECT_FALSE(find(source.values, "cutting.thinnest_chip")) << "that of the tables is not that of this Kt";
  EXPECT_FALSE(source.lobes->robust);
  const std::string told = told_of(source);
  EXPECT_NE(told.find("the exponent 0.18 is the middle of 2 published tables"), std::string::npos) << told;
  EXPECT_NE(told.find("Kr 776"), std::string::npos) << told;
  EXPECT_NE(told.find("beside a Kt of your own"), std::string::npos) << told;
  EXPECT_EQ(told_of(case_with(own + "\nKr = \"900 N/mm^2\"\nexponents = [0.25]")), "");
}

TEST(SpecificForces, AreFlaggedForChipsThinnerThanThePrintedOnes) {
  const auto told = [](const std::string& feed) {
    const auto doubts = doubts_about(case_with("material = \"C45\"\nfeed_per_tooth = \"" + feed + "\""));
    return std::ranges::any_of(doubts, [](const std::string& doubt) {
      return doubt.starts_with("the mean chip is") && doubt.ends_with("the law is extrapolated there");
    });
  };
  // The tables begin at a feed of 0.1 mm, where the mean chip of a slot is that of theirs.
  EXPECT_TRUE(told("0.099 mm"));
  EXPECT_FALSE(told("0.1 mm"));
}

TEST(SpecificForces, ServeTheLawThatIsAskedFor) {
  const Case power = case_with("material = \"Al7075-T6\"\nlaw = \"power\"" + with_feed);
  EXPECT_EQ(power.cutting->Kt, setup::power_law_of("Al7075-T6")->K_t);
  const Case linear = case_with("material = \"Al7075-T6\"" + with_feed);
  EXPECT_EQ(linear.cutting->law, setup::ForceLawKind::linear);
  EXPECT_EQ(linear.cutting->Kt, setup::coefficients_of("Al7075-T6")->K_t);
}

/// The message of a case that is refused.
std::string refusal_of(const std::string& cutting) {
  try {
    (void)case_with(cutting);
  } catch (const CaseError& error) {
    return error.what();
  }
  return "";
}

TEST(SpecificForces, RefuseTheLinearLawAndAMissingFeed) {
  const std::string linear = refusal_of("material = \"C45\"\nlaw = \"linear\"\nKt = \"2000 N/mm^2\"");
  EXPECT_NE(linear.find("C45 is published for the power law only"), std::string::npos) << linear;
  const std::string own = refusal_of("material = \"C45\"\nKt = \"2000 N/mm^2\"" + with_feed);
  EXPECT_NE(own.find("write cutting.law = \"power\""), std::string::npos) << "a Kt of unsaid law: " << own;
  const std::string no_feed = refusal_of("material = \"C45\"");
  EXPECT_NE(no_feed.find("cutting.material"), std::string::npos) << no_feed;
  EXPECT_NE(no_feed.find("depends on the feed"), std::string::npos) << no_feed;
}

TEST(SpecificForces, RefuseExponentsWithoutTheKtToWhichTheyBelong) {
  const std::string refused = refusal_of("material = \"C45\"\nexponents = [0.5]" + with_feed);
  EXPECT_NE(refused.find("cutting.exponents: the Kt of C45 at a chip of 1 mm belongs to its exponent of 0.178"),
            std::string::npos)
      << refused;
}

TEST(SpecificForces, RefuseABallEndByTheMaterialThatBroughtTheLaw) {
  const auto refused_with = [](const std::string& law) {
    try {
      (void)parse_case(
          "[tool]\nteeth = 2\ndiameter = \"10 mm\"\nend = \"ball\"\n[cutting]\nradial_depth = \"10 mm\"\n"
          "material = \"C45\"\n" +
              law + with_feed,
          ".");
    } catch (const CaseError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refused_with("").find("cutting.material: only the linear law"), std::string::npos) << refused_with("");
  EXPECT_NE(refused_with("").find("leave the material out and give Kt, Kr and Ka"), std::string::npos);
  const std::string own = refused_with("law = \"power\"");
  EXPECT_NE(own.find("cutting.law: only the linear law"), std::string::npos) << own;
}

}  // namespace
}  // namespace thinwall::cases::specific_force_test
