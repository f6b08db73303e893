#include "posture/bands.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <string>
#include <tuple>

#include "core/dense_factorisations.hpp"
#include "core/draws.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "milling/direct/stability.hpp"

namespace thinwall::posture {

namespace {

using identification::FittedMode;
using Complex = std::complex<double>;

Eigen::MatrixXcd of_one_mode(const FittedMode& mode, double hz) {
  const Complex s(0.0, 2.0 * std::numbers::pi * hz), pole = mode.pole();
  return mode.residue / (s - pole) + mode.residue.conjugate() / (s - std::conj(pole));
}

/// A mode with one of its numbers moved by so many deviations.
FittedMode moved_in(const PosturePrediction& prediction, const PredictedMode& mode, Eigen::Index t, double deviations) {
  return moved(prediction, mode, deviations * Eigen::VectorXd::Unit(mode.mean.size(), t));
}

Eigen::MatrixXcd squares_of_parts(const Eigen::MatrixXcd& change) {
  return change.unaryExpr([](Complex c) { return Complex(c.real() * c.real(), c.imag() * c.imag()); });
}

Eigen::MatrixXcd roots_of_parts(const Eigen::MatrixXcd& square) {
  return square.unaryExpr([](Complex c) { return Complex(std::sqrt(c.real()), std::sqrt(c.imag())); });
}

/// The variance of what the modes leave out, which is real; zeros of the size of H where it is not known.
Eigen::MatrixXcd rest_variance(const PosturePrediction& prediction, const Eigen::MatrixXcd& H) {
  if (prediction.rest.size() == 0) return Eigen::MatrixXcd::Zero(H.rows(), H.cols());
  return prediction.rest_deviation.cwiseAbs2().cast<Complex>();
}

Eigen::VectorXd normal_draws(Eigen::Index count, std::mt19937& random) {
  Eigen::VectorXd draws(count);
  for (double& draw : draws) draw = core::normal_draw(random);
  return draws;
}

/// Deviations of a mode's numbers with the covariance of its residuals over the postures where it was seen, by one
/// normal number for each posture.
Eigen::VectorXd correlated(const Eigen::MatrixXd& residuals, const Eigen::VectorXd& of_postures) {
  const auto seen = (residuals.colwise().squaredNorm().array() > 0.0).count();
  return residuals * of_postures.head(residuals.cols()) /
         std::sqrt(static_cast<double>(std::max<Eigen::Index>(1, seen)));
}

/// True if the resonance of another mode overlaps this one's: their frequencies differ by less than twice the mean of
/// their half-power widths.
bool overlaps(const FittedMode& mode, const FittedMode& other) {
  return std::abs(mode.frequency_hz - other.frequency_hz) <
         2.0 * (mode.damping_ratio * mode.frequency_hz + other.damping_ratio * other.frequency_hz);
}

/// Residues of modes that stand alone are cut to a rank of one; those of modes that overlap are kept.
void cut_ranks(std::vector<FittedMode>& modes) {
  for (FittedMode& mode : modes) {
    const bool alone =
        std::ranges::none_of(modes, [&](const FittedMode& other) { return &other != &mode && overlaps(mode, other); });
    if (alone) mode.residue = mode.right * mode.left.transpose();
  }
}

/// A matrix over responses and references without its cross terms, where the cut leaves these out.
template <class Matrix>
Matrix felt(const Matrix& matrix, const PostureCut& cut) {
  return cut.cross_terms ? matrix : Matrix(matrix.diagonal().asDiagonal());
}

}  // namespace

std::vector<FittedMode> expected_modes(const PosturePrediction& prediction) {
  std::vector<FittedMode> modes;
  for (const PredictedMode& mode : prediction.modes)
    modes.push_back(moved(prediction, mode, Eigen::VectorXd::Zero(mode.mean.size())));
  cut_ranks(modes);
  return modes;
}

std::vector<std::vector<FittedMode>> drawn_modes(const PosturePrediction& prediction, int draws, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::vector<FittedMode>> result(static_cast<std::size_t>(std::max(draws, 0)));
  for (std::vector<FittedMode>& modes : result) {
    Eigen::VectorXd of_postures;
    for (const PredictedMode& mode : prediction.modes) {
      if (of_postures.size() < mode.residuals.cols()) of_postures = normal_draws(mode.residuals.cols(), random);
      modes.push_back(moved(prediction, mode,
                            mode.residuals.size() > 0 ? correlated(mode.residuals, of_postures)
                                                      : normal_draws(mode.mean.size(), random)));
    }
    cut_ranks(modes);
  }
  return result;
}

Eigen::MatrixXcd receptance(const std::vector<FittedMode>& modes, double hz) {
  if (modes.empty()) throw core::InputError("receptance of no mode, must be at least one; learn from more postures");
  Eigen::MatrixXcd H = of_one_mode(modes.front(), hz);
  for (std::size_t r = 1; r < modes.size(); ++r) H += of_one_mode(modes[r], hz);
  return H;
}

FrfBand frf_band(const PosturePrediction& prediction, const std::vector<double>& hz) {
  const std::vector<FittedMode> expected = expected_modes(prediction);
  FrfBand band;
  for (const double f : hz) {
    band.mean.push_back(receptance(expected, f));
    band.deviation.emplace_back(rest_variance(prediction, band.mean.back()));
  }
  for (const PredictedMode& mode : prediction.modes) {
    for (Eigen::Index t = 0; t < mode.mean.size(); ++t) {
      const FittedMode up = moved_in(prediction, mode, t, 1.0), down = moved_in(prediction, mode, t, -1.0);
      for (std::size_t k = 0; k < hz.size(); ++k)
        band.deviation[k] += squares_of_parts(0.5 * (of_one_mode(up, hz[k]) - of_one_mode(down, hz[k])));
    }
  }
  for (Eigen::MatrixXcd& deviation : band.deviation) deviation = roots_of_parts(deviation);
  if (prediction.rest.size() > 0) {
    for (Eigen::MatrixXcd& mean : band.mean) mean += prediction.rest;
  }
  return band;
}

FrfBand frf_band_from_draws(const PosturePrediction& prediction, const std::vector<double>& hz, int draws,
                            unsigned seed) {
  if (draws < 1) throw core::InputError("a band of " + std::to_string(draws) + " draws, must be at least 1");
  const std::vector<FittedMode> expected = expected_modes(prediction);
  const std::vector<std::vector<FittedMode>> drawn = drawn_modes(prediction, draws, seed);
  FrfBand band;
  for (const double f : hz) {
    band.mean.push_back(receptance(expected, f));
    Eigen::MatrixXcd sum = Eigen::MatrixXcd::Zero(band.mean.back().rows(), band.mean.back().cols());
    for (const std::vector<FittedMode>& modes : drawn) sum += squares_of_parts(receptance(modes, f) - band.mean.back());
    band.deviation.push_back(
        roots_of_parts(sum / static_cast<double>(draws) + rest_variance(prediction, band.mean.back())));
    if (prediction.rest.size() > 0) band.mean.back() += prediction.rest;
  }
  return band;
}

milling::RelativeStructure structure_of(const std::vector<FittedMode>& modes, const PostureCut& cut,
                                        const Eigen::MatrixXd& rest) {
  if (cut.structure_by) return cut.structure_by(modes);
  milling::RelativeStructure structure;
  for (const FittedMode& mode : modes) {
    const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(felt(mode.residue, cut), Eigen::ComputeThinU | Eigen::ComputeThinV);
    const Eigen::VectorXd& size = svd.singularValues();
    const Eigen::Index before = structure.poles.size(), ranks = (size.array() > 1e-9 * size(0)).count();
    structure.poles.conservativeResize(before + ranks);
    structure.phi.conservativeResize(3, before + ranks);
    structure.b.conservativeResize(3, before + ranks);
    structure.poles.tail(ranks).setConstant(mode.pole());
    structure.phi.rightCols(ranks) = cut.responses * svd.matrixU().leftCols(ranks) * size.head(ranks).asDiagonal();
    structure.b.rightCols(ranks) = cut.references * svd.matrixV().leftCols(ranks).conjugate();
  }
  if (rest.size() > 0) structure.R = cut.responses * felt(rest, cut) * cut.references.transpose();
  return cut.beside ? milling::sum(structure, *cut.beside) : structure;
}

Eigen::VectorXd limiting_depths(const std::vector<FittedMode>& modes, const PostureCut& cut,
                                const Eigen::MatrixXd& rest) {
  return limiting_depths(structure_of(modes, cut, rest), cut);
}

Eigen::VectorXd limiting_depths(const milling::RelativeStructure& structure, const PostureCut& cut) {
  milling::StabilityOptions options = cut.stability;
  options.follow = 1.0;
  Eigen::VectorXd depths(static_cast<Eigen::Index>(cut.spindle_speeds_rpm.size()));
  for (Eigen::Index i = 0; i < depths.size(); ++i) {
    depths(i) =
        milling::limiting_depth(structure, cut.process, cut.spindle_speeds_rpm[static_cast<std::size_t>(i)], options)
            .limiting_depth_m;
  }
  return depths;
}

DepthBand depth_band_from_draws(const PosturePrediction& prediction, const PostureCut& cut, int draws, unsigned seed) {
  if (draws < 40)
    throw core::InputError("a band of depths from " + std::to_string(draws) + " draws, must be at least 40");
  Eigen::MatrixXd drawn(static_cast<Eigen::Index>(cut.spindle_speeds_rpm.size()), draws);
  const std::vector<std::vector<FittedMode>> modes = drawn_modes(prediction, draws, seed);
  core::parallel_for(modes.size(), [&](std::size_t i) {
    drawn.col(static_cast<Eigen::Index>(i)) = limiting_depths(modes[i], cut, prediction.rest);
  });
  DepthBand band{limiting_depths(expected_modes(prediction), cut, prediction.rest), Eigen::VectorXd(drawn.rows()),
                 Eigen::VectorXd(drawn.rows())};
  for (Eigen::Index i = 0; i < drawn.rows(); ++i) {
    const Eigen::VectorXd row = drawn.row(i);
    std::tie(band.low(i), band.high(i)) = core::middle_95_percent({row.begin(), row.end()});
  }
  return band;
}

Eigen::MatrixXd depth_slopes(const PosturePrediction& prediction, const PostureCut& cut) {
  std::vector<FittedMode> modes = expected_modes(prediction);
  Eigen::Index numbers = 0;
  for (const PredictedMode& mode : prediction.modes) numbers += mode.mean.size();
  Eigen::MatrixXd slopes(static_cast<Eigen::Index>(cut.spindle_speeds_rpm.size()), numbers);
  Eigen::Index column = 0;
  for (std::size_t r = 0; r < modes.size(); ++r) {
    const FittedMode expected = modes[r];
    const auto ln_depths = [&](Eigen::Index t, double deviations) {
      modes[r] = moved_in(prediction, prediction.modes[r], t, deviations);
      return Eigen::VectorXd(limiting_depths(modes, cut, prediction.rest).array().log());
    };
    for (Eigen::Index t = 0; t < prediction.modes[r].mean.size(); ++t)
      slopes.col(column++) = 0.5 * (ln_depths(t, 1.0) - ln_depths(t, -1.0));
    modes[r] = expected;
  }
  return slopes;
}

DepthBand depth_band(const PosturePrediction& prediction, const PostureCut& cut) {
  const Eigen::VectorXd depth = limiting_depths(expected_modes(prediction), cut, prediction.rest);
  const Eigen::ArrayXd sigma = depth_slopes(prediction, cut).rowwise().norm();
  return {depth, depth.array() * (-1.96 * sigma).exp(), depth.array() * (1.96 * sigma).exp()};
}

}  // namespace thinwall::posture
