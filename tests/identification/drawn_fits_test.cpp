// Fits of lines that are drawn anew.

#include "identification/drawn_fits.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "tests/identification/random_structure.hpp"

namespace thinwall::identification::drawn_fits_test {
namespace {

using testing::Draw;

/// Their scatter is that of the fit's covariance, to the standard error of a deviation from 300 draws, 4.1 %.
TEST(DrawnFits, ScatterAsTheCovarianceSays) {
  Draw draw(11);
  const auto truth = testing::random_modes(draw, 3, 2, 2);
  Eigen::VectorXcd start(3);
  for (std::size_t r = 0; r < 3; ++r) start(static_cast<Eigen::Index>(r)) = truth[r].pole();
  const MeasuredLines measured = testing::lines_of(truth, 150, 0.01, draw);
  const ModalFitOptions options{{false, 0}};
  const ModalFit fit = modal_fit(measured, start, options);
  Eigen::MatrixXi each(2, 2);
  each << 0, 1, 2, 3;
  constexpr int draws = 300;
  const std::vector<ModalFit> drawn = drawn_fits(measured, fit, options, each, draws);
  // The noise that is drawn is more by as much as χ² is above 1 by chance.
  const double more = std::sqrt(std::max(1.0, fit.chi2_per_dof()));
  for (std::size_t r = 0; r < 3; ++r) {
    double of_frequency = 0.0, of_damping = 0.0;
    for (const ModalFit& one : drawn) {
      of_frequency += std::pow(std::log(one.modes[r].frequency_hz / fit.modes[r].frequency_hz), 2) / draws;
      of_damping += std::pow(std::log(one.modes[r].damping_ratio / fit.modes[r].damping_ratio), 2) / draws;
    }
    EXPECT_NEAR(std::sqrt(of_frequency) / (more * fit.modes[r].sd_ln_frequency), 1.0, 3.0 * 0.041);
    EXPECT_NEAR(std::sqrt(of_damping) / (more * fit.modes[r].sd_ln_damping), 1.0, 3.0 * 0.041);
  }
}

/// Entries of one measurement have one noise: those of a matrix that was completed by its transposes stay symmetric.
TEST(DrawnFits, OfOneMeasurementHaveOneNoise) {
  Draw draw(4);
  auto truth = testing::random_modes(draw, 2, 2, 2);
  Eigen::VectorXcd start(2);
  for (std::size_t r = 0; r < 2; ++r) {
    truth[r].residue = (0.5 * (truth[r].residue + truth[r].residue.transpose())).eval();
    start(static_cast<Eigen::Index>(r)) = truth[r].pole();
  }
  const MeasuredLines measured = testing::lines_of(truth, 150, 0.0, draw);
  MeasuredLines noisy = measured;
  for (std::size_t i = 0; i < noisy.variance.size(); ++i)
    noisy.variance[i].setConstant(1e-4 * noisy.H[i].squaredNorm());
  const ModalFitOptions options{{false, 0}, Residues::free};
  Eigen::MatrixXi source(2, 2);
  source << 0, 1, 1, 2;
  for (const ModalFit& one : drawn_fits(noisy, modal_fit(noisy, start, options), options, source, 4)) {
    for (std::size_t r = 0; r < 2; ++r) {
      const Eigen::MatrixXcd& R = one.modes[r].residue;
      EXPECT_LT((R - R.transpose()).norm(), 1e-6 * R.norm());
      EXPECT_GT((R - truth[r].residue).norm(), 1e-5 * R.norm()) << "there is noise";
    }
  }
  EXPECT_THROW((void)drawn_fits(noisy, modal_fit(noisy, start, options), options, Eigen::MatrixXi::Zero(1, 2), 4),
               core::InputError);
}

}  // namespace
}  // namespace thinwall::identification::drawn_fits_test
