#pragma once
// A Gaussian process that does not take its hyper-parameters as known: it averages over those that the data allow.

#include <Eigen/Core>
#include <vector>

#include "regression/dense_process.hpp"

namespace thinwall::regression {

/// Belief about hyper-parameters before data, of inputs and targets of the order of 1: each logarithm is normal.
struct HyperPrior {
  double ln_length = 0.7, sd_ln_length = 0.8;  ///< mean and deviation of ln ℓ of each dimension
  double ln_signal = 0.3, sd_ln_signal = 0.7;  ///< of the function's deviation
  double ln_noise = -3.5, sd_ln_noise = 1.2;   ///< of the noise's deviation
};

/// The draws from the posterior of the hyper-parameters.
struct AveragingOptions {
  Kernel kernel = Kernel::squared_exponential;
  HyperPrior prior{};
  int samples = 80;   ///< ≥ 1; of n places at most 1500/n or twelve, for many places leave little to average over
  unsigned seed = 1;  ///< the same seed gives the same answer
};

/// Mean and variance of the function, without noise, at m places.
struct AveragedPrediction {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;  ///< m × m
  double noise_variance = 0.0;
};

/// A process of one task whose answers are means over hyper-parameters θ drawn from their posterior, p(θ | y) ∝ p(y |
/// θ) p(θ) (Rasmussen & Williams 2006, ch. 5.2; Neal 1997): with the mean m and covariance C of each draw,
///
///     mean = ⟨m⟩,   covariance = ⟨C⟩ + ⟨m mᵀ⟩ − ⟨m⟩⟨m⟩ᵀ.
///
/// With few places the most likely hyper-parameters alone give intervals that cover too little. Draws are by slice
/// sampling along one parameter after the other (Neal 2003), which needs neither gradients nor a step size.
class AveragedProcess {
 public:
  /// Learns from targets (n × 1; NaN: not measured), which are standardised first. Throws InputError for more than one
  /// task, fewer than two values or an input that is not finite; NumericalError if no covariance can be factorised.
  /// Cost: some hundred likelihoods and ten more for each sample and hyper-parameter, O(n³) each.
  explicit AveragedProcess(const TaskData& data, const AveragingOptions& options = {});

  /// The function at the rows of `inputs`, in the targets' units. Cost O(samples n² m).
  [[nodiscard]] AveragedPrediction predict(const Eigen::MatrixXd& inputs) const;
  /// The error of each value as the others predict it, over its standard deviation with noise: of leave_one_out()
  /// averaged over the draws as above. Their root mean square is 1 where the process knows how far it may be off. Cost
  /// O(samples n³).
  [[nodiscard]] Eigen::VectorXd standardised_residuals() const;
  /// The draws, for standardised targets.
  [[nodiscard]] const std::vector<DenseProcess>& draws() const { return draws_; }

 private:
  std::vector<DenseProcess> draws_;
  double mean_ = 0.0, deviation_ = 1.0;
};

}  // namespace thinwall::regression
