// Coefficients of a material: the middle of what was published, and its spread in the robust chart.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "case/checks/doubts.hpp"
#include "case/material_values.hpp"
#include "case/problem.hpp"
#include "case/reader.hpp"
#include "case/schema/schema.hpp"
#include "case/toml_values.hpp"
#include "case/writer.hpp"
#include "setup/materials/cut_materials.hpp"

namespace thinwall::cases::cut_material_test {
namespace {

const std::string one_mode = R"([[tool.modes]]
frequency = "922 Hz"
damping_ratio = 0.03
stiffness = "1.34e6 N/m"
direction = "x"
)";

Case case_with(const std::string& cutting, const std::string& lobes = "", const std::string& tip = one_mode) {
  return parse_case(R"([tool]
teeth = 2
diameter = "10 mm"
length = "5 mm"
)" + tip + R"([cutting]
radial_depth = "5 mm"
feed_direction = "x"
tool_axis = "z"
)" + cutting + "\n[lobes]\nfrom = \"9000 rpm\"\nto = \"16000 rpm\"\n" +
                        lobes,
                    ".");
}

TEST(CutMaterial, HasTheMiddleAndTheSpreadOfItsTools) {
  // Two tools by hand: the mean of the logarithms, and |ln(a/b)|/√2, the deviation of two values.
  const auto middle = setup::coefficients_of("Al6061").value();
  EXPECT_EQ(middle.tools, 2);
  EXPECT_NEAR(middle.K_t, std::sqrt(243.77e6 * 880e6), 1.0);
  EXPECT_NEAR(middle.K_r, std::sqrt(113.5e6 * 52e6), 1.0);
  EXPECT_NEAR(middle.spread, std::log(880.0 / 243.77) / std::sqrt(2.0), 1e-12);
  EXPECT_FALSE(setup::coefficients_of("unobtainium"));
  // That of ln K_t is 0.334 and that of ln K_r 0.713, by hand: one spread stands for both coefficients.
  EXPECT_NEAR(setup::coefficients_of("Al7075-T6")->spread, 0.7126, 1e-4);
}

TEST(CutMaterial, HasASourceForEveryValueAndIsAChoiceOfTheCase) {
  const std::string choices(std::ranges::find(case_schema().keys, "cutting.material", &Key::path)->choices);
  for (const setup::PublishedCut& cut : setup::published_cuts()) {
    EXPECT_FALSE(cut.source.empty());
    EXPECT_FALSE(cut.tool.empty());
    EXPECT_GT(cut.K_t, 1e8);
    EXPECT_LT(cut.K_t, 5e9);
    EXPECT_TRUE(setup::coefficients_of(cut.material)) << cut.material;
    EXPECT_NE(("|" + choices + "|").find("|" + std::string(cut.material) + "|"), std::string::npos) << cut.material;
  }
}

TEST(CutMaterial, FillsInCoefficientsAndTheirSpread) {
  const auto middle = setup::coefficients_of("Al7075-T6").value();
  const Case source = case_with("material = \"Al7075-T6\"");
  EXPECT_EQ(source.cutting->Kt, middle.K_t);
  EXPECT_EQ(source.cutting->Kr, middle.K_r);
  ASSERT_TRUE(source.lobes->robust);
  EXPECT_EQ(source.lobes->robust->uncertainty.coefficients, middle.spread);
  EXPECT_EQ(source.lobes->robust->uncertainty.frequency, 0.0);
  const auto doubts = doubts_about(source);
  EXPECT_TRUE(std::ranges::any_of(doubts, [](const std::string& doubt) {
    return doubt.find("the middle of 4 published tools") != std::string::npos;
  }));
  // The resolved case reads as the same one.
  const Case again = parse_case(resolved_text(source), ".");
  EXPECT_EQ(again.cutting->Kt, source.cutting->Kt);
  EXPECT_EQ(again.lobes->robust->uncertainty.coefficients, middle.spread);
}

/// The doubt that is told of cutting.material.
std::string told_of(const Case& source) {
  for (const std::string& doubt : doubts_about(source))
    if (doubt.starts_with("cutting.material")) return doubt;
  return "";
}

