#pragma once
// Errors of predictions over the number of postures that are tapped.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "posture/bands.hpp"
#include "posture/predictor.hpp"

namespace thinwall::posture {

/// Medians of the errors at postures that were not learned from, by what some others tell.
struct LearningPoint {
  int postures = 0;                     ///< learned from
  double frequency_error = 0.0;         ///< |Δ ln f| of all modes
  std::optional<double> depth_error{};  ///< relative, at all speeds of a cut
};

/// Learning curves: plain, and with an arm that is calibrated anew on the postures of each point.
struct LearningCurves {
  int tested = 0;  ///< postures that are never learned from
  std::vector<LearningPoint> plain;
  std::vector<LearningPoint> with_arm;  ///< empty without an arm
};

/// Numbers of places, a row each, in the order of a design that fills the workspace: the one nearest to the middle of
/// all, then each time the one that is farthest from those before (Kennard & Stone 1969). Cost O(places²).
[[nodiscard]] std::vector<std::size_t> spread_order(const Eigen::MatrixXd& places);

/// Every fourth posture is tested; from the first 7, 14, 28 … of the others, as spread_order() has them, and from all
/// of these, is learned. `nominal`: the arm that is the mean, calibrated (calibrate()) on the same postures;
/// options.mean is not used. Fewer than nine postures have no curve. Errors as Predictor, calibrate() and
/// limiting_depths(). Cost: a Predictor a point and curve, and with an arm a calibration.
[[nodiscard]] LearningCurves learning_curves(const std::vector<TappedPosture>& postures, PredictorOptions options,
                                             const std::optional<TappedArm>& nominal,
                                             const std::optional<PostureCut>& cut = std::nullopt);

}  // namespace thinwall::posture
