#include "learning/interpolated_cuts.hpp"

#include <algorithm>
#include <cmath>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"

namespace thinwall::learning {

namespace {

using Eigen::Index;

/// 1, y_i, y_i y_k for i ≤ k.
Eigen::VectorXd terms_of(const Eigen::VectorXd& y) {
  const Index n = y.size();
  Eigen::VectorXd terms(quadratic_terms(n));
  Index at = 0;
  terms(at++) = 1.0;
  for (Index i = 0; i < n; ++i) terms(at++) = y(i);
  for (Index i = 0; i < n; ++i)
    for (Index k = i; k < n; ++k) terms(at++) = y(i) * y(k);
  return terms;
}

/// |y − y_j|³ of every column y_j.
Eigen::VectorXd cubes(const Eigen::MatrixXd& places, const Eigen::VectorXd& y) {
  const Eigen::ArrayXd squares = (places.colwise() - y).colwise().squaredNorm().transpose();
  return squares * squares.sqrt();
}

}  // namespace

Index quadratic_terms(Index unknowns) {
  return (unknowns + 1) * (unknowns + 2) / 2;
}

InterpolatedCuts::InterpolatedCuts(const CutModel& model, const std::vector<Eigen::VectorXd>& places)
    : cuts_(std::ssize(model.cuts)) {
  for (std::size_t i = 0; i < model.cuts.size(); ++i)
    if (model.cuts[i].chatter_frequency_hz) heard_.push_back(static_cast<Index>(i));
  add(model, places);
}

void InterpolatedCuts::add(const CutModel& model, const std::vector<Eigen::VectorXd>& places) {
  std::vector<Eigen::VectorXd> fresh;
  for (const Eigen::VectorXd& place : places)
    if (std::ranges::find(places_, place) == places_.end() && std::ranges::find(fresh, place) == fresh.end())
      fresh.push_back(place);
  std::vector<Eigen::RowVectorXd> values(fresh.size(), Eigen::RowVectorXd(cuts_ + std::ssize(heard_)));
  core::parallel_for(fresh.size(), [&](std::size_t i) {
    const PredictedCuts at = predict(model, fresh[i], false);
    values[i] << at.margin.transpose(), at.frequency_hz(heard_).transpose();
  });
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    if (!values[i].allFinite()) continue;
    places_.push_back(std::move(fresh[i]));
    values_.push_back(std::move(values[i]));
  }
  interpolate();
}

void InterpolatedCuts::interpolate() {
  const Index count = std::ssize(places_), n = count > 0 ? places_.front().size() : 0, terms = quadratic_terms(n);
  if (count < terms) {
    throw core::InputError("interpolated cuts: " + std::to_string(count) + " differing places, must be at least " +
                           std::to_string(terms) + "; give more");
  }
  Eigen::MatrixXd z(n, count);
  for (Index i = 0; i < count; ++i) z.col(i) = places_[static_cast<std::size_t>(i)];
  mean_ = z.rowwise().mean();
  z.colwise() -= mean_;
  const Eigen::LLT<Eigen::MatrixXd> factors(Eigen::MatrixXd(z * z.transpose() / static_cast<double>(count)));
  if (factors.info() != Eigen::Success) throw core::InputError("interpolated cuts: the places lie in a plane");
  L_ = factors.matrixL();
  y_ = L_.triangularView<Eigen::Lower>().solve(z);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(count + terms, count + terms);
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(count + terms, values_.front().size());
  for (Index i = 0; i < count; ++i) {
    A.col(i).head(count) = cubes(y_, y_.col(i));
    A.col(i).tail(terms) = terms_of(y_.col(i));
    A.row(i).tail(terms) = A.col(i).tail(terms).transpose();
    b.row(i) = values_[static_cast<std::size_t>(i)];
  }
  coefficients_ = Eigen::PartialPivLU<Eigen::MatrixXd>(A).solve(b);
  if (!coefficients_.allFinite())
    throw core::NumericalError("interpolated cuts: the equations of " + std::to_string(count) +
                               " places are singular; take fewer uncertain parameters");
}

PredictedCuts InterpolatedCuts::operator()(const Eigen::VectorXd& z) const {
  const Eigen::VectorXd y = L_.triangularView<Eigen::Lower>().solve(z - mean_);
  Eigen::VectorXd basis(coefficients_.rows());
  basis << cubes(y_, y), terms_of(y);
  const Eigen::VectorXd values = coefficients_.transpose() * basis;
  PredictedCuts predicted{values.head(cuts_), Eigen::VectorXd::Zero(cuts_), {}, {}};
  predicted.frequency_hz(heard_) = values.tail(std::ssize(heard_));
  return predicted;
}

}  // namespace thinwall::learning
