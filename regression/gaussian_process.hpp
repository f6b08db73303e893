#pragma once
// A Gaussian process with hyper-parameters of largest likelihood.

#include <Eigen/Core>
#include <optional>
#include <variant>
#include <vector>

#include "regression/dense_process.hpp"
#include "regression/kronecker_process.hpp"

namespace thinwall::regression {

/// Least and largest values between which hyper-parameters are looked for, for targets of mean 0 and deviation 1.
struct Bounds {
  double least_length = 0.05, largest_length = 50.0;  ///< scaled inputs
  double least_sd = 1e-3, largest_sd = 30.0;          ///< diagonal of L; what stands beside it is at most as large
  double least_noise = 1e-3, largest_noise = 3.0;
};

/// The search for the largest likelihood.
struct SearchOptions {
  Kernel kernel = Kernel::squared_exponential;
  Bounds bounds{};
  int starts = 12;    ///< ≥ 1; the first is that of the targets, each other the likeliest of eight draws
  unsigned seed = 1;  ///< of what is drawn: the same seed gives the same answer
  std::optional<HyperParameters>
      first{};  ///< the first start, as of data that hardly differ; none: that of the targets
};

/// The outcome of the search.
struct Fit {
  HyperParameters parameters;
  double log_likelihood = 0.0;
  std::vector<double> of_starts;  ///< the likelihoods at which all starts ended, largest first
};

/// The number of starts that a search makes: `options.starts`, and at most four of more than a hundred parameters, as
/// thirteen tasks over three dimensions have (107), of which a search takes a thousand likelihoods.
[[nodiscard]] int search_starts(const SearchOptions& options, Eigen::Index dimensions, Eigen::Index tasks);

/// Type-II maximum likelihood (Rasmussen & Williams 2006, ch. 5.4) by L-BFGS within bounds, and after it, from the best
/// end and from those that are worse than it, SLSQP, or L-BFGS again of more than 60 parameters (NLopt; Nocedal 1980,
/// Kraft 1994).
/// Starts are shared out among core::thread_count() threads. Likelihoods have several maxima: `of_starts` tells how
/// many starts reached the best. `data` have targets of the order of 1: see standardised().
/// Throws InputError for fewer observations of a task than two, or a number among inputs that is not finite;
/// NumericalError if no start has a likelihood. Cost: some hundred likelihoods a start.
[[nodiscard]] Fit fit(const TaskData& data, const SearchOptions& options = {});

/// Targets of mean 0 and deviation 1, and the way back.
struct Standardised {
  TaskData data;
  Eigen::VectorXd mean;       ///< of each task
  Eigen::VectorXd deviation;  ///< of its population; 1 of a task that does not vary
};
/// The targets of each task less their mean and over their deviation; missing ones stay NaN. Cost O(n tasks).
[[nodiscard]] Standardised standardised(const TaskData& data);

/// A process that has learned, in the units of its targets.
class GaussianProcess {
 public:
  /// Fits the standardised data.
  explicit GaussianProcess(const TaskData& data, const SearchOptions& options = {});
  /// With hyper-parameters that are known, those of the standardised data. Throws NumericalError if the covariance is
  /// not positive definite.
  GaussianProcess(const TaskData& data, const HyperParameters& parameters, Kernel kernel);

  /// The function at the rows of `inputs`, as in Prediction.
  [[nodiscard]] Prediction predict(const Eigen::MatrixXd& inputs) const;
  /// Each observation from all others.
  [[nodiscard]] LeaveOneOut leave_one_out() const;
  /// Deviation of the noise of each task.
  [[nodiscard]] Eigen::VectorXd noise_sd() const;
  /// The outcome of the search; of given hyper-parameters, their likelihood.
  [[nodiscard]] const Fit& found() const { return fit_; }

 private:
  void learn(Kernel kernel);

  Standardised scaled_;
  Fit fit_;
  std::variant<DenseProcess, KroneckerProcess> process_;
};

}  // namespace thinwall::regression
