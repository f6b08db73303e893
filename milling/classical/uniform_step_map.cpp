#include "milling/classical/uniform_step_map.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <unsupported/Eigen/MatrixFunctions>
#include <utility>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "core/gauss_rule.hpp"
#include "milling/cut/product_rule.hpp"

namespace thinwall::milling {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The places of the values of a polynomial of this order, in steps from the start of the step.
VectorXd places(int order) {
  if (order == 0) return VectorXd::Zero(1);
  return VectorXd::LinSpaced(order + 1, 1.0, 1.0 - order);
}

/// ∫ e^{Λ (t_{i+1} − t)} B ℓ(t) (1 − σ, σ) dt of each ℓ. The integrands are entire: Gauss's sums converge to round-off.
std::vector<std::array<MatrixXd, 2>> pushes(const ContactState& state, double step_s, const VectorXd& place) {
  const double phase = std::min(200.0, fastest_pole(state) * step_s);
  const core::GaussRule gauss = core::gauss_legendre(10 + static_cast<int>(std::ceil(phase)));
  const MatrixXd zero = MatrixXd::Zero(state.size(), 3);
  std::vector<std::array<MatrixXd, 2>> sums(static_cast<std::size_t>(place.size()), {zero, zero});
  for (Index q = 0; q < gauss.node.size(); ++q) {
    const double at = gauss.node(q);
    MatrixXd push = state.B * (gauss.weight(q) * step_s);
    advance(free_flight(state, (1.0 - at) * step_s), push);
    const VectorXd l = lagrange_polynomials(place, at);
    for (std::size_t a = 0; a < sums.size(); ++a) {
      sums[a][0] += l(static_cast<Index>(a)) * (1.0 - at) * push;
      sums[a][1] += l(static_cast<Index>(a)) * at * push;
    }
  }
  return sums;
}

void require_delays(const StepCoefficients& coefficients) {
  for (const DelayedTerm& term : coefficients.delayed) {
    if (term.delay > 3.0 - 1e-9) continue;
    std::ostringstream text;
    text << "semi- and full-discretization: a delay of " << term.delay
         << " steps, must be at least 3; take more steps a tooth period, 40 is usual";
    throw core::InputError(text.str());
  }
}

}  // namespace

UniformStepMap::UniformStepMap(ContactState state, int steps, double period_s, StepRule rule)
    : state_(std::move(state)), rule_(rule), steps_(steps), step_s_(period_s / steps) {
  free_ = MatrixXd::Identity(state_.size(), state_.size());
  advance(free_flight(state_, step_s_), free_);
  if (!rule.full) return;
  state_push_ = pushes(state_, step_s_, places(rule.state_order));
  delayed_push_ = pushes(state_, step_s_, places(rule.delayed_order));
}

std::vector<UniformStepMap::Share> UniformStepMap::displacement_at(double steps_from_start) {
  const double nearest = std::round(steps_from_start);
  if (std::abs(steps_from_start - nearest) < 1e-9) return {{static_cast<int>(nearest), 1.0}};
  const double below = std::floor(steps_from_start);
  const VectorXd weight = lagrange_polynomials(VectorXd::LinSpaced(4, -1.0, 2.0), steps_from_start - below);
  std::vector<Share> shares;
  shares.reserve(4);
  for (int k = 0; k < 4; ++k) shares.push_back({static_cast<int>(below) + k - 1, weight(k)});
  return shares;
}

UniformStepMap::Reach UniformStepMap::reach_of(double delay) const {
  Reach reach;
  reach.reserve(static_cast<std::size_t>(rule_.delayed_order) + 1);
  for (const double place : places(rule_.delayed_order)) reach.push_back(displacement_at(place - delay));
  return reach;
}

