#include "posture/band_envelope.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <string>

#include "core/error.hpp"

namespace thinwall::posture {

namespace {

using identification::FittedMode;

Eigen::VectorXd depths_of(const std::vector<FittedMode>& modes, const PostureCut& cut, const Eigen::MatrixXd& rest) {
  if (modes.empty() && !cut.beside && rest.size() == 0)
    return Eigen::VectorXd::Constant(std::ssize(cut.spindle_speeds_rpm), std::numeric_limits<double>::infinity());
  return limiting_depths(modes, cut, rest);
}

/// The poles of a structure with |λ| at the split or above it, with what the poles leave out, or those below it.
milling::RelativeStructure part_of(const milling::RelativeStructure& structure, double split_hz, bool above) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < structure.poles.size(); ++k) {
    if ((std::abs(structure.poles(k)) >= 2.0 * std::numbers::pi * split_hz) == above) kept.push_back(k);
  }
  milling::RelativeStructure part{structure.poles(kept), structure.phi(Eigen::all, kept), structure.b(Eigen::all, kept),
                                  Eigen::Matrix3d::Zero()};
  if (above) part.R = structure.R;
  return part;
}

/// The envelope of a structure's own poles.
BandEnvelope envelope_of_poles(const milling::RelativeStructure& structure, const PostureCut& cut, double split_hz) {
  const auto depths = [&](bool above) -> Eigen::VectorXd {
    const milling::RelativeStructure part = part_of(structure, split_hz, above);
    if (part.poles.size() == 0 && part.R.isZero(0.0))
      return Eigen::VectorXd::Constant(std::ssize(cut.spindle_speeds_rpm), std::numeric_limits<double>::infinity());
    return limiting_depths(part, cut);
  };
  BandEnvelope result{split_hz, depths(false), depths(true), {}, limiting_depths(structure, cut)};
  result.lower = result.low.cwiseMin(result.high);
  return result;
}

}  // namespace

std::vector<double> split_among_hz(const std::vector<FittedMode>& modes, const PostureCut& cut) {
  std::vector<double> hz;
  if (cut.structure_by) {
    for (const std::complex<double>& pole : cut.structure_by(modes).poles) {
      if (pole.imag() > 0.0) hz.push_back(std::abs(pole) / (2.0 * std::numbers::pi));
    }
  } else {
    for (const FittedMode& mode : modes) hz.push_back(mode.frequency_hz);
  }
  std::ranges::sort(hz);
  return hz;
}

double widest_gap_hz(const std::vector<double>& ascending_hz) {
  if (ascending_hz.size() < 2)
    throw core::InputError("low and high modes of " + std::to_string(ascending_hz.size()) + ", must be at least 2");
  std::size_t widest = 1;
  const auto ratio = [&](std::size_t i) { return ascending_hz[i] / ascending_hz[i - 1]; };
  for (std::size_t i = 1; i < ascending_hz.size(); ++i) {
    if (ratio(i) > ratio(widest)) widest = i;
  }
  return std::sqrt(ascending_hz[widest] * ascending_hz[widest - 1]);
}

BandEnvelope band_envelope(const std::vector<FittedMode>& modes, const PostureCut& cut, double split_hz,
                           const Eigen::MatrixXd& rest) {
  if (cut.structure_by) return envelope_of_poles(cut.structure_by(modes), cut, split_hz);
  std::vector<FittedMode> low, high;
  for (const FittedMode& mode : modes) (mode.frequency_hz < split_hz ? low : high).push_back(mode);
  PostureCut robot_alone = cut;
  robot_alone.beside.reset();
  BandEnvelope result{
      split_hz, depths_of(low, robot_alone, {}), depths_of(high, cut, rest), {}, depths_of(modes, cut, rest)};
  result.lower = result.low.cwiseMin(result.high);
  return result;
}

}  // namespace thinwall::posture
