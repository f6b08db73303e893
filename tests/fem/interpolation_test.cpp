// Interpolation of displacements between orders, and modes of a lower order found from those of the next one.

#include "fem/interpolation.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "fem/modes.hpp"
#include "fem/supports.hpp"
#include "fem/to_tolerance.hpp"
#include "tests/mesh/kuhn_box.hpp"

namespace thinwall::fem::interpolation_test {
namespace {

const Material steel{210e9, 0.3, 7850.0};
const mesh::Box box{{0.3, 0.2, 0.05}};

Model cantilever(int order) {
  return supported_model(mesh::kuhn_box(box.size, {3, 2, 1}), order, steel,
                         {{"x_min", mesh::face_of(box, "x_min"), {0, 1, 2}}});
}

/// A displacement field at the free DOFs, which vanishes with x.
Eigen::VectorXd field(const Model& model, int degree) {
  Eigen::VectorXd u(model.K.rows());
  for (std::size_t i = 0; i < model.free_rows.size(); ++i) {
    const Eigen::Vector3d x = model.nodes.positions.row(model.free_rows[i] / 3).transpose() / 0.3;
    const int axis = model.free_rows[i] % 3;
    u(static_cast<Eigen::Index>(i)) = x.x() * std::pow(x.x() + (axis - 1.0) * x.y() + 2.0 * x.z(), degree - 1);
  }
  return u;
}

TEST(Interpolation, CarriesOverExactlyWhatTheOtherOrderHolds) {
  for (const auto& [from, to] : {std::pair{5, 4}, {4, 5}, {3, 2}, {2, 6}}) {
    const Model a = cantilever(from), b = cantilever(to);
    for (int degree = 1; degree <= std::min(from, to); ++degree) {
      const Eigen::VectorXd expected = field(b, degree);
      EXPECT_LT((interpolated(a, field(a, degree), b) - expected).norm(), 1e-12 * expected.norm())
          << "order " << from << " to " << to << ", degree " << degree;
    }
    const Eigen::VectorXd beyond = field(b, std::min(from, to) + 1);
    EXPECT_GT((interpolated(a, field(a, std::min(from, to) + 1), b) - beyond).norm(), from < to ? 1e-6 : 0.0);
  }
}

TEST(ModesFromAnotherOrder, KeepTheBoundOnTheirResidual) {
  const Model fine = cantilever(4), coarse = cantilever(3);
  const Modes above = modes(fine, factorise(fine), {.count = 6, .up_to_hz = {}});
  const Factored factored = factorise(coarse);
  const Modes exact = modes(coarse, factored, {.count = 6, .up_to_hz = {}});
  for (const double residual : {1e-2, 1e-3}) {
    const ModeOptions options{.count = 6, .up_to_hz = {}, .inverse_residual = residual};
    const Modes near = modes(coarse, factored, options, interpolated(fine, above.pairs.Phi, coarse));
    EXPECT_LE(near.pairs.inverse_residual.maxCoeff(), residual);
    for (Eigen::Index k = 0; k < 6; ++k) {
      const double above_exact = near.pairs.lambda(k) / exact.pairs.lambda(k) - 1.0;
      EXPECT_GT(above_exact, -1e-9) << "a Ritz value of a held part lies above";
      EXPECT_LT(above_exact, residual * residual) << "mode " << k;
      EXPECT_GT(exact.frequency_hz(k), above.frequency_hz(k)) << "the orders are nested";
    }
  }
}

// A mode that changes places from one order to the next is not among the shapes that are given.
TEST(ModesFromAnotherOrder, AreAllThereWhereTheStartLacksOne) {
  const Model fine = cantilever(4), coarse = cantilever(3);
  const Modes start = modes(coarse, factorise(coarse), {.count = 10, .up_to_hz = {}});
  const Factored factored = factorise(fine);
  const Modes exact = modes(fine, factored, {.count = 9, .up_to_hz = {}});
  const Eigen::MatrixXd whole = interpolated(coarse, start.pairs.Phi, fine);
  for (Eigen::Index missing = 0; missing < 9; ++missing) {
    Eigen::MatrixXd others(whole.rows(), 9);
    others << whole.leftCols(missing), whole.rightCols(9 - missing);
    // The missing shape is removed from the others, too, so that only the random directions can bring it in.
    const Eigen::VectorXd shape = exact.pairs.Phi.col(missing);
    others -= shape * ((fine.M * shape).transpose() * others).eval();
    const ModeOptions options{.count = 9, .up_to_hz = {}, .inverse_residual = 1e-2};
    const Modes found = modes(fine, factored, options, others);
    for (Eigen::Index k = 0; k < 9; ++k)
      EXPECT_NEAR(found.pairs.lambda(k) / exact.pairs.lambda(k), 1.0, 1e-4) << "without " << missing << ", mode " << k;
  }
}

TEST(ModesFromAnotherOrder, ComeFromAnyStart) {
  const Model model = cantilever(2);
  const Factored factored = factorise(model);
  const Modes exact = modes(model, factored, {.count = 4, .up_to_hz = {}});
  const ModeOptions options{.count = 4, .up_to_hz = {}, .inverse_residual = 1e-3};
  for (const Eigen::Index columns : {Eigen::Index{1}, Eigen::Index{4}, Eigen::Index{40}, model.K.rows() + 3}) {
    for (const Eigen::MatrixXd& start : {Eigen::MatrixXd(Eigen::MatrixXd::Zero(model.K.rows(), columns)),
                                         Eigen::MatrixXd(Eigen::MatrixXd::Random(model.K.rows(), columns))}) {
      const Modes found = modes(model, factored, options, start);
      for (Eigen::Index k = 0; k < 4; ++k)
        EXPECT_NEAR(found.pairs.lambda(k) / exact.pairs.lambda(k), 1.0, 1e-6) << columns << " columns, mode " << k;
    }
  }
}

TEST(RefineToTolerance, EstimatesFromTheLowerOrderAsTwoFullSolutionsDo) {
  SolidPart part;
  part.mesh = [](int) { return mesh::kuhn_box(box.size, {3, 2, 1}); };
  part.material = steel;
  for (const bool held : {true, false}) {
    if (held) part.supports = {{"x_min", mesh::face_of(box, "x_min"), {0, 1, 2}}};
    if (!held) part.supports.clear();
    ToleranceOptions options;
    options.tolerance = 1e-3;
    options.modes.count = 6;
    options.first_order = 3;
    options.last_order = 4;
    options.levels = 1;
    const RefinementStep step = refine_to_tolerance(part, options).estimate.steps.at(1);
    const auto frequencies = [&](int order) {
      const Model model = supported_model(part.mesh(0), order, steel, part.supports);
      return Eigen::VectorXd(modes(model, factorise(model), options.modes).frequency_hz.tail(6));
    };
    const Eigen::VectorXd lower = frequencies(3), higher = frequencies(4);
    const double change = ((lower - higher).array() / higher.array()).abs().maxCoeff();
    EXPECT_NEAR(step.frequency_change.value_or(0.0), change, 0.01 * options.tolerance) << "held: " << held;
  }
}

// The first two orders of a finer mesh promise more than the next one keeps.
TEST(RefineToTolerance, ReturnsTheSolutionOfTheLeastErrorOfAllLevels) {
  SolidPart part;
  part.mesh = [](int level) {
    return mesh::kuhn_box(box.size, level == 0 ? std::array{2, 1, 1} : std::array{6, 4, 1});
  };
  part.material = steel;
  part.supports = {{"x_min", mesh::face_of(box, "x_min"), {0, 1, 2}}};
  const Eigen::Index coarse = static_cast<Eigen::Index>(part.mesh(0).tets.size());
  part.shape_error = [coarse](const Model& model) {
    const bool is_coarse = static_cast<Eigen::Index>(model.mesh.tets.size()) == coarse;
    return !is_coarse && model.nodes.order == 4 ? 0.5 : 0.0;
  };
  ToleranceOptions options;
  options.tolerance = 1e-6;
  options.modes.count = 3;
  options.first_order = 2;
  options.last_order = 4;
  options.levels = 2;
  const Refined refined = refine_to_tolerance(part, options);
  const auto& steps = refined.estimate.steps;
  ASSERT_EQ(steps.size(), 5U);
  EXPECT_EQ(steps.back().level, 1);
  EXPECT_EQ(steps.back().order, 4);
  EXPECT_LT(steps[3].frequency_change.value_or(1.0), steps[1].frequency_change.value_or(0.0))
      << "the finer mesh seems better at order 3";
  EXPECT_EQ(refined.level, 0);
  EXPECT_LT(refined.estimate.frequency, 0.5);
  EXPECT_EQ(refined.model.K.rows(), steps[1].dofs);
  EXPECT_EQ(refined.model.M.rows(), steps[1].dofs);
  EXPECT_EQ(refined.factored.factor.rows(), steps[1].dofs);
  EXPECT_EQ(refined.modes.frequency_hz.size(), 3);
}

}  // namespace
}  // namespace thinwall::fem::interpolation_test
