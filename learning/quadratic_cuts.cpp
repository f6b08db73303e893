#include "learning/quadratic_cuts.hpp"

#include <random>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"

namespace thinwall::learning {

namespace {

using Eigen::Index;

/// 1, y_i, y_i y_k for i ≤ k.
Eigen::RowVectorXd terms_of(const Eigen::VectorXd& y) {
  const Index n = y.size();
  Eigen::RowVectorXd terms((n + 1) * (n + 2) / 2);
  Index at = 0;
  terms(at++) = 1.0;
  for (Index i = 0; i < n; ++i) terms(at++) = y(i);
  for (Index i = 0; i < n; ++i)
    for (Index k = i; k < n; ++k) terms(at++) = y(i) * y(k);
  return terms;
}

}  // namespace

QuadraticCuts::QuadraticCuts(const CutModel& model, const Region& region) : region_(region) {
  constexpr double wider = 1.5, ridge = 1e-6;
  const Eigen::LLT<Eigen::MatrixXd> factors(region.covariance);
  if (factors.info() != Eigen::Success)
    throw core::InputError("quadratic cuts: the covariance is not positive definite");
  L_ = factors.matrixL();
  const Index unknowns = terms_of(region.mean).size(), places = 5 * unknowns, cuts = std::ssize(model.cuts);
  std::mt19937 random(1);
  std::vector<Eigen::VectorXd> y(static_cast<std::size_t>(places));
  for (Eigen::VectorXd& place : y) place = wider * milling::standard_normal(region.mean.size(), random);
  Eigen::MatrixXd A(places, unknowns), margins(places, cuts), frequencies(places, cuts);
  core::parallel_for(y.size(), [&](std::size_t i) {
    const PredictedCuts at = predict(model, region_.mean + L_ * y[i], false);
    const auto row = static_cast<Index>(i);
    A.row(row) = terms_of(y[i]);
    margins.row(row) = at.margin;
    frequencies.row(row) = at.frequency_hz;
  });
  Eigen::MatrixXd normal = A.transpose() * A;
  normal.diagonal() *= 1.0 + ridge;
  const Eigen::LLT<Eigen::MatrixXd> solver(normal);
  margins_ = solver.solve(Eigen::MatrixXd(A.transpose() * margins));
  frequencies_ = solver.solve(Eigen::MatrixXd(A.transpose() * frequencies));
}

PredictedCuts QuadraticCuts::operator()(const Eigen::VectorXd& z) const {
  const Eigen::RowVectorXd terms = terms_of(L_.triangularView<Eigen::Lower>().solve(z - region_.mean));
  return {(terms * margins_).transpose(), (terms * frequencies_).transpose(), {}, {}};
}

}  // namespace thinwall::learning