void UniformStepMap::add_felt(const MatrixXd& by, const std::vector<Share>& shares, Step& step) {
  for (const Share& share : shares) {
    const auto same =
        std::find_if(step.felt.begin(), step.felt.end(), [&](const Felt& f) { return f.offset == share.offset; });
    if (same == step.felt.end()) step.felt.push_back({share.offset, share.weight * by});
    else same->by += share.weight * by;
  }
}

void UniformStepMap::set_depth(double depth_m, const StepCoefficients& coefficients) {
  require_delays(coefficients);
  history_ = std::max(3, steps_);
  std::vector<Reach> reach;
  reach.reserve(coefficients.delayed.size());
  for (const DelayedTerm& term : coefficients.delayed) {
    reach.push_back(reach_of(term.delay));
    for (const auto& shares : reach.back()) {
      for (const Share& share : shares) history_ = std::max(history_, -share.offset);
    }
  }
  step_.clear();
  step_.reserve(static_cast<std::size_t>(steps_));
  coefficients_ = coefficients;
  for (std::size_t i = 0; i < static_cast<std::size_t>(steps_); ++i) {
    step_.push_back(rule_.full ? full_step(i, depth_m, coefficients, reach)
                               : semi_step(i, depth_m, coefficients, reach));
  }
}

UniformStepMap::Step UniformStepMap::semi_step(std::size_t i, double depth_m, const StepCoefficients& c,
                                               const std::vector<Reach>& reach) const {
  std::vector<std::size_t> acting;
  for (std::size_t d = 0; d < c.delayed.size(); ++d) {
    if (!c.delayed[d].coefficient[i].isZero(0.0)) acting.push_back(d);
  }
  if (acting.empty() && c.present[i].isZero(0.0)) return {free_, {}};
  // Over the step, d' = d_1, d_1' = d_2 … for the derivatives of a delayed polynomial, by the step's length: one
  // exponential gives what the state and each derivative do (Van Loan 1978). Several delays share that of a unit force.
  const bool one = acting.size() == 1;
  const MatrixXd input = one ? c.delayed[acting.front()].coefficient[i] : MatrixXd::Identity(3, 3);
  const Index n = state_.size();
  const Index p = input.cols();
  const Index terms = rule_.delayed_order + 1;
  MatrixXd Z = MatrixXd::Zero(n + p * terms, n + p * terms);
  Z.topLeftCorner(n, n) = step_s_ * (state_matrix(state_) - depth_m * state_.B * c.present[i] * state_.C);
  Z.block(0, n, n, p) = step_s_ * depth_m * state_.B * input;
  for (Index j = 0; j + 1 < terms; ++j) Z.block(n + p * j, n + p * (j + 1), p, p).setIdentity();
  const MatrixXd E = Z.exp();
  // d = Σ_j c_j σ^j through the values at the places, so that derivative j at the start is j! c_j.
  const VectorXd place = places(rule_.delayed_order);
  MatrixXd powers(terms, terms);
  for (Index j = 0; j < terms; ++j) powers.col(j) = place.array().pow(static_cast<double>(j));
  const MatrixXd monomial = powers.inverse();
  Step step{E.topLeftCorner(n, n), {}};
  for (Index b = 0; b < terms; ++b) {
    MatrixXd push = MatrixXd::Zero(n, p);
    for (Index j = 0; j < terms; ++j) push += std::tgamma(j + 1.0) * monomial(j, b) * E.block(0, n + p * j, n, p);
    for (const std::size_t d : acting)
      add_felt(one ? push : push * c.delayed[d].coefficient[i], reach[d][static_cast<std::size_t>(b)], step);
  }
  return step;
}

