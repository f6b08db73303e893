#include "milling/uniform_step_map.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>
#include <unsupported/Eigen/MatrixFunctions>
#include <utility>

#include "core/error.hpp"
#include "milling/product_rule.hpp"

namespace thinwall::milling {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Where the values of a polynomial of this order stand, in steps from the start of the step.
VectorXd places(int order) {
  if (order == 0) return VectorXd::Zero(1);
  return VectorXd::LinSpaced(order + 1, 1.0, 1.0 - order);
}

/// Rotation since the last tooth entry when the tooth that began the period at φ = 0 stands at φ.
double since_entry(const MillingProcess& process, double phi) {
  const double pitch = process.cutter.pitch_rad();
  const double theta = std::fmod(phi - process.engagement.entry_rad, pitch);
  return theta < 0.0 ? theta + pitch : theta;
}

/// ∫ Σ D over from < θ < to of one period, 0 ≤ from < to ≤ pitch.
DirectionalMatrix integral(const MillingProcess& process, double from, double to) {
  DirectionalMatrix sum = DirectionalMatrix::Zero();
  for (const CutSegment& s : cut_segments(process.engagement, process.cutter)) {
    const double begin = std::max(from, s.from_rad);
    const double end = std::min(to, s.to_rad);
    if (end <= begin) continue;
    sum += (end - begin) *
           mean_directional_matrix(process.coefficients, process.cutter, process.engagement, s.teeth, begin, end);
  }
  return sum;
}

DirectionalMatrix mean_over(const MillingProcess& process, double phi, double length) {
  const double pitch = process.cutter.pitch_rad();
  const double from = since_entry(process, phi);
  const double to = from + length;
  if (to <= pitch) return integral(process, from, to) / length;
  return (integral(process, from, pitch) + integral(process, 0.0, to - pitch)) / length;
}

DirectionalMatrix value_at(const MillingProcess& process, double phi) {
  const Eigen::Matrix3d A = directional_matrix(process.coefficients, process.cutter, process.engagement, ToolFrame{},
                                               since_entry(process, phi));
  return A.leftCols<2>();
}

}  // namespace

StepRule semi_discretization(int order) {
  return {false, 0, order};
}

StepRule full_discretization(int order) {
  return {true, order, 1};
}

StepCoefficients step_coefficients(const MillingProcess& process, const Eigen::Matrix2Xd& in_plane, int steps,
                                   StepRule rule) {
  if (!elementary(process)) {
    throw core::InputError(
        "semi- and full-discretization: equal teeth without helix on a cylinder, one arc, no process damping; take the "
        "direct method for this cut");
  }
  const double step = process.cutter.pitch_rad() / steps;
  StepCoefficients c;
  for (int i = 0; i < steps + (rule.full ? 1 : 0); ++i)
    c.present.emplace_back((rule.full ? value_at(process, i * step) : mean_over(process, i * step, step)) * in_plane);
  c.delayed = c.present;
  return c;
}

UniformStepMap::UniformStepMap(ContactState state, StepCoefficients coefficients, double period_s, StepRule rule)
    : state_(std::move(state)), coefficients_(std::move(coefficients)), rule_(rule) {
  steps_ = static_cast<int>(coefficients_.present.size()) - (rule.full ? 1 : 0);
  if (steps_ < 3) {
    throw core::InputError("semi- and full-discretization: " + std::to_string(steps_) +
                           " steps a tooth period, must be at least 3; 40 is usual");
  }
  history_ = steps_ + std::max(0, rule.delayed_order - 1);
  step_s_ = period_s / steps_;
  free_ = MatrixXd::Identity(state_.size(), state_.size());
  advance(free_flight(state_, step_s_), free_);
  // The integrands are entire: Gauss's sums converge to round-off.
  const double phase = std::min(200.0, fastest_pole(state_) * step_s_);
  const GaussRule gauss = gauss_legendre(10 + static_cast<int>(std::ceil(phase)));
  point_ = gauss.node;
  for (Index q = 0; q < point_.size(); ++q) {
    push_.emplace_back(state_.B * (gauss.weight(q) * step_s_));
    advance(free_flight(state_, (1.0 - point_(q)) * step_s_), push_.back());
  }
}

void UniformStepMap::set_depth(double depth_m) {
  step_.clear();
  for (std::size_t i = 0; i < static_cast<std::size_t>(steps_); ++i)
    step_.push_back(rule_.full ? full_step(i, depth_m) : semi_step(i, depth_m));
}

