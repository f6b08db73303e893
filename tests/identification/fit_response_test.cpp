// Measured matrices of a known structure: weights, doubts, and the fit as a model.

#include "identification/fit_response.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "dynamics/conversion.hpp"
#include "identification/fitted_model.hpp"
#include "tests/identification/random_structure.hpp"

namespace thinwall::identification::fit_response_test {
namespace {

using testing::Draw;

dynamics::DofTable dofs_of(const std::vector<std::string>& points) {
  dynamics::DofTable dofs;
  for (const std::string& point : points)
    dofs.push_back({point, Eigen::Vector3d::UnitX(), dynamics::DofKind::translation});
  return dofs;
}

/// Modes whose vectors are alike on both sides, those of masses on springs: A = 2iω_d R real.
std::vector<FittedMode> reciprocal_modes(Draw& draw, int modes, int dofs) {
  std::vector<FittedMode> result = testing::random_modes(draw, modes, dofs, dofs);
  for (FittedMode& mode : result) {
    mode.left = mode.left.real().cast<std::complex<double>>();
    mode.right = mode.left / std::complex<double>(0.0, 2.0 * mode.pole().imag());
    mode.residue = mode.right * mode.left.transpose();
  }
  return result;
}

dynamics::ResponseModel response_of(const MeasuredLines& lines) {
  const std::vector<std::string> names{"P", "Q", "R"};
  const auto first = [&](Eigen::Index n) { return dofs_of({names.begin(), names.begin() + n}); };
  return {{lines.hz}, first(lines.responses()), first(lines.references()), lines.H};
}

bool any_has(const std::vector<std::string>& doubts, const std::string& words) {
  return std::ranges::any_of(doubts, [&](const std::string& doubt) { return doubt.find(words) != std::string::npos; });
}

TEST(FitResponse, FindsTheModesByTheScatterOfTheLines) {
  Draw draw(21);
  const auto truth = reciprocal_modes(draw, 5, 2);
  const dynamics::ResponseModel measured = response_of(testing::lines_of(truth, 1500, 0.01, draw));
  const ResponseFit fit = fit_response(measured, {});
  ASSERT_EQ(fit.found.fit.modes.size(), truth.size());
  EXPECT_EQ(fit.weights, Weights::scatter);
  // Modes that were added and left out are counted over all passes.
  EXPECT_EQ(static_cast<int>(fit.found.stable.size()) + fit.found.added - fit.found.left_out,
            static_cast<int>(fit.found.fit.modes.size()));
  for (std::size_t r = 0; r < truth.size(); ++r) {
    const FittedMode& mode = fit.found.fit.modes[r];
    EXPECT_LT(std::abs(std::log(mode.frequency_hz / truth[r].frequency_hz)), 4.0 * mode.sd_ln_frequency) << r;
    EXPECT_LT(std::abs(std::log(mode.damping_ratio / truth[r].damping_ratio)), 4.0 * mode.sd_ln_damping) << r;
  }
  // A median of 41 lines scatters by a sixth itself, which the mean of its inverse exceeds 1 by.
  EXPECT_NEAR(fit.found.fit.chi2_per_dof(), 1.05, 0.1);
  EXPECT_LT(fit.misfit.maxCoeff(), 0.012);
  EXPECT_TRUE(doubts_about(fit, measured.responses, measured.forces, {}).empty());
}

/// Noise whose size the coherence of 10 averages tells, and stated noise: χ² is 1 to within its own scatter.
TEST(FitResponse, WeighsByCoherenceAndByStatedNoise) {
  Draw draw(22);
  const auto truth = reciprocal_modes(draw, 3, 2);
  constexpr double noise = 0.02;
  const dynamics::ResponseModel measured = response_of(testing::lines_of(truth, 800, noise, draw));
  const double gamma2 = 1.0 / (1.0 + 10 * noise * noise);
  const std::vector<Eigen::MatrixXd> coherence(measured.H.size(), Eigen::Matrix2d::Constant(gamma2));
  ResponseFitOptions options;
  options.averages = Eigen::MatrixXd::Constant(1, 1, 10.0);
  const ResponseFit by_coherence = fit_response(measured, coherence, options);
  EXPECT_EQ(by_coherence.weights, Weights::coherence);
  EXPECT_NEAR(by_coherence.found.fit.chi2_per_dof(), 1.0, 0.05);
  options.noise = Eigen::MatrixXd::Constant(1, 1, noise / std::numbers::sqrt2);
  const ResponseFit by_noise = fit_response(measured, {}, options);
  EXPECT_EQ(by_noise.weights, Weights::noise);
  EXPECT_NEAR(by_noise.found.fit.chi2_per_dof(), by_coherence.found.fit.chi2_per_dof(), 1e-3);
}

/// A wrong line that is left out does not count, and modes outside of the band are not looked for.
TEST(FitResponse, UsesTheLinesOfTheBand) {
  Draw draw(23);
  const auto truth = reciprocal_modes(draw, 4, 1);
  MeasuredLines lines = testing::lines_of(truth, 1000, 0.005, draw);
  constexpr Eigen::Index hum = 79;
  lines.H[static_cast<std::size_t>(hum)] *= 30.0;
  ResponseFitOptions options;
  options.left_out = {{lines.hz(hum) - 0.1, lines.hz(hum) + 0.1}};
  const ResponseFit fit = fit_response(response_of(lines), {}, options);
  EXPECT_EQ(fit.lines.lines(), 999);
  EXPECT_EQ(fit.found.fit.modes.size(), 4u);
  options.band = {20.0, 0.5 * (truth[1].frequency_hz + truth[2].frequency_hz)};
  const ResponseFit low = fit_response(response_of(lines), {}, options);
  EXPECT_NEAR(low.found.fit.modes.at(0).frequency_hz, truth[0].frequency_hz, 1e-3 * truth[0].frequency_hz);
  options.band = {100.0, 100.5};
  EXPECT_THROW((void)fit_response(response_of(lines), {}, options), core::InputError);
}

TEST(FitResponse, TellsWhatIsWrong) {
  Draw draw(24);
  const auto truth = testing::random_modes(draw, 3, 2, 2);  // not reciprocal
  const dynamics::ResponseModel measured = response_of(testing::lines_of(truth, 500, 0.01, draw));
  ResponseFitOptions options;
  options.identify.residues = Residues::symmetric;
  EXPECT_TRUE(any_has(doubts_about(fit_response(measured, {}, options), measured.responses, measured.forces, options),
                      "symmetric residues do not fit"));
  const auto sound = reciprocal_modes(draw, 3, 2);
  dynamics::ResponseModel accelerance = response_of(testing::lines_of(sound, 500, 0.01, draw)), mobility = accelerance;
  for (std::size_t i = 0; i < accelerance.H.size(); ++i) {
    const std::complex<double> s(0.0, accelerance.axis.omega_rad_s(static_cast<Eigen::Index>(i)));
    accelerance.H[i] *= s * s;
    mobility.H[i] *= s;
  }
  EXPECT_TRUE(any_has(doubts_about(fit_response(accelerance, {}), accelerance.responses, accelerance.forces, {}),
                      "looks like an accelerance"));
  EXPECT_TRUE(any_has(doubts_about(fit_response(mobility, {}), mobility.responses, mobility.forces, {}),
                      "looks like a mobility"));
}

/// A heavily damped mode above the band, with the constant term alone: χ² says so, and which terms help.
TEST(FitResponse, TellsWhichTermsAreMissing) {
  Draw draw(5);
  auto truth = reciprocal_modes(draw, 3, 2);
  FittedMode above = truth[0];
  above.frequency_hz = 650.0;
  above.damping_ratio = 0.1;
  above.residue *= 3.0;
  truth.push_back(above);
  const dynamics::ResponseModel measured = response_of(testing::lines_of(truth, 600, 0.01, draw));
  ResponseFitOptions options;
  options.identify.terms = ResidualTerms{false, 0};
  options.identify.poles = Eigen::Vector3cd(truth[0].pole(), truth[1].pole(), truth[2].pole());
  const ResponseFit fit = fit_response(measured, {}, options);
  EXPECT_GT(fit.found.fit.chi2_per_dof(), 1.3);
  EXPECT_TRUE(any_has(doubts_about(fit, measured.responses, measured.forces, options), "terms are missing"));
}

/// A matrix, a column and a row of one reciprocal structure give one model, which has the whole matrix.
TEST(FittedModel, HasTheWholeMatrixByReciprocity) {
  Draw draw(26);
  const auto truth = reciprocal_modes(draw, 4, 3);
  const MeasuredLines lines = testing::lines_of(truth, 900, 0.0, draw);
  const dynamics::ResponseModel whole = response_of(lines);
  MeasuredLines column = lines, row = lines;
  for (std::size_t i = 0; i < lines.H.size(); ++i) {
    column.H[i] = lines.H[i].leftCols(1);
    row.H[i] = lines.H[i].topRows(1);
  }
  for (const MeasuredLines& some : {lines, column, row}) {
    dynamics::ResponseModel measured = whole;
    measured.H = some.H;
    measured.responses.resize(static_cast<std::size_t>(some.H[0].rows()));
    measured.forces.resize(static_cast<std::size_t>(some.H[0].cols()));
    ResponseFitOptions options;
    options.identify.terms = ResidualTerms{false, 0};
    const ResponseFit fit = fit_response(measured, {}, options);
    const dynamics::ModalModel model = modal_model(fit.found.fit, measured.responses, measured.forces);
    ASSERT_EQ(model.dofs.size(), 3u);
    dynamics::ModalModel poles_alone = model;
    poles_alone.residual.resize(0, 0);
    const dynamics::ResponseModel again = dynamics::to_response(poles_alone, whole.axis);
    // The static part is 2e-8 in every entry.
    for (const std::size_t i : {std::size_t{10}, std::size_t{400}, std::size_t{890}})
      EXPECT_LT((again.H[i].array() + 2e-8 - whole.H[i].array()).matrix().norm(), 1e-6 * whole.H[i].norm()) << i;
  }
  EXPECT_THROW((void)modal_model(fit_response(whole, {}).found.fit, dofs_of({"P", "Q", "R"}), dofs_of({"A", "B", "C"})),
               core::InputError);
}

/// Entries of different averages: with the number of each χ² is 1, with the first one's for all it is not.
TEST(FitResponse, WeighsEachEntryByItsOwnAverages) {
  Draw draw(27);
  const auto truth = reciprocal_modes(draw, 3, 2);
  const dynamics::ResponseModel measured = response_of(testing::lines_of(truth, 800, 0.02, draw));
  const Eigen::MatrixXd averages = (Eigen::Matrix2d() << 5.0, 40.0, 40.0, 10.0).finished();
  const Eigen::MatrixXd gamma2 = (1.0 + averages.array() * 0.02 * 0.02).inverse();
  const std::vector<Eigen::MatrixXd> coherence(800, gamma2);
  ResponseFitOptions options;
  options.averages = averages;
  EXPECT_NEAR(fit_response(measured, coherence, options).found.fit.chi2_per_dof(), 1.0, 0.05);
  options.averages = averages.topLeftCorner(1, 1);
  EXPECT_LT(fit_response(measured, coherence, options).found.fit.chi2_per_dof(), 0.7);
  options.averages = Eigen::MatrixXd::Ones(3, 2);
  EXPECT_THROW((void)fit_response(measured, coherence, options), core::InputError);
}

/// Noise that is stated must lie between 0 and 1, and intervals that are no numbers are told.
TEST(FitResponse, TellsOfNumbersThatAreNone) {
  Draw draw(28);
  const auto truth = reciprocal_modes(draw, 2, 1);
  const dynamics::ResponseModel measured = response_of(testing::lines_of(truth, 300, 0.01, draw));
  ResponseFitOptions options;
  for (const double wrong : {0.0, 1.0, std::nan("")}) {
    options.noise = Eigen::MatrixXd::Constant(1, 1, wrong);
    EXPECT_THROW((void)fit_response(measured, {}, options), core::InputError) << wrong;
  }
  options.noise = {};
  ResponseFit fit = fit_response(measured, {}, options);
  EXPECT_FALSE(any_has(doubts_about(fit, measured.responses, measured.forces, options), "no interval"));
  fit.found.fit.modes[0].sd_ln_damping = std::nan("");
  EXPECT_TRUE(any_has(doubts_about(fit, measured.responses, measured.forces, options), "has no interval"));
}

/// A stable pole serves the nearest of the frequencies that were chosen; the others start at 1 % of damping.
TEST(StablePoles, ServeTheNearestChoiceEach) {
  const auto pole = [](double hz, double zeta) {
    return 2.0 * std::numbers::pi * hz * std::complex<double>(-zeta, std::sqrt(1.0 - zeta * zeta));
  };
  const std::vector<StablePole> stable{{pole(100.0, 0.03), 5}, {pole(200.0, 0.002), 7}};
  const Eigen::VectorXcd chosen = poles_near({99.0, 102.0, 230.0}, stable);
  EXPECT_EQ(chosen(0), stable[0].pole);
  EXPECT_LT(std::abs(chosen(1) - pole(102.0, 0.01)), 1e-9);
  EXPECT_LT(std::abs(chosen(2) - pole(230.0, 0.01)), 1e-9);
}

/// A mass of 2 kg on a spring of 1 MN/m that moves along (0.6, 0.8).
TEST(FittedModel, HasTheMassAndTheLineOfAnOscillator) {
  constexpr double mass = 2.0, stiffness = 1e6, zeta = 0.03;
  const Eigen::Vector2d line(0.6, 0.8);
  FittedMode mode;
  const double omega = std::sqrt(stiffness / mass);
  mode.frequency_hz = omega / (2.0 * std::numbers::pi);
  mode.damping_ratio = zeta;
  mode.residue = (line * line.transpose()).cast<std::complex<double>>() /
                 (mass * std::complex<double>(0.0, 2.0 * omega * std::sqrt(1.0 - zeta * zeta)));
  ModalFit fit;
  fit.modes = {mode};
  const dynamics::DofTable dofs{{"tip", Eigen::Vector3d::UnitX(), dynamics::DofKind::translation},
                                {"tip", Eigen::Vector3d::UnitY(), dynamics::DofKind::translation}};
  const auto found = point_modes(fit, dofs, dofs);
  ASSERT_TRUE(found.at(0).has_value());
  EXPECT_NEAR(found[0]->mass_kg, mass, 1e-12 * mass);
  EXPECT_NEAR(found[0]->stiffness_N_m, stiffness, 1e-12 * stiffness);
  EXPECT_LT((found[0]->direction - line).norm(), 1e-12);
  fit.modes[0].residue *= -1.0;
  EXPECT_FALSE(point_modes(fit, dofs, dofs).at(0).has_value());
}

}  // namespace
}  // namespace thinwall::identification::fit_response_test