UniformStepMap::Step UniformStepMap::full_step(std::size_t i, double depth_m, const StepCoefficients& c,
                                               const std::vector<Reach>& reach) const {
  const auto pushed = [&](const Push& push, const std::vector<MatrixXd>& coefficient) -> MatrixXd {
    return depth_m * (push[0] * coefficient[2 * i] + push[1] * coefficient[2 * i + 1]);
  };
  // x_{i+1} stands on both sides, through y_{i+1} = C x_{i+1}: of rank p, solved for once.
  const MatrixXd now = -pushed(state_push_[0], c.present);
  const Index p = state_.directions();
  const MatrixXd implicit = now * (MatrixXd::Identity(p, p) - state_.C * now).partialPivLu().inverse();
  const auto solved = [&](const MatrixXd& X) -> MatrixXd { return X + implicit * (state_.C * X); };
  Step step{solved(free_ - pushed(state_push_[1], c.present) * state_.C), {}};
  for (std::size_t a = 2; a < state_push_.size(); ++a)
    add_felt(solved(-pushed(state_push_[a], c.present)), {{1 - static_cast<int>(a), 1.0}}, step);
  for (std::size_t d = 0; d < c.delayed.size(); ++d) {
    const auto& Q = c.delayed[d].coefficient;
    if (Q[2 * i].isZero(0.0) && Q[2 * i + 1].isZero(0.0)) continue;
    for (std::size_t b = 0; b < delayed_push_.size(); ++b)
      add_felt(solved(pushed(delayed_push_[b], Q)), reach[d][b], step);
  }
  return step;
}

void UniformStepMap::apply(const Eigen::Ref<const VectorXd>& in, Eigen::Ref<VectorXd> out) const {
  const Index n = state_.size();
  const Index p = state_.directions();
  VectorXd x = in.head(n);
  MatrixXd y(p, history_ + steps_ + 1);  // column history_ + i holds y_i
  y.leftCols(history_) = Eigen::Map<const MatrixXd>(in.data() + n, p, history_);
  y.col(history_) = state_.C * x;
  for (Index i = 0; i < steps_; ++i) {
    const Step& step = step_[static_cast<std::size_t>(i)];
    const Index now = history_ + i;
    VectorXd next = step.flow * x;
    for (const Felt& felt : step.felt) next.noalias() += felt.by * y.col(now + felt.offset);
    x = next;
    y.col(now + 1).noalias() = state_.C * x;
  }
  out.head(n) = x;
  Eigen::Map<MatrixXd>(out.data() + n, p, history_) = y.middleCols(steps_, history_);
}

DominantEigenvalue UniformStepMap::dominant() const {
  constexpr double tolerance = 1e-11;
  const LinearMap map = [this](const auto& in, auto out) { apply(in, out); };
  DominantEigenvalue result = dominant_eigenvalue(map, size(), tolerance);
  if (!result.converged) result = dominant_eigenvalue_dense(map, size(), 1e-9);
  if (result.converged) return result;
  throw core::NumericalError("stability: the dominant multiplier of " + std::to_string(steps_) +
                             " steps a period was not found; take more steps or a smaller depth");
}

Eigen::Matrix3Xcd UniformStepMap::force_over_period(const DominantEigenvalue& eigen) const {
  const Index p = state_.directions();
  const Index first = state_.size() + p * (history_ - steps_);  // of y_{−m}
  const auto at = [&](int i) -> Eigen::VectorXcd {
    const bool before = i < 0;
    const Eigen::VectorXcd y = eigen.vector.segment(first + p * (before ? i + steps_ : i), p);
    return before ? Eigen::VectorXcd(y / eigen.value) : y;
  };
  Eigen::Matrix3Xcd force(3, steps_);
  for (int i = 0; i < steps_; ++i) {
    const auto slot = static_cast<std::size_t>(rule_.full ? 2 * i : i);
    force.col(i) = coefficients_.present[slot] * at(i);
    for (const DelayedTerm& term : coefficients_.delayed) {
      if (term.coefficient[slot].isZero(0.0)) continue;
      for (const Share& share : displacement_at(-term.delay))
        force.col(i) -= share.weight * (term.coefficient[slot] * at(i + share.offset));
    }
  }
  return force;
}

}  // namespace thinwall::milling
