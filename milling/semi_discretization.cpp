#include "milling/semi_discretization.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/error.hpp"

namespace thinwall::milling {

namespace {

int share_of(const CutSegment& segment, double cut_rad, StepCount steps) {
  const double share = (segment.to_rad - segment.from_rad) / cut_rad;
  return steps.division * std::max(1, static_cast<int>(std::lround(share * steps.base)));
}

}  // namespace

ToothPeriodMap::ToothPeriodMap(const ContactState& state, const MillingProcess& process, double spindle_speed_rpm,
                               StepCount steps, double rate_rad_s)
    : state_(state), period_s_(tooth_period_s(process.cutter, spindle_speed_rpm)) {
  if (!elementary(process)) {
    throw core::InputError(
        "semi-discretization: equal teeth without helix on a cylinder, one arc and no process damping only; take the "
        "collocation for anything else");
  }
  const double seconds_per_rad = period_s_ / process.cutter.pitch_rad();
  const std::vector<CutSegment> cut = cut_segments(process.engagement, process.cutter);
  const double cut_rad = cut.back().to_rad;
  for (const CutSegment& part : cut) {
    const int count = share_of(part, cut_rad, steps);
    const double step_rad = (part.to_rad - part.from_rad) / count;
    const double step_s = step_rad * seconds_per_rad;
    Segment segment{
        cut_step(state, step_s, nodes_of_step(rate_rad_s * step_s)), step_s, part.from_rad * seconds_per_rad, {}, {}};
    for (int i = 0; i < count; ++i) {
      const double from = part.from_rad + i * step_rad;
      const Eigen::MatrixXd mean = mean_directional_matrix(process.coefficients, process.cutter, process.engagement,
                                                           part.teeth, from, from + step_rad);
      segment.D.emplace_back(mean * state.in_plane);
    }
    segment.feedback.resize(segment.D.size());
    step_total_ += count;
    segments_.push_back(std::move(segment));
  }
  flight_ = free_flight(state, std::max(0.0, period_s_ - cut_rad * seconds_per_rad));
  x_.resize(state.size());
}

void ToothPeriodMap::set_depth(double depth_m) {
  depth_m_ = depth_m;
  const Eigen::Index p = state_.directions();
  for (Segment& segment : segments_) {
    const Eigen::Index n = segment.step.node.size();
    Eigen::MatrixXd system(p * n, p * n);
    Eigen::MatrixXd inverse(p * n, p * n);
    for (std::size_t i = 0; i < segment.D.size(); ++i) {
      for (Eigen::Index j = 0; j < n; ++j) {
        system.middleCols(p * j, p).noalias() = depth_m * segment.step.K.middleCols(3 * j, 3) * segment.D[i];
      }
      system.diagonal().array() += 1.0;
      inverse = system.partialPivLu().inverse();
      segment.feedback[i].resize(3 * n, p * n);
      for (Eigen::Index j = 0; j < n; ++j) {
        segment.feedback[i].middleRows(3 * j, 3).noalias() = -depth_m * segment.D[i] * inverse.middleRows(p * j, p);
      }
    }
  }
}

void ToothPeriodMap::apply(const Eigen::Ref<const Eigen::VectorXd>& in, Eigen::Ref<Eigen::VectorXd> out) {
  const Eigen::Index p = state_.directions();
  Eigen::Index sample = state_.size();
  x_ = in.head(state_.size());
  for (const Segment& segment : segments_) {
    const CutStep& step = segment.step;
    const Eigen::Index n = step.node.size();
    for (const Eigen::MatrixXd& feedback : segment.feedback) {
      out.segment(sample, p).noalias() = state_.C * x_;
      excess_.noalias() = step.E * x_;
      for (Eigen::Index j = 0; j < n; ++j) {
        excess_.segment(p * j, p) -=
            (1.0 - step.node(j)) * in.segment(sample, p) + step.node(j) * in.segment(sample + p, p);
      }
      force_.noalias() = feedback * excess_;
      advance(step.flight, x_);
      x_.noalias() += step.L * force_;
      sample += p;
    }
  }
  out.segment(sample, p).noalias() = state_.C * x_;
  advance(flight_, x_);
  out.head(state_.size()) = x_;
}

double ToothPeriodMap::longest_step_s() const {
  double longest = 0.0;
  for (const Segment& segment : segments_) longest = std::max(longest, segment.step_s);
  return longest;
}

Eigen::Vector3cd ToothPeriodMap::force_harmonic(const Eigen::VectorXcd& v, std::complex<double> mu,
                                                double omega) const {
  const Eigen::Index p = state_.directions();
  Eigen::Index sample = state_.size();
  Eigen::Vector3cd sum = Eigen::Vector3cd::Zero();
  for (const Segment& segment : segments_) {
    for (std::size_t i = 0; i < segment.D.size(); ++i, sample += p) {
      const double from = segment.start_s + static_cast<double>(i) * segment.step_s;
      const Eigen::VectorXcd start = v.segment(sample, p) * std::polar(1.0, -omega * from);
      const Eigen::VectorXcd end = v.segment(sample + p, p) * std::polar(1.0, -omega * (from + segment.step_s));
      sum += 0.5 * segment.step_s * (segment.D[i] * (start + end));
    }
  }
  return -depth_m_ * (1.0 - 1.0 / mu) * sum / period_s_;
}

}  // namespace thinwall::milling
