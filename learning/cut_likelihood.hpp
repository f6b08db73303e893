#pragma once
// The probability of what was seen of cuts, as a smooth function of the uncertain parameters.

#include <Eigen/Core>
#include <vector>

#include "milling/observed/observed_cut.hpp"
#include "milling/observed/uncertain_cut.hpp"

namespace thinwall::learning {

/// The cuts, the cut that is known beforehand, and how uncertain it is. The unknown x has the parameters' z
/// (milling/observed/uncertain_cut.hpp) and, last, u of the noise κ = noise_median e^{noise_spread u}; beforehand all
/// of them are independent standard normal numbers.
struct CutModel {
  milling::Cut nominal;
  std::vector<milling::UncertainParameter> parameters;
  std::vector<milling::ObservedCut> cuts;
  milling::StabilityOptions options;
  double noise_median = 0.3;
  double noise_spread = 0.7;
  double frequency_deviation = 0.02;     ///< relative, of a chatter frequency that was heard
  double frequency_outlier_share = 0.1;  ///< of frequencies that another mode or harmonic gave
};

/// The prediction of a structure and process for the cuts: an entry a cut, and its derivative by each z, where that was
/// asked for.
struct PredictedCuts {
  Eigen::VectorXd margin;           ///< milling::MultiplierSlope, scaled by the poles of the nominal structure
  Eigen::VectorXd frequency_hz;     ///< of the multiplier that decides
  Eigen::MatrixXd margin_slope;     ///< cuts × parameters
  Eigen::MatrixXd frequency_slope;  ///< cuts × parameters, Hz
};

/// The prediction at z. The cuts share out among the threads; interruptible. Throws as milling::multiplier_at(). Cost:
/// a multiplier for each cut, and with slopes two loops of the cut for each parameter besides.
[[nodiscard]] PredictedCuts predict(const CutModel& model, const Eigen::VectorXd& z, bool with_slopes);

/// 1/(1 + e^{−m/κ}), the probability that a cut of margin m chatters.
[[nodiscard]] double chatter_probability(double margin, double noise);

/// κ of the last entry of x.
[[nodiscard]] double noise_of(const CutModel& model, const Eigen::VectorXd& x);

/// The ln of the posterior density at x up to a constant,
///
///     −|x|²/2 + Σ ln P(outcome | m, κ) + Σ ln((1 − ε) e^{−r²/2} + ε √(2π) s/2),     r = (f − heard)/(s heard)
///
/// with P = p of a cut that chattered, 1 − p of a stable one, p = chatter_probability(). Where one of the cuts is
/// called marginal that is a third answer, 4 p (1 − p), and all three are divided by their sum 1 + 4 p (1 − p): a
/// marginal cut tells that the boundary is near. A frequency that does not belong to the chatter lies anywhere up to
/// twice what was heard. Cost O(cuts).
[[nodiscard]] double log_posterior(const CutModel& model, const PredictedCuts& predicted, const Eigen::VectorXd& x);

/// Its gradient, and minus its Hessian without the second derivatives of the prediction (Gauss-Newton), which is
/// positive definite.
struct PosteriorSlope {
  Eigen::VectorXd gradient;
  Eigen::MatrixXd curvature;
};

/// Of log_posterior(); `predicted` has slopes. Cost O(cuts parameters²).
[[nodiscard]] PosteriorSlope posterior_slope(const CutModel& model, const PredictedCuts& predicted,
                                             const Eigen::VectorXd& x);

}  // namespace thinwall::learning
