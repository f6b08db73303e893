// Fits that give energy, and what is left of that.

#include "identification/passive_fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/dense_eigenvalues.hpp"
#include "dynamics/frf_checks.hpp"
#include "identification/fit_response.hpp"
#include "tests/identification/random_structure.hpp"

namespace thinwall::identification::passive_fit_test {
namespace {

using testing::Draw;

const dynamics::DofTable dofs{{"1", Eigen::Vector3d::UnitX(), dynamics::DofKind::translation},
                              {"1", Eigen::Vector3d::UnitY(), dynamics::DofKind::translation}};

/// Modes of a passive structure, 2iω_d R = φφᵀ, of which one is turned by `degrees` of phase.
ModalFit structure(double degrees) {
  Draw draw(3);
  ModalFit fit;
  for (const double hz : {50.0, 130.0, 240.0}) {
    FittedMode mode;
    mode.frequency_hz = hz;
    mode.damping_ratio = 0.02;
    mode.left = Eigen::Vector2cd(draw.between(0.5, 1.0), draw.between(-1.0, 1.0));
    Eigen::Index largest = 0;
    mode.left.cwiseAbs().maxCoeff(&largest);
    mode.left /= mode.left(largest);
    const std::complex<double> turn = std::polar(1.0, hz == 130.0 ? degrees * std::numbers::pi / 180.0 : 0.0);
    mode.right = turn * mode.left / std::complex<double>(0.0, 2.0 * mode.pole().imag());
    mode.residue = mode.right * mode.left.transpose();
    fit.modes.push_back(mode);
  }
  return fit;
}

/// The largest eigenvalue of (H − Hᴴ)/(2i) over ‖H‖ at a line.
double energy_given(const ModalFit& fit, double hz) {
  const Eigen::MatrixXcd H = value(fit, hz);
  const Eigen::MatrixXcd A = (H - H.adjoint()) / std::complex<double>(0.0, 2.0);
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>(A).eigenvalues()(1) / H.norm();
}

/// The largest of it on lines between those that were given.
double energy_given(const ModalFit& fit) {
  double largest = -1.0;
  for (double hz = 20.05; hz < 400.0; hz += 0.1) largest = std::max(largest, energy_given(fit, hz));
  return largest;
}

/// The lines of a fit, all entries known to the same share of their size.
MeasuredLines lines_of(const ModalFit& fit) {
  MeasuredLines lines;
  lines.hz = Eigen::VectorXd::LinSpaced(762, 20.0, 400.0);
  for (const double hz : lines.hz) {
    lines.H.push_back(value(fit, hz));
    lines.variance.emplace_back((0.01 * lines.H.back()).cwiseAbs2());
  }
  return lines;
}

TEST(PassiveFit, LeavesAPassiveFitAsItIs) {
  const ModalFit fit = structure(0.0);
  const PassiveFit passive = made_passive(fit, lines_of(fit), dofs, dofs, Residues::rank_one);
  EXPECT_EQ(passive.change.before, 0.0);
  EXPECT_EQ(passive.change.moved, 0.0);
  for (std::size_t r = 0; r < fit.modes.size(); ++r) EXPECT_EQ(passive.fit.modes[r].residue, fit.modes[r].residue) << r;
}

/// A residue whose phase is off by some degrees gives energy beside its resonance; it moves by about that angle at
/// most, and stays of rank one.
TEST(PassiveFit, MovesResiduesAsLittleAsNeeded) {
  for (const Residues form : {Residues::rank_one, Residues::symmetric, Residues::free}) {
    ModalFit fit = structure(8.0);
    if (form == Residues::free) {
      for (FittedMode& mode : fit.modes) mode.left = mode.right = Eigen::VectorXcd();
    }
    ASSERT_GT(energy_given(fit), 0.01);
    const PassiveFit passive = made_passive(fit, lines_of(fit), dofs, dofs, form);
    EXPECT_EQ(passive.change.after, 0.0);
    EXPECT_GT(passive.change.before, 0.01);
    EXPECT_LT(energy_given(passive.fit), 1e-4) << "between the lines";
    EXPECT_GT(passive.change.moved, 0.01);
    EXPECT_LT(passive.change.moved, 8.0 * std::numbers::pi / 180.0 + 0.01);
    for (const FittedMode& mode : passive.fit.modes) {
      if (form == Residues::symmetric) {
        EXPECT_LT((mode.residue - mode.residue.transpose()).norm(), 1e-14 * mode.residue.norm());
      }
      if (form == Residues::free) continue;
      EXPECT_LT((mode.residue - mode.right * mode.left.transpose()).norm(), 1e-15 * mode.residue.norm() + 1e-30);
      EXPECT_NEAR(mode.left.cwiseAbs().maxCoeff(), 1.0, 1e-12);
    }
  }
}

/// Noise makes free residues of a passive structure give energy; the passive fit has about the same χ².
TEST(PassiveFit, CostsLittleOfTheFit) {
  Draw draw(17);
  const MeasuredLines measured = testing::lines_of(structure(0.0).modes, 400, 0.02, draw);
  const dynamics::ResponseModel response{{measured.hz}, dofs, dofs, measured.H};
  ResponseFitOptions options;
  options.noise = Eigen::MatrixXd::Constant(1, 1, 0.02 / std::numbers::sqrt2);
  options.identify.terms = ResidualTerms{false, 0};
  options.identify.residues = Residues::free;
  const ResponseFit plain = fit_response(response, {}, options);
  options.passive = true;
  const ResponseFit passive = fit_response(response, {}, options);
  ASSERT_TRUE(passive.passive);
  EXPECT_GT(passive.passive->before, 0.0);
  EXPECT_EQ(passive.passive->after, 0.0);
  EXPECT_GE(passive.found.fit.chi2, plain.found.fit.chi2);
  EXPECT_LT(passive.found.fit.chi2_per_dof(), 1.1 * plain.found.fit.chi2_per_dof());
  EXPECT_LT(energy_given(passive.found.fit), 1e-3);
}

/// A mode of one shape cannot take back energy that terms give along the other direction: what is left is that of the
/// fit returned. Both points are alike, so that no scale of theirs enters.
TEST(PassiveFit, TellsWhatIsLeftOfTheFitThatItReturns) {
  ModalFit fit = structure(0.0);
  fit.modes.resize(1);
  FittedMode& mode = fit.modes.front();
  mode.left = Eigen::Vector2cd(1.0, 1.0);
  mode.right = mode.left / std::complex<double>(0.0, 2.0 * mode.pole().imag());
  mode.residue = mode.right * mode.left.transpose();
  fit.powers = {Eigen::MatrixXd::Zero(2, 2), 1e-9 * Eigen::MatrixXd::Identity(2, 2)};
  const MeasuredLines lines = lines_of(fit);
  const PassiveFit passive = made_passive(fit, lines, dofs, dofs, Residues::rank_one);
  double largest = 0.0;
  for (const double hz : lines.hz) largest = std::max(largest, energy_given(passive.fit, hz));
  for (int i = -4; i <= 4; ++i)
    largest = std::max(largest, energy_given(passive.fit, mode.frequency_hz * (1.0 + 0.5 * i * mode.damping_ratio)));
  ASSERT_GT(largest, 1e-3);
  EXPECT_NEAR(passive.change.after, largest, 1e-9 * largest);
}

/// Symmetric lines that give energy by more than their noise: the doubt is about that, not about the form, and χ² as
/// it was before tells.
TEST(PassiveFit, IsNoReasonToDoubtTheFormOfTheResidues) {
  Draw draw(23);
  const MeasuredLines measured = testing::lines_of(structure(8.0).modes, 400, 0.005, draw);
  const dynamics::ResponseModel response{{measured.hz}, dofs, dofs, measured.H};
  ResponseFitOptions options;
  options.noise = Eigen::MatrixXd::Constant(1, 1, 0.005 / std::numbers::sqrt2);
  options.identify.terms = ResidualTerms{false, 0};
  options.identify.residues = Residues::symmetric;
  options.passive = true;
  const ResponseFit fit = fit_response(response, {}, options);
  ASSERT_TRUE(fit.passive);
  EXPECT_EQ(fit.passive->after, 0.0);
  EXPECT_NEAR(fit.passive->chi2_before / fit.found.fit.degrees_of_freedom, 1.0, 0.15);
  ASSERT_GT(fit.found.fit.chi2_per_dof(), 1.5);
  const std::vector<std::string> doubts = doubts_about(fit, dofs, dofs, options);
  const auto any = [&](const char* words) {
    return std::ranges::any_of(doubts,
                               [&](const std::string& doubt) { return doubt.find(words) != std::string::npos; });
  };
  EXPECT_TRUE(any("without --passive"));
  EXPECT_FALSE(any("symmetric residues do not fit"));
  EXPECT_FALSE(any("where 1 is right"));
}

}  // namespace
}  // namespace thinwall::identification::passive_fit_test
