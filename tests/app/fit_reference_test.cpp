// `thinwall fit` on a reference measurement: 4 x 4 receptances of the milling robot of tests/data at one posture, with
// a drive that couples without reciprocity and noise of 1 %, and the truth that they were made from.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <vector>

#include "app/case_run.hpp"
#include "app/command_line.hpp"
#include "core/dense_factorisations.hpp"
#include "identification/fit_response.hpp"
#include "io/frf/uff.hpp"
#include "tests/core/temporary_folder.hpp"
#include "tests/identification/cramer_rao.hpp"
#include "tests/identification/random_structure.hpp"

namespace thinwall::tests::fit_reference_test {
namespace {

std::complex<double> pole(double hz, double damping) {
  return 2.0 * std::numbers::pi * hz * std::complex<double>(-damping, std::sqrt(1.0 - damping * damping));
}

Eigen::MatrixXcd matrix(const nlohmann::json& re, const nlohmann::json& im) {
  Eigen::MatrixXcd result(std::ssize(re), std::ssize(re[0]));
  for (std::size_t i = 0; i < re.size(); ++i) {
    for (std::size_t j = 0; j < re[i].size(); ++j)
      result(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = {re[i][j].get<double>(),
                                                                            im[i][j].get<double>()};
  }
  return result;
}

const std::string reference = THINWALL_SOURCE_DIR "/tests/data/milling-robot/posture_000_low";

/// Every pole within 1e-4, and half of the residues as well as all of them together within 0.2 %, in Frobenius' norm,
/// in which another program has its errors: told the weights and the terms, it is off by 9e-5 at most, by 0.15 % in the
/// median and by 0.1 % together. The largest error, 0.6 % for both, is that of a mode whose residue the noise leaves
/// known to 0.66 %: the test below has the bound.
TEST(FitOfAReferencePosture, HasThePolesAndResiduesOfTheTruth) {
  const TemporaryFolder folder;
  const std::string file = reference + ".uff", to = (folder.path / "out").string();
  const std::vector<const char*> words{"thinwall", "fit", file.c_str(), "--averages", "8", "--out", to.c_str()};
  std::ostringstream out, err;
  ASSERT_EQ(app::run_command_line(static_cast<int>(words.size()), words.data(), app::run_case, out, err), 0)
      << err.str();
  const auto truth = nlohmann::json::parse(std::ifstream(reference + ".json"));
  const auto found = nlohmann::json::parse(std::ifstream(folder.path / "out" / "fit.json"));
  const nlohmann::json& modes = found["modes"];
  ASSERT_EQ(modes.size(), truth["frequency_hz"].size());
  EXPECT_NEAR(found["chi2_per_dof"].get<double>(), 1.0, 0.05);
  std::vector<double> of_residue;
  double squares = 0.0, squares_of_truth = 0.0;
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const auto exact = pole(truth["frequency_hz"][k], truth["damping_ratio"][k]);
    EXPECT_LT(std::abs(pole(modes[k]["frequency_hz"], modes[k]["damping_ratio"]) - exact), 1e-4 * std::abs(exact)) << k;
    const Eigen::MatrixXcd R = matrix(modes[k]["residue_re"], modes[k]["residue_im"]),
                           of_truth = matrix(truth["residues_re"][k], truth["residues_im"][k]);
    of_residue.push_back((R - of_truth).norm() / of_truth.norm());
    squares += (R - of_truth).squaredNorm();
    squares_of_truth += of_truth.squaredNorm();
  }
  std::ranges::sort(of_residue);
  EXPECT_LT(of_residue[of_residue.size() / 2], 0.002);
  EXPECT_LT(std::sqrt(squares / squares_of_truth), 0.002);
  EXPECT_LT(of_residue.back(), 0.01);
}

/// The robot's modes at that posture, with the residual terms that a fit of the measurement has, its lines without
/// noise, and the coherence of the file.
struct Posture {
  identification::ModalFit model;
  identification::MeasuredLines lines;
  dynamics::ResponseModel response;
  std::vector<Eigen::MatrixXd> coherence;
  identification::ResponseFitOptions options;  ///< the true poles and the terms
};

/// The vectors of a matrix of rank one, with 1 as the largest entry of the left one.
void set_vectors(identification::FittedMode& mode) {
  const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(mode.residue, Eigen::ComputeThinU | Eigen::ComputeThinV);
  mode.left = svd.matrixV().col(0).conjugate();
  Eigen::Index largest = 0;
  mode.left.cwiseAbs().maxCoeff(&largest);
  const std::complex<double> scale = mode.left(largest);
  mode.left /= scale;
  mode.right = svd.singularValues()(0) * scale * svd.matrixU().col(0);
}

Posture read_posture() {
  const io::MeasuredResponse measured = io::read_uff(reference + ".uff");
  Posture posture{{}, {}, measured.response, {}, {}};
  posture.coherence.assign(measured.response.H.size(), Eigen::MatrixXd(4, 4));
  for (const io::EntryCoherence& entry : measured.coherence) {
    for (std::size_t k = 0; k < posture.coherence.size(); ++k)
      posture.coherence[k](entry.row, entry.column) = entry.values(static_cast<Eigen::Index>(k));
  }
  const auto truth = nlohmann::json::parse(std::ifstream(reference + ".json"));
  posture.options.averages = Eigen::MatrixXd::Constant(1, 1, 8.0);
  posture.options.identify.terms = identification::ResidualTerms{true, 2};
  posture.options.identify.poles.resize(std::ssize(truth["frequency_hz"]));
  for (std::size_t k = 0; k < truth["frequency_hz"].size(); ++k)
    posture.options.identify.poles(static_cast<Eigen::Index>(k)) =
        pole(truth["frequency_hz"][k], truth["damping_ratio"][k]);
  const identification::ResponseFit fit =
      identification::fit_response(measured.response, posture.coherence, posture.options);
  posture.model = fit.found.fit;
  for (std::size_t k = 0; k < posture.model.modes.size(); ++k) {
    identification::FittedMode& mode = posture.model.modes[k];
    mode.frequency_hz = truth["frequency_hz"][k];
    mode.damping_ratio = truth["damping_ratio"][k];
    mode.residue = matrix(truth["residues_re"][k], truth["residues_im"][k]);
    set_vectors(mode);
  }
  posture.lines = fit.lines;
  for (Eigen::Index k = 0; k < posture.lines.lines(); ++k)
    posture.lines.H[static_cast<std::size_t>(k)] = identification::value(posture.model, posture.lines.hz(k));
  posture.lines.variance = identification::variance_of(posture.lines.H, posture.coherence, posture.options.averages);
  return posture;
}

/// The modes of the posture's lines with noise that is drawn anew.
std::vector<identification::FittedMode> drawn_modes(Posture& posture, identification::testing::Draw& draw) {
  for (std::size_t k = 0; k < posture.lines.H.size(); ++k) {
    for (Eigen::Index e = 0; e < posture.lines.H[k].size(); ++e) {
      const double deviation = std::sqrt(posture.lines.variance[k](e) / 2.0), re = draw.normal(), im = draw.normal();
      posture.response.H[k](e) = posture.lines.H[k](e) + deviation * std::complex<double>(re, im);
    }
  }
  return identification::fit_response(posture.response, posture.coherence, posture.options).found.fit.modes;
}

/// Over 20 draws of the noise the errors of poles, of residues in Frobenius' norm and of their entries have the mean
/// squares of the bound of Cramer and Rao, so that no estimator without bias does better in either norm; half of the
/// residues are within 0.2 % in every draw. The mean of 7 x 20 squares scatters by 12 % for poles, which are two
/// numbers each, and by less for residues.
TEST(FitOfAReferencePosture, ReachesTheBoundOfCramerAndRao) {
  Posture posture = read_posture();
  const std::vector<identification::testing::Bound> bounds =
      identification::testing::bounds(posture.model, posture.lines);
  constexpr int draws = 20;
  identification::testing::Draw draw(77);
  double of_poles = 0.0, of_residues = 0.0, of_entries = 0.0;
  for (int i = 0; i < draws; ++i) {
    const std::vector<identification::FittedMode> modes = drawn_modes(posture, draw);
    ASSERT_EQ(modes.size(), bounds.size());
    std::vector<double> relative;
    for (std::size_t k = 0; k < modes.size(); ++k) {
      const identification::FittedMode& truth = posture.model.modes[k];
      const Eigen::ArrayXXd squares = (modes[k].residue - truth.residue).cwiseAbs2().array();
      const double share = 1.0 / (draws * static_cast<double>(modes.size()));
      of_poles += share * std::norm(modes[k].pole() - truth.pole()) / bounds[k].pole;
      of_residues += share * squares.sum() / bounds[k].residues.sum();
      of_entries += share * (squares / bounds[k].residues).mean();
      relative.push_back(std::sqrt(squares.sum()) / truth.residue.norm());
    }
    std::ranges::sort(relative);
    EXPECT_LT(relative[relative.size() / 2], 0.002) << i;
  }
  EXPECT_NEAR(of_poles, 1.0, 0.25);
  EXPECT_NEAR(of_residues, 1.0, 0.2);
  EXPECT_NEAR(of_entries, 1.0, 0.2);
}

}  // namespace
}  // namespace thinwall::tests::fit_reference_test
