#include "linalg/eigenpair_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "linalg/sparse_indefinite.hpp"

namespace thinwall::linalg {

namespace {

/// The tolerance of a difference at an eigenvalue.
class Tolerance {
 public:
  Tolerance(const SparseMatrix& K, const SparseMatrix& M, double sigma)
      : sigma_(sigma),
        noise_(10.0 * std::numeric_limits<double>::epsilon() * K.diagonal().sum() / M.diagonal().sum()) {}

  [[nodiscard]] double at(double lambda) const { return std::max(1e-8, noise_ / std::abs(lambda - sigma_)); }
  [[nodiscard]] double difference(double lambda, double other) const {
    return std::abs(lambda - other) / std::abs(other - sigma_);
  }

 private:
  double sigma_;
  double noise_;
};

struct Count {
  double shift;
  int below;
  int eigenvalues;
};

/// The count at a shift so far from λ, towards the side of `sign`, in parts of λ − σ; empty if no factor could be used.
std::optional<Count> count_beside(const SparseMatrix& K, const SparseMatrix& M, const Eigen::VectorXd& lambda,
                                  double at, double scale, double sign, const std::vector<int>& node_of_row) {
  // If a shift falls on an eigenvalue, the factorisation has a vanishing pivot, and the next shift is tried.
  for (const double away : {1.0, 10.0, 100.0}) {
    const double shift = at + sign * away * scale;
    const std::optional<int> counted = count_eigenvalues_below(K, M, shift, node_of_row);
    if (counted) return Count{shift, static_cast<int>((lambda.array() < shift).count()), *counted};
  }
  return std::nullopt;
}

/// The count above the last pair, or below all that share its eigenvalue if more of those there are than were wanted.
std::optional<Count> sturm_count(const SparseMatrix& K, const SparseMatrix& M, double sigma,
                                 const Eigen::VectorXd& lambda, double tolerance, const std::vector<int>& node_of_row) {
  const double last = lambda(lambda.size() - 1);
  const double scale = std::max(1e-6, 10.0 * tolerance) * std::abs(last - sigma);
  std::optional<Count> count = count_beside(K, M, lambda, last, scale, 1.0, node_of_row);
  if (!count || count->eigenvalues <= count->below) return count;
  const std::optional<Count> lower = count_beside(K, M, lambda, last, scale, -1.0, node_of_row);
  return lower && lower->eigenvalues == lower->below ? lower : count;
}

/// The place of the entry nearest to a value.
Eigen::Index nearest(const Eigen::VectorXd& all, double value) {
  Eigen::Index at = 0;
  (all.array() - value).abs().minCoeff(&at);
  return at;
}

/// Looks for a partner of each eigenvalue in the other list, and notes the difference that exceeds its tolerance most.
void compare(const Eigen::VectorXd& lambda, const Eigen::VectorXd& second, const Tolerance& tolerance,
             EigenpairCheck& check) {
  double worst = -1.0;
  const auto note = [&](Eigen::Index pair, double other, bool second_alone) {
    const double difference = tolerance.difference(lambda(pair), other);
    const double allowed = tolerance.at(other);
    if (difference / allowed <= worst) return;
    worst = difference / allowed;
    check.pair = static_cast<int>(pair);
    check.lambda = lambda(pair);
    check.other_lambda = other;
    check.second_alone = second_alone;
    check.largest_difference = difference;
    check.tolerance = allowed;
  };
  for (Eigen::Index k = 0; k < lambda.size(); ++k) note(k, second(nearest(second, lambda(k))), false);
  const double last = lambda(lambda.size() - 1);
  for (const double other : second) {
    if (other > last && tolerance.difference(last, other) > tolerance.at(other)) continue;
    note(nearest(lambda, other), other, true);
  }
  if (worst > 1.0) check.status = EigenCheckStatus::values_differ;
}

}  // namespace

EigenpairCheck check_eigenpairs(const SparseMatrix& K, const SparseMatrix& M, const ShiftedInverse& inverse,
                                const Eigenpairs& pairs, const std::vector<int>& node_of_row) {
  EigenpairCheck check;
  // A NaN would compare as no difference.
  if (!pairs.lambda.allFinite()) {
    check.status = EigenCheckStatus::not_finite;
    return check;
  }
  const Tolerance tolerance(K, M, inverse.sigma);
  const Eigenpairs second = single_vector_eigenpairs(K, M, inverse, static_cast<int>(pairs.lambda.size()));
  if (second.status != EigenStatus::converged || !second.lambda.allFinite()) {
    check.status = EigenCheckStatus::not_converged;
    return check;
  }
  compare(pairs.lambda, second.lambda, tolerance, check);
  const double last = pairs.lambda(pairs.lambda.size() - 1);
  const std::optional<Count> count = sturm_count(K, M, inverse.sigma, pairs.lambda, tolerance.at(last), node_of_row);
  if (count) {
    check.shift = count->shift;
    check.below = count->below;
    check.counted = count->eigenvalues;
    if (check.counted != check.below) check.status = EigenCheckStatus::count_differs;
  } else if (check.status == EigenCheckStatus::agrees) {
    check.status = EigenCheckStatus::ill_conditioned;
  }
  return check;
}

}  // namespace thinwall::linalg
