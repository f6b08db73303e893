// The modes that a chart resolves where its case does not say.

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "case/numbers.hpp"
#include "case/reader.hpp"
#include "study/lobes/cut_structure.hpp"
#include "study/run.hpp"

namespace thinwall::tests::chart_modes_test {

namespace {

/// 80 × 40 × 2 mm, clamped at its foot, cut in the middle of its edge by two teeth.
cases::Case wall(const std::string& teeth, const std::string& lobes = "") {
  return cases::parse_case(R"([part]
length = "80 mm"
height = "40 mm"
thickness = "2 mm"
[part.material]
youngs_modulus = "70 GPa"
poisson_ratio = 0.33
density = "2810 kg/m^3"
[part.mesh]
element_size = "20 mm"
order = 3
[[part.supports]]
on = "z_min"
[points.P]
at = [1.0, 0.5, 1.0]
patch_radius = "2 mm"
[modes]
count = 4
[reduction]
up_to = "12 kHz"
check_frequencies = 0
[damping]
ratio = 0.02
[response]
lines = 10
[tool]
teeth = 2
diameter = "10 mm"
length = "20 mm"
)" + teeth + R"([cutting]
at = "P"
radial_depth = "1 mm"
Kt = "800 MPa"
Kr = "240 MPa"
[lobes]
from = "9000 rpm"
to = "12000 rpm"
count = 2
most_added = 0
)" + lobes,
                           ".");
}

study::Results run(const cases::Case& source) {
  study::Kept nothing;
  return study::run(source, cases::variation_of(source), nothing, {});
}

TEST(UsualChartModes, GoUpToOneAndAHalfTimesTheHighestOfTheReduction) {
  EXPECT_EQ(study::usual_modes_up_to_hz(Eigen::Vector3d(700.0, 9000.0, 4000.0)), 13500.0);
  EXPECT_EQ(study::usual_modes_up_to_hz(Eigen::VectorXd()), std::nullopt);
}

class ChartModes : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Teeth, ChartModes, testing::Values("", "helices = [\"30 deg\", \"30 deg\"]\n"));

TEST_P(ChartModes, AreThoseOfTheReductionInARunAndMoreChangeTheLimitsLittle) {
  const study::Results usual = run(wall(GetParam()));
  ASSERT_TRUE(usual.setup.lobes->modes_up_to_hz);
  const double highest_hz = usual.finite_elements->reduced->fixed_interface_hz.maxCoeff();
  EXPECT_EQ(*usual.setup.lobes->modes_up_to_hz, 1.5 * highest_hz);
  EXPECT_LE(highest_hz, 12e3);
  EXPECT_GT(usual.lobes[0].lobes.residual_share, 0.0);
  const study::Results more = run(wall(GetParam(), "modes_up_to = \"50 kHz\"\n"));
  EXPECT_EQ(*more.setup.lobes->modes_up_to_hz, 50e3) << "as the case gives it";
  EXPECT_LT(more.lobes[0].lobes.residual_share, usual.lobes[0].lobes.residual_share);
  for (std::size_t i = 0; i < more.lobes[0].lobes.rows.size(); ++i) {
    const double depth_m = more.lobes[0].lobes.rows[i].limiting_depth_m;
    // A stiff mode's dynamics change its compliance by (f/f_mode)²: of a few per cent of compliance a share of 1e-2.
    EXPECT_NEAR(usual.lobes[0].lobes.rows[i].limiting_depth_m, depth_m, 2e-3 * depth_m) << i;
  }
}

}  // namespace

}  // namespace thinwall::tests::chart_modes_test
