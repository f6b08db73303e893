#pragma once
// Limiting depths of the low and of the high modes by themselves, and their lower envelope.

#include <Eigen/Core>
#include <vector>

#include "posture/bands.hpp"

namespace thinwall::posture {

/// Limiting depths, m, at each speed of a cut. Infinite where nothing yields.
struct BandEnvelope {
  double split_hz = 0.0;      ///< modes below it are the low ones
  Eigen::VectorXd low, high;  ///< of the low and of the high modes alone
  Eigen::VectorXd lower;      ///< the lesser of both
  Eigen::VectorXd together;   ///< of all modes, which the envelope may lie above
};

/// The frequencies |λ| of what an envelope splits, ascending, Hz: of the modes, or of the poles with Im λ > 0 of the
/// structure that stands for them by cut.structure_by. Throws as that does.
[[nodiscard]] std::vector<double> split_among_hz(const std::vector<identification::FittedMode>& modes,
                                                 const PostureCut& cut);

/// The middle, in logarithms, of the widest gap between neighbours of ascending frequencies: a robot's arm lies below
/// it, its spindle above. Throws InputError for fewer than two.
[[nodiscard]] double widest_gap_hz(const std::vector<double>& ascending_hz);

/// Stability of the low and of the high modes separately and the lowest envelope of both, as Lei 2022, Fig. 29 has it,
/// beside the stability of all modes together. The rest (m/N; empty: none) and what yields beside the robot
/// (`cut.beside`, as a tool) count to the high ones, whose cuts are fast enough to feel them. With
/// cut.structure_by its poles are split in place of the modes. Throws as limiting_depths(). Cost: three times that.
[[nodiscard]] BandEnvelope band_envelope(const std::vector<identification::FittedMode>& modes, const PostureCut& cut,
                                         double split_hz, const Eigen::MatrixXd& rest = {});

}  // namespace thinwall::posture
