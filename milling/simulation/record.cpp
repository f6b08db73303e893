#include "milling/simulation/record.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace thinwall::milling {

namespace {

/// The greatest value on [0, 1] of the parabola through values at 0, ½ and 1.
double parabola_peak(double a, double b, double c) {
  const double bend = 2.0 * (a - 2.0 * b + c);
  const double slope = -3.0 * a + 4.0 * b - c;
  const double ends = std::max({a, b, c});
  if (bend >= 0.0) return ends;
  const double at = -slope / (2.0 * bend);
  return at > 0.0 && at < 1.0 ? std::max(ends, a + 0.5 * slope * at) : ends;
}

/// Takes in the extremes of the parabola through a quantity of a step.
template <class Quantity>
void take_parabola(Extremes& extremes, const MarchStep& step, const Quantity& of) {
  for (int i = 0; i < 3; ++i) {
    const double a = of(step.at[0])[i], b = of(step.at[1])[i], c = of(step.at[2])[i];
    extremes.high[i] = std::max(extremes.high[i], parabola_peak(a, b, c));
    extremes.low[i] = std::min(extremes.low[i], -parabola_peak(-a, -b, -c));
  }
}

const Eigen::Vector3d& displacement_of(const MarchNode& node) {
  return node.displacement_m;
}
const Eigen::Vector3d& force_of(const MarchNode& node) {
  return node.force_n;
}

/// The slope at a rotation of the parabola through the displacements of a step, m/rad.
Eigen::Vector3d slope_at(const MarchStep& step, double rotation) {
  const double s = (rotation - step.from_rad) / step.step_rad;
  return ((4.0 * s - 3.0) * step.at[0].displacement_m + (4.0 - 8.0 * s) * step.at[1].displacement_m +
          (4.0 * s - 1.0) * step.at[2].displacement_m) /
         step.step_rad;
}

}  // namespace

double size_of_motion(const Extremes& displacement_m) {
  constexpr double least_share = 1e-6;
  const Eigen::Vector3d range = displacement_m.range();
  const double farthest = displacement_m.low.cwiseAbs().cwiseMax(displacement_m.high.cwiseAbs()).maxCoeff();
  return range.allFinite() ? std::max(range.maxCoeff(), least_share * farthest) : range.maxCoeff<Eigen::PropagateNaN>();
}

Record::Record(const std::vector<TipPass>& tips, bool alike, double rad_per_s, const SimulationOptions& options,
               SimulatedCut& result)
    : tips_(tips),
      alike_(alike),
      rad_per_s_(rad_per_s),
      sample_rad_(2.0 * std::numbers::pi / options.samples_a_turn),
      kept_(static_cast<std::size_t>(options.kept_passes)),
      result_(result),
      open_(tips.size()) {
  const Eigen::Index samples = static_cast<Eigen::Index>(options.traced_turns) * options.samples_a_turn;
  result.trace.step_s = sample_rad_ / rad_per_s;
  result.trace.displacement_m.setZero(3, samples);
  result.trace.force_n.setZero(3, samples);
  result.trace.torque_n_m.setZero(samples);
  if (options.means_a_turn == 0) return;
  part_rad_ = 2.0 * std::numbers::pi / options.means_a_turn;
  const Eigen::Index parts = static_cast<Eigen::Index>(options.recorded_turns) * options.means_a_turn;
  of_part_rad_.setZero(parts);
  result.means_m.setZero(3, parts);
}

void Record::begin_period(double time_s, double traced_rad) {
  period_start_s_ = time_s;
  traced_rad_ = traced_rad;
}

void Record::operator()(const MarchStep& step) {
  take_parabola(result_.displacement_m, step, displacement_of);
  take_parabola(result_.force_n, step, force_of);
  if (traced_rad_ >= 0.0) take_trace(step);
  take_passes(step);
  if (result_.contact) take_contact(step, *result_.contact);
  const Eigen::Vector3d moved = step.integral([](const MarchNode& n) { return Eigen::Vector3d(n.displacement_m); });
  displaced_ += moved;
  take_mean(step, moved);
  if (!step.in_cut) return;
  for (const MarchNode& node : step.at) {
    result_.peak_force_n = std::max(result_.peak_force_n, node.force_n.norm());
    result_.peak_torque_n_m = std::max(result_.peak_torque_n_m, node.torque_n_m);
    result_.thickest_chip_m = std::max(result_.thickest_chip_m, node.thickest_chip_m);
  }
  impulse_ += step.integral([](const MarchNode& n) { return Eigen::Vector3d(n.force_n); });
  work_ += step.integral([](const MarchNode& n) { return n.torque_n_m; });
  removed_ += step.integral([](const MarchNode& n) { return n.removal_m2_rad; });
  within_ += step.integral([](const MarchNode& n) { return static_cast<double>(n.points); });
  without_contact_ += step.integral([](const MarchNode& n) { return static_cast<double>(n.without_contact); });
}

