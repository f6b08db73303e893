#pragma once
// Receptances and limiting depths at a predicted posture, with their bands.

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "milling/cut/process.hpp"
#include "milling/direct/lobe_row.hpp"
#include "milling/structure/relative_structure.hpp"
#include "posture/predictor.hpp"

namespace thinwall::posture {

/// The expected modes. The residue of a mode that stands alone is cut to a rank of one; those of modes that overlap,
/// closer than twice the mean of their half-power widths, are kept: near a crossing two modes exchange their shapes,
/// and only the sum of their residues, which the cut would change, is smooth over the postures. Drawn modes likewise.
[[nodiscard]] std::vector<identification::FittedMode> expected_modes(const PosturePrediction& prediction);

/// Modes drawn from the prediction. The numbers' deviations are normal, and correlated as the errors were where each
/// posture was predicted from the others: with the standardised residuals r_ti of number t at posture i, and a normal
/// g_i for each of the n postures,
///
///     t = mean + deviation Σ_i r_ti g_i/√n
///
/// so that entries of one residue, and modes that exchange their shapes near a crossing, err together, and deviations
/// that were too large or too small there are so no more. Numbers without residuals are drawn by themselves.
[[nodiscard]] std::vector<std::vector<identification::FittedMode>> drawn_modes(const PosturePrediction& prediction,
                                                                               int draws, unsigned seed = 1);

/// Σ_r residue_r/(s − λ_r) + conj., s = iω, responses × references, m/N.
[[nodiscard]] Eigen::MatrixXcd receptance(const std::vector<identification::FittedMode>& modes, double hz);

/// A receptance with its uncertainty at some lines, with what the modes leave out.
struct FrfBand {
  std::vector<Eigen::MatrixXcd> mean;       ///< of the expected modes, m/N
  std::vector<Eigen::MatrixXcd> deviation;  ///< of real and of imaginary part
};

/// The band to first order, deviation² = Σ_t (H(t + σ_t) − H(t − σ_t))²/4 over all numbers t of the modes with their
/// deviations σ_t: slopes are those of the chord over the band, which a resonance narrower than it needs. Cost: numbers
/// × lines.
[[nodiscard]] FrfBand frf_band(const PosturePrediction& prediction, const std::vector<double>& hz);

/// The band from draws: root mean squares of the deviations from the expected receptance.
[[nodiscard]] FrfBand frf_band_from_draws(const PosturePrediction& prediction, const std::vector<double>& hz, int draws,
                                          unsigned seed = 1);

/// A cut at a posture.
struct PostureCut {
  milling::MillingProcess process;
  Eigen::Matrix3Xd
      responses;  ///< directions of the tip's responses in the axes of the cut, one a column; 0: another point
  Eigen::Matrix3Xd references;  ///< likewise of the references
  std::vector<double> spindle_speeds_rpm;
  milling::StabilityOptions stability;
  std::optional<milling::RelativeStructure> beside{};  ///< what yields beside the robot, as a tool; part axes
  bool cross_terms = true;  ///< false: a force yields a response along its own reference alone, as
                            ///< robot::without_cross_terms() has it; responses are then the references
  /// The structure of a posture's modes where it is not their sum, as that of a robot whose tool is swapped for
  /// another: what of the above tells how modes are felt is then not used, nor is the rest. Called by several threads
  /// at once.
  std::function<milling::RelativeStructure(const std::vector<identification::FittedMode>&)> structure_by{};
};

/// The structure that the cut feels, with what yields beside the robot. A residue gives as many pairs of shapes as its
/// rank. `rest` is the static compliance that the modes leave out, m/N; empty: none. With cut.structure_by it is that.
[[nodiscard]] milling::RelativeStructure structure_of(const std::vector<identification::FittedMode>& modes,
                                                      const PostureCut& cut, const Eigen::MatrixXd& rest = {});

/// Limiting depths, m, at each speed. Throws as milling::limiting_depth().
[[nodiscard]] Eigen::VectorXd limiting_depths(const std::vector<identification::FittedMode>& modes,
                                              const PostureCut& cut, const Eigen::MatrixXd& rest = {});

/// Limiting depths of a structure, m, at each speed of the cut. Throws as milling::limiting_depth().
[[nodiscard]] Eigen::VectorXd limiting_depths(const milling::RelativeStructure& structure, const PostureCut& cut);

/// Limiting depths with their band, m, at each speed.
struct DepthBand {
  Eigen::VectorXd depth;      ///< of the expected modes
  Eigen::VectorXd low, high;  ///< 95 % of the depths lie between
};

/// The band from draws of the modes, between their quantiles at 2.5 % and 97.5 %. Throws InputError for fewer than 40
/// draws, which have no such quantiles. Cost: draws × speeds times limiting_depth(), draws shared out among
/// core::thread_count() threads.
[[nodiscard]] DepthBand depth_band_from_draws(const PosturePrediction& prediction, const PostureCut& cut, int draws,
                                              unsigned seed = 1);

/// The change of ln depth with each number of each mode, one deviation of it, by the chord as in frf_band(): speeds ×
/// numbers, mode after mode.
[[nodiscard]] Eigen::MatrixXd depth_slopes(const PosturePrediction& prediction, const PostureCut& cut);

/// The band to first order, depth e^{∓1.96 σ} with σ² the sum of squares of a row of depth_slopes(). Where a band
/// reaches into another lobe it is only a hint. Cost: twice the numbers × speeds times limiting_depth().
[[nodiscard]] DepthBand depth_band(const PosturePrediction& prediction, const PostureCut& cut);

}  // namespace thinwall::posture