TEST(CutMaterial, TellsWhatWasFilledInAndWhatTheChartTakes) {
  const std::string material = "material = \"Al7075-T6\"";
  EXPECT_NE(told_of(case_with(material)).find("71 %, which the robust chart takes"), std::string::npos);
  EXPECT_EQ(told_of(case_with(material, "method = \"zeroth_order\"\n")).find("robust chart"), std::string::npos);
  const std::string own = told_of(case_with(material, "[lobes.uncertainty]\ncoefficients = 0.05\n"));
  EXPECT_NE(own.find("though the robust chart takes 5 %"), std::string::npos) << own;
  // A Kt of one's own has an uncertainty of one's own.
  const Case known = case_with(material + "\nKt = \"700 N/mm^2\"");
  EXPECT_FALSE(known.lobes->robust);
  EXPECT_NE(told_of(known).find("Kr 282 MPa is the middle"), std::string::npos) << told_of(known);
  EXPECT_EQ(told_of(known).find("%"), std::string::npos) << told_of(known);
  EXPECT_EQ(told_of(case_with(material + "\nKt = \"700 N/mm^2\"\nKr = \"200 N/mm^2\"")), "");
}

TEST(CutMaterial, HandsNoSpreadToAChartOfMeasuredLines) {
  const auto is_robust = [](const std::string& fit) {
    const std::string text = "[tool]\n" + fit + "[[tool.measured]]\nresponse = \"x\"\nforce = \"x\"\n" +
                             "[cutting]\nmaterial = \"Al7075-T6\"\n[lobes]\nfrom = \"9000 rpm\"\n";
    CaseValues values = read_values(text, "case.toml", case_schema()).values;
    fill_in_material(values);
    EXPECT_TRUE(find(values, "cutting.Kt"));
    return has_table(values, "lobes.uncertainty");
  };
  EXPECT_FALSE(is_robust(""));
  EXPECT_FALSE(is_robust("fit = false\n"));
  EXPECT_TRUE(is_robust("fit = true\n"));
}

TEST(CutMaterial, LeavesWhatIsGiven) {
  const Case source = case_with("material = \"Al7075-T6\"\nKt = \"700 N/mm^2\"",
                                "[lobes.uncertainty]\nfrequency = 0.02\ncoefficients = 0.1\n");
  EXPECT_EQ(source.cutting->Kt, 700e6);
  EXPECT_EQ(source.cutting->Kr, setup::coefficients_of("Al7075-T6")->K_r);
  EXPECT_EQ(source.lobes->robust->uncertainty.coefficients, 0.1);
  EXPECT_EQ(source.lobes->robust->uncertainty.frequency, 0.02);
  const Case other = case_with("material = \"Al7075-T6\"", "method = \"zeroth_order\"\n");
  EXPECT_FALSE(other.lobes->robust);
}

TEST(CutMaterial, TellsChipsThatAreThinnerThanThoseMeasured) {
  // Half immersion: the mean of f sin φ over a quarter of a turn is 2 f/π, 64 µm of 0.1 mm.
  const auto told = [](const std::string& thinnest) {
    const Case source =
        case_with("Kt = \"700 N/mm^2\"\nfeed_per_tooth = \"0.1 mm\"\nthinnest_chip = \"" + thinnest + "\"");
    const auto doubts = doubts_about(source);
    return std::ranges::any_of(doubts, [](const std::string& doubt) { return doubt.find("the mean chip is") == 0; });
  };
  EXPECT_FALSE(told("0.0636 mm"));
  EXPECT_TRUE(told("0.0637 mm"));
}

TEST(CutMaterial, BelongsToLawsOfPublishedCoefficients) {
  EXPECT_THROW((void)case_with("material = \"Al7075-T6\"\nlaw = \"oblique\"\nshear_stress = \"300 MPa\"\n"
                               "friction_angle = \"30 deg\""),
               CaseError);
  EXPECT_THROW((void)case_with("material = \"unobtainium\""), CaseError);
}

}  // namespace
}  // namespace thinwall::cases::cut_material_test