void Record::take_trace(const MarchStep& step) {
  Trace& trace = result_.trace;
  for (; next_sample_ < trace.torque_n_m.size(); ++next_sample_) {
    const double rotation = static_cast<double>(next_sample_) * sample_rad_ - traced_rad_;
    if (rotation >= step.from_rad + step.step_rad) return;
    trace.displacement_m.col(next_sample_) =
        step.value(rotation, [](const MarchNode& n) { return Eigen::Vector3d(n.displacement_m); });
    trace.force_n.col(next_sample_) =
        step.value(rotation, [](const MarchNode& n) { return Eigen::Vector3d(n.force_n); });
    trace.torque_n_m(next_sample_) = step.value(rotation, [](const MarchNode& n) { return n.torque_n_m; });
  }
}

/// A step counts for the part of a turn in which its middle lies.
void Record::take_mean(const MarchStep& step, const Eigen::Vector3d& integral) {
  if (of_part_rad_.size() == 0) return;
  const auto part = static_cast<Eigen::Index>((recorded_rad_ + 0.5 * step.step_rad) / part_rad_);
  recorded_rad_ += step.step_rad;
  if (part >= of_part_rad_.size()) return;  // by round-off at the end
  result_.means_m.col(part) += integral;
  of_part_rad_(part) += step.step_rad;
}

void Record::take_contact(const MarchStep& step, ContactOutcome& contact) {
  for (const MarchNode& node : step.at) {
    contact.least_n = std::min(contact.least_n, node.pressing_n);
    contact.largest_n = std::max(contact.largest_n, node.pressing_n);
    if (node.separating_n > 0.0) contact.widest_m = std::max(contact.widest_m, node.gap_m);
  }
  open_rad_ += step.integral([](const MarchNode& n) { return n.separating_n > 0.0 ? 1.0 : 0.0; });
}

void Record::take_passes(const MarchStep& step) {
  constexpr double hair = 1e-9;  // rad
  const double to = step.from_rad + step.step_rad;
  const auto position = [&](double rotation) -> Eigen::Vector3d {
    return step.value(rotation, [](const MarchNode& n) { return Eigen::Vector3d(n.displacement_m); });
  };
  for (std::size_t i = 0; i < tips_.size(); ++i) {
    const TipPass& tip = tips_[i];
    std::optional<ToothPass>& pass = open_[i];
    if (pass && tip.exit_rad > step.from_rad + hair && tip.exit_rad <= to + hair) {
      pass->exit_m = position(tip.exit_rad);
      passes_.push_back(*pass);
      pass.reset();
      if (passes_.size() > kept_) passes_.pop_front();
    }
    if (tip.entry_rad >= step.from_rad - hair && tip.entry_rad < to - hair) {
      const Eigen::Vector3d entry = position(tip.entry_rad), slope = slope_at(step, tip.entry_rad);
      pass = ToothPass{tip.tooth, period_start_s_ + tip.entry_rad / rad_per_s_, entry, slope * rad_per_s_,
                       Eigen::Vector3d::Zero()};
      if (i == 0 || alike_) samples_.emplace_back() << entry, slope;
      if (samples_.size() > kept_) samples_.pop_front();
    }
  }
}

void Record::finish(double recorded_rad) {
  result_.mean_force_n = impulse_ / recorded_rad;
  result_.mean_displacement_m = displaced_ / recorded_rad;
  result_.mean_torque_n_m = work_ / recorded_rad;
  for (Eigen::Index i = 0; i < of_part_rad_.size(); ++i)
    result_.means_m.col(i) /= of_part_rad_(i);  // NaN where no step fell into the part
  result_.removed_m2 = removed_ / recorded_rad * 2.0 * std::numbers::pi;
  result_.mean_power_w = result_.mean_torque_n_m * rad_per_s_;
  if (result_.contact) result_.contact->open_share = open_rad_ / recorded_rad;
  result_.share_without_contact = within_ > 0.0 ? without_contact_ / within_ : 0.0;
  result_.passes.assign(passes_.begin(), passes_.end());
  Eigen::MatrixXd samples(6, std::ssize(samples_));
  for (std::size_t i = 0; i < samples_.size(); ++i) samples.col(static_cast<Eigen::Index>(i)) = samples_[i];
  if (samples.cols() >= 2) result_.motion = motion_kind(samples, size_of_motion(result_.displacement_m));
}

}  // namespace thinwall::milling