UniformStepMap::Step UniformStepMap::semi_step(std::size_t i, double depth_m) const {
  // Over the step, d' = d_1, d_1' = d_2 … for the derivatives of the delayed polynomial, by the step's length: one
  // exponential gives what the state and each derivative do (Van Loan 1978).
  const Index n = state_.size();
  const Index p = state_.directions();
  const Index terms = rule_.delayed_order + 1;
  MatrixXd Z = MatrixXd::Zero(n + p * terms, n + p * terms);
  Z.topLeftCorner(n, n) = step_s_ * (state_matrix(state_) - depth_m * state_.B * coefficients_.present[i] * state_.C);
  Z.block(0, n, n, p) = step_s_ * depth_m * state_.B * coefficients_.delayed[i];
  for (Index j = 0; j + 1 < terms; ++j) Z.block(n + p * j, n + p * (j + 1), p, p).setIdentity();
  const MatrixXd E = Z.exp();
  // d = Σ_j c_j σ^j through the values at the places, so that derivative j at the start is j! c_j.
  const VectorXd place = places(rule_.delayed_order);
  MatrixXd powers(terms, terms);
  for (Index j = 0; j < terms; ++j) powers.col(j) = place.array().pow(static_cast<double>(j));
  const MatrixXd c = powers.inverse();
  Step step{E.topLeftCorner(n, n), {}, {}};
  for (Index b = 0; b < terms; ++b) {
    MatrixXd past = MatrixXd::Zero(n, p);
    for (Index j = 0; j < terms; ++j) past += std::tgamma(j + 1.0) * c(j, b) * E.block(0, n + p * j, n, p);
    step.past.push_back(std::move(past));
  }
  return step;
}

UniformStepMap::Step UniformStepMap::full_step(std::size_t i, double depth_m) const {
  const VectorXd state_place = places(rule_.state_order);
  const VectorXd delayed_place = places(rule_.delayed_order);
  const MatrixXd zero = MatrixXd::Zero(state_.size(), state_.directions());
  std::vector<MatrixXd> now(static_cast<std::size_t>(state_place.size()), zero);
  std::vector<MatrixXd> past(static_cast<std::size_t>(delayed_place.size()), zero);
  for (std::size_t q = 0; q < push_.size(); ++q) {
    const double at = point_(static_cast<Index>(q));
    const MatrixXd P = (1.0 - at) * coefficients_.present[i] + at * coefficients_.present[i + 1];
    const MatrixXd Q = (1.0 - at) * coefficients_.delayed[i] + at * coefficients_.delayed[i + 1];
    const VectorXd l = lagrange_polynomials(state_place, at);
    const VectorXd l_past = lagrange_polynomials(delayed_place, at);
    for (std::size_t a = 0; a < now.size(); ++a) now[a] -= depth_m * l(static_cast<Index>(a)) * (push_[q] * P);
    for (std::size_t b = 0; b < past.size(); ++b) past[b] += depth_m * l_past(static_cast<Index>(b)) * (push_[q] * Q);
  }
  // x_{i+1} stands on both sides, through y_{i+1} = C x_{i+1}: of rank p, solved for once.
  const MatrixXd implicit =
      now[0] * (MatrixXd::Identity(zero.cols(), zero.cols()) - state_.C * now[0]).partialPivLu().inverse();
  const auto solved = [&](const MatrixXd& X) -> MatrixXd { return X + implicit * (state_.C * X); };
  Step step{solved(now.size() > 1 ? MatrixXd(free_ + now[1] * state_.C) : free_), {}, {}};
  for (std::size_t a = 2; a < now.size(); ++a) step.earlier.push_back(solved(now[a]));
  for (const MatrixXd& b : past) step.past.push_back(solved(b));
  return step;
}

void UniformStepMap::apply(const Eigen::Ref<const VectorXd>& in, Eigen::Ref<VectorXd> out) const {
  const Index n = state_.size();
  const Index p = state_.directions();
  const Index first_place = rule_.delayed_order == 0 ? 0 : 1;
  VectorXd x = in.head(n);
  MatrixXd y(p, history_ + steps_ + 1);  // column history_ + i holds y_i
  y.leftCols(history_) = Eigen::Map<const MatrixXd>(in.data() + n, p, history_);
  y.col(history_) = state_.C * x;
  for (Index i = 0; i < steps_; ++i) {
    const Step& step = step_[static_cast<std::size_t>(i)];
    const Index now = history_ + i;
    VectorXd next = step.flow * x;
    for (std::size_t a = 0; a < step.earlier.size(); ++a)
      next.noalias() += step.earlier[a] * y.col(now - 1 - static_cast<Index>(a));
    for (std::size_t b = 0; b < step.past.size(); ++b)
      next.noalias() += step.past[b] * y.col(now - steps_ + first_place - static_cast<Index>(b));
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

Eigen::Vector3cd UniformStepMap::force_harmonic(const Eigen::VectorXcd& v, double omega_rad_s) const {
  const Index p = state_.directions();
  Eigen::Vector3cd sum = Eigen::Vector3cd::Zero();
  for (Index i = 0; i < steps_; ++i) {
    const auto y = v.segment(v.size() - p * (steps_ - i), p);
    const double t = static_cast<double>(i) * step_s_;
    sum += std::polar(1.0, -omega_rad_s * t) * (coefficients_.present[static_cast<std::size_t>(i)] * y);
  }
  return sum;
}

}  // namespace thinwall::milling
