// A fit of the part: the derivatives of its frequencies, the solution that it leaves, and the search itself.

#include "study/part/part_evaluation.hpp"

#include <gtest/gtest.h>

#include "case/numbers.hpp"
#include "case/reader.hpp"
#include "setup/graded_mesh.hpp"
#include "setup/part_geometry.hpp"
#include "study/updating.hpp"
#include "tests/case/case_text.hpp"

namespace thinwall::tests::part_evaluation_test {

using namespace setup;
using namespace cases;
using namespace study;

namespace {

/// The plate of 392 × 100 × 6 mm with two targets and four parameters; its mesh is coarse.
struct Plate {
  Case source = parse_case(with(with(plate_case(), "[[updating.targets]]", R"([[updating.targets]]
quantity = "part_frequency"
value = "560 Hz"
point = "P.x"
match = "number"
rank = 2
[[updating.targets]]
rank = 1)"),
                                R"(parameters = [{ key = "part.length", lower = "380 mm", upper = "410 mm" }])",
                                R"(parameters = [
  { key = "part.length", lower = "380 mm", upper = "410 mm" },
  { key = "part.thickness", lower = "5 mm", upper = "6 mm" },
  { key = "part.material.youngs_modulus", lower = "200 GPa", upper = "220 GPa" },
  { key = "part.material.density", lower = "7000 kg/m^3", upper = "8000 kg/m^3" },
])"),
                           ".");
  mesh::TetMesh mesh = graded_mesh(source, 0);
  Variation variation = variation_of(source);
  PartEvaluation evaluation{variation, source, source.updating.front(), mesh, 2};

  /// The plate with these values of the fit's parameters, the others as they are.
  [[nodiscard]] VariedSetup varied(const NamedValues& values = {}) const { return {variation.with(values), values}; }
};

TEST(PartEvaluation, SlopesAreThoseOfFullSolutions) {
  Plate plate;
  const Updating& updating = plate.source.updating.front();
  const Eigen::VectorXd hz = plate.evaluation(plate.varied());
  const Eigen::MatrixXd slopes = plate.evaluation.slopes(plate.varied());
  ASSERT_EQ(slopes.rows(), 2);
  ASSERT_EQ(slopes.cols(), 4);
  for (Eigen::Index k = 0; k < slopes.cols(); ++k) {
    const UpdatingParameter& p = updating.parameters[static_cast<std::size_t>(k)];
    const double value = get_value(plate.source, p.key);
    const auto at = [&](double h) {
      return plate.evaluation(plate.varied({{p.key, value + h * (p.upper - p.lower)}}));
    };
    const Eigen::VectorXd central = (at(0.01) - at(-0.01)) / 0.02;
    EXPECT_LT(((slopes.col(k) - central).array() / central.array()).abs().maxCoeff(), 2e-3) << p.key;
  }
  // f ~ √(E / ρ) whatever the mesh; the range of E is 20 GPa of 210, of ρ 1000 kg/m³ of 7850.
  EXPECT_LT((slopes.col(2) - hz * 0.5 * 20.0 / 210.0).norm(), 1e-4 * slopes.col(2).norm());
  EXPECT_LT((slopes.col(3) + hz * 0.5 * 1000.0 / 7850.0).norm(), 1e-4 * slopes.col(3).norm());
}

TEST(PartEvaluation, LeavesTheSolutionOfTheLastCaseOnlyAndNotTheRoughOneOfTheStart) {
  Plate plate;
  const VariedSetup longer = plate.varied({{"part.length", 0.4}});
  (void)plate.evaluation(plate.varied());
  EXPECT_FALSE(plate.evaluation.take(plate.varied())) << "solved as far as a fit can tell";
  const Eigen::VectorXd hz = plate.evaluation(longer);
  EXPECT_FALSE(plate.evaluation.take(plate.varied())) << "another length";
  const std::optional<Solution> left = plate.evaluation.take(longer);
  ASSERT_TRUE(left);
  EXPECT_EQ(left->modes.frequency_hz.size(), mode_options(longer.setup).count);
  EXPECT_NEAR(left->modes.frequency_hz(0), hz(1), 1e-9 * hz(1));
  EXPECT_LT(left->modes.pairs.inverse_residual.maxCoeff(), 1e-8);
  EXPECT_FALSE(plate.evaluation.take(longer)) << "given away";
}

TEST(PartUpdating, FindsTheLengthThatTheFrequencyCameFromAndLeavesItsSolution) {
  Plate plate;
  Updating updating = plate.source.updating.front();
  updating.parameters.resize(1);
  const Eigen::VectorXd wanted =
      PartEvaluation(plate.variation, plate.source, updating, plate.mesh, 2)(plate.varied({{"part.length", 0.401}}));
  for (Eigen::Index i = 0; i < wanted.size(); ++i) updating.targets[static_cast<std::size_t>(i)].value = wanted(i);
  VariedSetup fitted = plate.varied();
  const PartUpdating fit = update_part(plate.variation, fitted, updating, plate.mesh, 2);
  EXPECT_TRUE(fit.result.converged);
  EXPECT_LE(fit.result.evaluations, 4);
  EXPECT_NEAR(fitted.values.at("part.length"), 0.401, 3e-6) << "a ten-thousandth of the range";
  ASSERT_TRUE(fit.solved);
  EXPECT_NEAR(fit.solved->modes.frequency_hz(0), wanted(1), 3e-5 * wanted(1));
}

}  // namespace
}  // namespace thinwall::tests::part_evaluation_test
