#pragma once
// The calibration by observed cuts of the structure and the coefficients.

#include <vector>

#include "learning/chain_diagnostics.hpp"
#include "learning/cut_likelihood.hpp"
#include "learning/surrogate_chains.hpp"
#include "milling/observed/score.hpp"

namespace thinwall::learning {

/// The likeliest x, and the normal distribution about it.
struct Likeliest {
  Eigen::VectorXd x;
  Eigen::MatrixXd covariance;  ///< inverse of PosteriorSlope::curvature
  double log_posterior = 0.0;
  PredictedCuts predicted;  ///< there, with slopes
  int steps = 0;
  bool converged = false;  ///< the last step would gain less than 1e-4 of ln p
};

/// A maximum of log_posterior() from a start, by steps of Gauss-Newton that are damped until they gain (Levenberg 1944,
/// Marquardt 1963). Throws InputError if there are no cuts or no uncertain parameters. Cost: a prediction with slopes a
/// step, some ten of them.
[[nodiscard]] Likeliest likeliest_from(const CutModel& model, const Eigen::VectorXd& start);

/// The maxima that likeliest_from() finds from x = 0 and from the likeliest two of 48 draws of what is known
/// beforehand, falling, and more than one deviation apart: lobes that shift past one another make several. Throws as
/// it. Cost: some four times that of one.
[[nodiscard]] std::vector<Likeliest> maxima(const CutModel& model);

/// The highest of maxima().
[[nodiscard]] Likeliest likeliest(const CutModel& model);

/// One parameter, beforehand and after: mean and standard deviation of z and the value at the mean.
struct LearnedParameter {
  milling::UncertainParameter parameter;
  double before = 0.0, after = 0.0;                    ///< the value, units of milling::value_of()
  double mean = 0.0;                                   ///< of z: by how many of its own standard deviations it moved
  double deviation = 0.0;                              ///< of z, 1 beforehand: how much narrower it became
  double laplace_mean = 0.0, laplace_deviation = 0.0;  ///< the same by Likeliest
  double r_hat = 0.0, effective_size = 0.0;
};

/// One cut after the calibration.
struct LearnedCut {
  milling::ObservedCut cut;
  double chatter_probability = 0.0;  ///< mean over the draws
  bool contradicts = false;          ///< what was seen had a probability of less than a twentieth
};

/// The posterior.
struct Calibration {
  CutModel model;
  Likeliest likeliest;
  Chains chains;
  std::vector<LearnedParameter> parameters;
  double noise = 0.0;  ///< κ, median of the draws
  double worst_r_hat = 0.0, least_effective_size = 0.0;
  std::vector<LearnedCut> cuts;
  std::vector<Eigen::VectorXd> draws;  ///< x, of all chains
};

/// The posterior by chains about all maxima(), whose cheap density has interpolated predictions
/// (interpolated_cuts.hpp): first through places about the maxima, then also through those where short chains have
/// been. Throws InputError if there are no cuts or no uncertain parameters, and as predict(). Cost: maxima(), three
/// predictions for each maximum and coefficient of a quadratic, and some two a draw.
[[nodiscard]] Calibration calibrate(CutModel model, const ChainOptions& options);

/// At most `count` cuts with the parameters of draws, evenly among all.
[[nodiscard]] std::vector<milling::Cut> cuts_of_draws(const Calibration& calibration, std::size_t count);

/// Counts the cuts of a model; one chatters by the prediction if its margin is positive. Cost O(cuts).
void count(milling::Score& score, const CutModel& model, const PredictedCuts& predicted);

/// The number of cuts that are stable or chatter and are predicted rightly by likeliest() of the others: cut i is left
/// out in round i mod folds. A cut chatters if its margin there is positive. Cost: folds times that of likeliest().
[[nodiscard]] milling::Score cross_validated(const CutModel& model, int folds);

}  // namespace thinwall::learning
