// Poles and residues from lines whose modes are known.

#include "identification/modal_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "core/error.hpp"
#include "identification/identify.hpp"
#include "tests/identification/random_structure.hpp"

namespace thinwall::identification::modal_fit_test {
namespace {

using testing::Draw;

/// One to twelve modes of a 3 × 3 matrix, some heavily damped: to 1e-8 without a starting value.
TEST(Identify, FindsExactModes) {
  for (int modes = 1; modes <= 12; ++modes) {
    Draw draw(static_cast<unsigned>(modes));
    const auto truth = testing::random_modes(draw, modes, 3, 3, 0.15);
    const MeasuredLines measured = testing::lines_of(truth, 1200, 0.0, draw);
    const Identification found = identify(measured);
    ASSERT_EQ(found.fit.modes.size(), truth.size()) << modes;
    for (std::size_t r = 0; r < truth.size(); ++r) {
      const FittedMode& mode = found.fit.modes[r];
      EXPECT_LT(std::abs(mode.pole() - truth[r].pole()), 1e-8 * std::abs(truth[r].pole())) << modes << " " << r;
      EXPECT_LT((mode.residue - truth[r].residue).norm(), 1e-8 * truth[r].residue.norm()) << modes << " " << r;
      EXPECT_LT((mode.left - truth[r].left).norm(), 1e-7);
    }
  }
}

/// Two modes 0.4 % apart with dampings of 1 % overlap; shapes tell them apart.
TEST(Identify, FindsModesThatOverlap) {
  Draw draw(3);
  auto truth = testing::random_modes(draw, 4, 3, 3);
  truth[2].frequency_hz = 1.004 * truth[1].frequency_hz;
  truth[1].damping_ratio = truth[2].damping_ratio = 0.01;
  const Identification found = identify(testing::lines_of(truth, 1200, 1e-3, draw));
  ASSERT_EQ(found.fit.modes.size(), 4u);
  for (std::size_t r = 0; r < 4; ++r)
    EXPECT_LT(std::abs(found.fit.modes[r].pole() - truth[r].pole()), 1e-3 * std::abs(truth[r].pole())) << r;
}

/// 95 % intervals of frequencies and dampings over 200 draws of 1 % noise, and χ² a degree of freedom.
TEST(ModalFit, CoversTheTruthAsOftenAsItSays) {
  Draw draw(11);
  const auto truth = testing::random_modes(draw, 4, 2, 2);
  Eigen::VectorXcd start(4);
  for (std::size_t r = 0; r < 4; ++r) start(static_cast<Eigen::Index>(r)) = truth[r].pole();
  constexpr int draws = 200;
  int covered = 0;
  double chi2 = 0.0;
  for (int i = 0; i < draws; ++i) {
    const ModalFit fit = modal_fit(testing::lines_of(truth, 150, 0.01, draw), start, {{false, 0}});
    ASSERT_TRUE(fit.converged);
    for (std::size_t r = 0; r < 4; ++r) {
      covered +=
          std::abs(std::log(fit.modes[r].frequency_hz / truth[r].frequency_hz)) < 1.96 * fit.modes[r].sd_ln_frequency;
      covered +=
          std::abs(std::log(fit.modes[r].damping_ratio / truth[r].damping_ratio)) < 1.96 * fit.modes[r].sd_ln_damping;
    }
    chi2 += fit.chi2_per_dof() / draws;
  }
  // 1600 intervals: 95 % is met to 0.55 % by chance.
  EXPECT_NEAR(covered / (8.0 * draws), 0.95, 0.02);
  EXPECT_NEAR(chi2, 1.0, 0.02);
}

/// The terms that the lines do not have are not taken, and those that they have are.
TEST(Identify, TakesTheTermsThatAreMissing) {
  Draw draw(5);
  auto truth = testing::random_modes(draw, 4, 2, 2);
  const Identification within = identify(testing::lines_of(truth, 600, 0.01, draw));
  EXPECT_EQ(within.terms.highest_power, 1);
  FittedMode above = truth[0];
  above.frequency_hz = 650.0;
  above.damping_ratio = 0.1;
  above.residue *= 3.0;
  truth.push_back(above);
  const Identification beside = identify(testing::lines_of(truth, 600, 0.01, draw));
  EXPECT_GE(beside.terms.highest_power, 2);
  EXPECT_NEAR(beside.fit.chi2_per_dof(), 1.0, 0.1);
  ASSERT_EQ(beside.fit.modes.size(), 4u);
}

/// A further power would lower χ² by no more than five times the number of its unknowns, which chance does not reach,
/// unless there is none.
TEST(Identify, LeavesOutNoPowerThatMatters) {
  for (unsigned seed = 40; seed < 52; ++seed) {
    Draw draw(seed);
    auto truth = testing::random_modes(draw, 3, 2, 2);
    for (const auto& [number, hz, size, zeta] : {std::tuple{1, 600.0, 1.0, 0.06}, std::tuple{0, 900.0, 2.0, 0.08}}) {
      FittedMode above = truth[static_cast<std::size_t>(number)];
      above.frequency_hz = hz;
      above.damping_ratio = zeta;
      above.residue *= size;
      truth.push_back(above);
    }
    const MeasuredLines measured = testing::lines_of(truth, 250, 0.01, draw);
    const Identification found = identify(measured);
    if (found.terms.highest_power == 5) continue;
    Eigen::VectorXcd poles(static_cast<Eigen::Index>(found.fit.modes.size()));
    for (Eigen::Index i = 0; i < poles.size(); ++i) poles(i) = found.fit.modes[static_cast<std::size_t>(i)].pole();
    ModalFitOptions options{found.terms, Residues::free};
    const ModalFit poorer = modal_fit(measured, poles, options);
    ++options.terms.highest_power;
    const ModalFit richer = modal_fit(measured, poles, options);
    EXPECT_LT(poorer.chi2 - richer.chi2, 5.0 * (poorer.degrees_of_freedom - richer.degrees_of_freedom)) << seed;
  }
}

/// Residues of modes that are not reciprocal do not pass as symmetric.
TEST(ModalFit, TellsThatSymmetryIsWrong) {
  Draw draw(8);
  const auto truth = testing::random_modes(draw, 3, 2, 2);
  Eigen::VectorXcd start(3);
  for (std::size_t r = 0; r < 3; ++r) start(static_cast<Eigen::Index>(r)) = truth[r].pole();
  const MeasuredLines measured = testing::lines_of(truth, 300, 0.01, draw);
  EXPECT_NEAR(modal_fit(measured, start).chi2_per_dof(), 1.0, 0.1);
  EXPECT_GT(modal_fit(measured, start, {{}, Residues::symmetric}).chi2_per_dof(), 10.0);
  auto reciprocal = truth;
  for (FittedMode& mode : reciprocal) {
    mode.right = mode.left * mode.right(0);
    mode.residue = mode.right * mode.left.transpose();
  }
  const ModalFit fit = modal_fit(testing::lines_of(reciprocal, 300, 0.01, draw), start, {{}, Residues::symmetric});
  EXPECT_NEAR(fit.chi2_per_dof(), 1.0, 0.1);
  for (const FittedMode& mode : fit.modes)
    EXPECT_LT((mode.residue - mode.residue.transpose()).norm(), 1e-12 * mode.residue.norm());
}

TEST(ModalFit, RefusesWhatItCannotFit) {
  Draw draw(1);
  const auto truth = testing::random_modes(draw, 2, 2, 2);
  MeasuredLines measured = testing::lines_of(truth, 100, 0.01, draw);
  const Eigen::VectorXcd start = Eigen::VectorXcd::Constant(1, std::complex<double>(-1.0, 300.0));
  EXPECT_THROW((void)modal_fit(measured, {}), core::InputError);
  EXPECT_THROW((void)modal_fit(measured, start.conjugate()), core::InputError);
  EXPECT_THROW((void)modal_fit(measured, start, {{true, 9}}), core::InputError);
  MeasuredLines bad = measured;
  bad.H[7](1, 1) = std::nan("");
  EXPECT_THROW((void)modal_fit(bad, start), core::InputError);
  bad = measured;
  bad.hz(3) = bad.hz(2);
  EXPECT_THROW((void)modal_fit(bad, start), core::InputError);
  bad = measured;
  bad.variance[3](0, 1) = 0.0;
  EXPECT_THROW((void)modal_fit(bad, start), core::InputError);
  EXPECT_THROW((void)plscf(measured, 60), core::InputError);
  EXPECT_THROW((void)variance_of(measured.H, {}, Eigen::MatrixXd::Constant(1, 1, 8.0)), core::InputError);
}

}  // namespace
}  // namespace thinwall::identification::modal_fit_test
