#include "identification/drawn_fits.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <random>

#include "core/draws.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"

namespace thinwall::identification {

namespace {

/// The model of the fit with noise of the lines' variances times `share`.
MeasuredLines drawn_lines(const MeasuredLines& measured, const std::vector<Eigen::MatrixXcd>& model,
                          const Eigen::MatrixXi& source, double share, unsigned seed) {
  std::mt19937 random(seed);
  MeasuredLines drawn = measured;
  for (std::size_t line = 0; line < model.size(); ++line) {
    std::map<int, std::complex<double>> noise;
    for (Eigen::Index e = 0; e < source.size(); ++e) {
      const auto [own, is_new] = noise.try_emplace(source(e));
      if (is_new) {
        const double real = core::normal_draw(random);
        own->second = {real, core::normal_draw(random)};
      }
      drawn.H[line](e) = model[line](e) + std::sqrt(0.5 * share * measured.variance[line](e)) * own->second;
    }
  }
  return drawn;
}

}  // namespace

std::vector<ModalFit> drawn_fits(const MeasuredLines& measured, const ModalFit& fit, const ModalFitOptions& options,
                                 const Eigen::MatrixXi& source, int draws, unsigned seed) {
  require_usable(measured);
  if (source.rows() != measured.responses() || source.cols() != measured.references())
    throw core::InputError("draws of a fit: the numbers of the measurements are " + std::to_string(source.rows()) +
                           " x " + std::to_string(source.cols()) + ", must be of the shape of the lines");
  std::vector<Eigen::MatrixXcd> model;
  for (const double hz : measured.hz) model.push_back(value(fit, hz));
  const double share = std::max(1.0, fit.chi2_per_dof());
  std::vector<ModalFit> fits(static_cast<std::size_t>(std::max(0, draws)));
  core::Progress progress("draws of the fit", fits.size());
  core::parallel_for(fits.size(), [&](std::size_t i) {
    fits[i] =
        modal_fit(drawn_lines(measured, model, source, share, seed + static_cast<unsigned>(i)), poles_of(fit), options);
    progress.step();
  });
  return fits;
}

}  // namespace thinwall::identification
