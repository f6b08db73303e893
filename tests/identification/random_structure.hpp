#pragma once
// Modes at random, their receptances, and noise.

#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <vector>

#include "identification/modal_fit.hpp"

namespace thinwall::identification::testing {

/// Numbers that are the same everywhere, as those of the standard library's distributions are not.
class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_()) / static_cast<double>(std::mt19937::max());
  }
  double normal() {  // Box & Muller
    const double u = between(1e-12, 1.0), v = between(0.0, 1.0);
    return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
  }

 private:
  std::mt19937 random_;
};

/// Modes of rank one over a band of 20 to 400 Hz with vectors that differ on both sides; the size of each residue is
/// that of a mode of about a kilogram.
inline std::vector<FittedMode> random_modes(Draw& draw, int modes, int responses, int references,
                                            double heaviest = 0.05) {
  std::vector<FittedMode> result;
  for (int r = 0; r < modes; ++r) {
    FittedMode mode;
    mode.frequency_hz = 30.0 * std::pow(350.0 / 30.0, (r + draw.between(0.2, 0.8)) / modes);
    mode.damping_ratio = 0.005 * std::pow(heaviest / 0.005, draw.between(0.0, 1.0));
    const double omega = 2.0 * std::numbers::pi * mode.frequency_hz;
    mode.right.resize(responses);
    mode.left.resize(references);
    for (auto& v : mode.right)
      v = std::complex<double>(draw.between(-0.2, 0.2), draw.between(-1.0, 1.0)) / (2.0 * omega);
    for (auto& v : mode.left) v = std::complex<double>(draw.between(-1.0, 1.0), draw.between(-0.2, 0.2));
    Eigen::Index largest = 0;
    mode.left.cwiseAbs().maxCoeff(&largest);
    mode.right *= mode.left(largest);
    mode.left /= std::complex<double>(mode.left(largest));
    mode.residue = mode.right * mode.left.transpose();
    result.push_back(mode);
  }
  return result;
}

/// Lines of the modes and a static part from 20 to 400 Hz, off by a share of each entry's size.
inline MeasuredLines lines_of(const std::vector<FittedMode>& modes, int lines, double noise, Draw& draw) {
  ModalFit model;
  model.modes = modes;
  const Eigen::Index rows = modes.front().residue.rows(), columns = modes.front().residue.cols();
  model.powers = {Eigen::MatrixXd::Constant(rows, columns, 2e-8)};
  MeasuredLines measured;
  measured.hz = Eigen::VectorXd::LinSpaced(lines, 20.0, 400.0);
  for (const double hz : measured.hz) {
    const Eigen::MatrixXcd H = value(model, hz);
    const Eigen::MatrixXd sd = std::max(noise, 1e-6) * H.cwiseAbs();
    Eigen::MatrixXcd seen = H;
    for (Eigen::Index j = 0; j < rows && noise > 0.0; ++j) {
      for (Eigen::Index k = 0; k < columns; ++k)
        seen(j, k) += sd(j, k) / std::sqrt(2.0) * std::complex<double>(draw.normal(), draw.normal());
    }
    measured.H.push_back(seen);
    measured.variance.emplace_back(sd.cwiseAbs2());
  }
  return measured;
}

}  // namespace thinwall::identification::testing
