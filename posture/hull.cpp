#include "posture/hull.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"

namespace thinwall::posture {

namespace {

/// Least squares of A over the columns in use.
Eigen::VectorXd least_squares_of(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, const std::vector<int>& used) {
  return Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(Eigen::MatrixXd(A(Eigen::all, used))).solve(b);
}

/// The w ≥ 0 of least |A w − b|, by the active sets of Lawson and Hanson.
Eigen::VectorXd non_negative_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  Eigen::VectorXd w = Eigen::VectorXd::Zero(A.cols());
  std::vector<int> used;
  for (Eigen::Index round = 0; round < 3 * A.cols(); ++round) {
    Eigen::VectorXd slope = A.transpose() * (b - A * w);
    for (const int k : used) slope(k) = 0.0;
    Eigen::Index next = 0;
    if (slope.maxCoeff(&next) <= 1e-12) break;
    used.push_back(static_cast<int>(next));
    Eigen::VectorXd z = least_squares_of(A, b, used);
    while (!used.empty() && z.minCoeff() <= 0.0) {
      double share = 1.0;
      for (std::size_t k = 0; k < used.size(); ++k) {
        const double from = w(used[k]), to = z(static_cast<Eigen::Index>(k));
        if (to <= 0.0) share = std::min(share, from > to ? from / (from - to) : 0.0);
      }
      for (std::size_t k = 0; k < used.size(); ++k)
        w(used[k]) += share * (z(static_cast<Eigen::Index>(k)) - w(used[k]));
      std::erase_if(used, [&](int k) { return w(k) <= 1e-14; });
      for (Eigen::Index k = 0; k < w.size(); ++k) w(k) = w(k) <= 1e-14 ? 0.0 : w(k);
      z = used.empty() ? Eigen::VectorXd() : least_squares_of(A, b, used);
    }
    for (std::size_t k = 0; k < used.size(); ++k) w(used[k]) = z(static_cast<Eigen::Index>(k));
  }
  return w;
}

}  // namespace

double distance_from_hull(const Eigen::MatrixXd& places, const Eigen::VectorXd& place) {
  if (places.rows() == 0 || places.cols() != place.size())
    throw core::InputError("hull: " + std::to_string(places.rows()) + " places of " + std::to_string(places.cols()) +
                           " coordinates for one of " + std::to_string(place.size()) +
                           ", must be at least one place and as many coordinates");
  Eigen::MatrixXd A(places.cols() + 1, places.rows());
  A.topRows(places.cols()) = (places.rowwise() - place.transpose()).transpose();
  A.bottomRows(1).setOnes();
  const Eigen::VectorXd w = non_negative_least_squares(A, Eigen::VectorXd::Unit(A.rows(), places.cols()));
  const double distance = (A.topRows(places.cols()) * w).norm() / w.sum();
  return distance > 1e-9 ? distance : 0.0;
}

}  // namespace thinwall::posture
