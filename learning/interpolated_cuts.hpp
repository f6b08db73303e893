#pragma once
// The prediction of cuts as smooth functions of the parameters that pass through predictions that were made.

#include <Eigen/Core>
#include <vector>

#include "learning/cut_likelihood.hpp"

namespace thinwall::learning {

/// Margins of all cuts, and the frequencies of those whose chatter was heard, as functions of z,
///
///     s(z) = Σ_j c_j |y − y_j|³ + p(y),     y = L⁻¹ (z − z̄)
///
/// with the mean z̄ and covariance L Lᵀ of the places, p a full quadratic, and Σ_j c_j q(y_j) = 0 for every quadratic q
/// (cubic radial functions; Powell 1992). s passes through the prediction at every place, so that places can be added
/// wherever the posterior turns out to lie, also if that is in regions apart from one another.
class InterpolatedCuts {
 public:
  /// Predicts at all places, of which equal ones count once and those without a finite prediction not at all. Throws
  /// InputError unless the others determine a quadratic, NumericalError if the equations are singular, and as
  /// predict(). Cost: a prediction a place, and O(places³).
  InterpolatedCuts(const CutModel& model, const std::vector<Eigen::VectorXd>& places);

  /// Predicts at further places as well. Throws and costs as the constructor.
  void add(const CutModel& model, const std::vector<Eigen::VectorXd>& places);

  /// The prediction at z, without slopes; frequencies that were not heard are 0. Cost O(places cuts).
  [[nodiscard]] PredictedCuts operator()(const Eigen::VectorXd& z) const;

 private:
  void interpolate();

  std::vector<Eigen::VectorXd> places_;
  std::vector<Eigen::Index> heard_;  ///< numbers of the cuts whose frequency was heard
  Eigen::Index cuts_ = 0;
  std::vector<Eigen::RowVectorXd> values_;  ///< of each place: margins, heard frequencies
  Eigen::VectorXd mean_;
  Eigen::MatrixXd L_, y_;         ///< y_: a column a place
  Eigen::MatrixXd coefficients_;  ///< places and terms × values
};

/// The number of coefficients of a full quadratic of that many unknowns.
[[nodiscard]] Eigen::Index quadratic_terms(Eigen::Index unknowns);

}  // namespace thinwall::learning
