#pragma once
// The judgement of a prediction over postures: each posture from others that do not know it.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "posture/bands.hpp"
#include "posture/predictor.hpp"

namespace thinwall::posture {

/// The numbers of a mode (targets_of()) at a posture, and what the postures of the other folds say of them.
struct HeldOutMode {
  std::size_t posture = 0;  ///< its number
  int label = 0;
  Eigen::VectorXd measured;
  Eigen::VectorXd predicted;
  Eigen::VectorXd deviation;  ///< of what a test would give: of the function and of the noise
};

/// Limiting depths, m, at each speed of a cut: with the modes that were measured at a posture, and with those that the
/// postures of the other folds predict, between whose `low` and `high` 95 % lie.
struct HeldOutDepths {
  std::size_t posture = 0;
  Eigen::VectorXd measured, predicted, low, high;
};

/// The predictions of all postures that were held out.
struct HeldOut {
  std::vector<HeldOutMode> modes;     ///< by posture; without those that too few of the others have seen
  std::vector<HeldOutDepths> depths;  ///< one a posture, of a cut
};

/// Folds for n postures: the i-th is in fold i mod k. A list in the order of a design that fills the workspace, or by
/// rows of a grid, so puts neighbours into different folds.
[[nodiscard]] std::vector<int> folds_in_turn(std::size_t postures, int folds);

/// Learns from all folds but one, for each, and predicts the postures of that one (k-fold cross-validation, Stone
/// 1974). `fold` has a number for each posture. With a cut, limiting depths are predicted with their bands from `draws`
/// draws (depth_band_from_draws()). Throws InputError if there are not as many numbers as postures or fewer than two
/// different ones, and as Predictor. Cost: a Predictor a fold, and draws × postures × speeds limiting depths.
[[nodiscard]] HeldOut held_out(const std::vector<TappedPosture>& postures, const PredictorOptions& options,
                               const std::vector<int>& fold, const std::optional<PostureCut>& cut = std::nullopt,
                               int draws = 60);

/// Share of the entries of all modes whose number `t` lies within 1.96 deviations; NaN of no mode.
[[nodiscard]] double covered(const std::vector<HeldOutMode>& modes, Eigen::Index t);

/// Share of the depths within their bands; NaN of no depth.
[[nodiscard]] double covered(const std::vector<HeldOutDepths>& depths);

}  // namespace thinwall::posture
