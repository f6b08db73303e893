#include "milling/regeneration.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace thinwall::milling {

namespace {

// Bound of ‖D(φ)‖ over the cut: one tooth's Frobenius norm does not depend on φ.
double largest_stiffness(const MillingProcess& process) {
  int teeth = 0;
  for (const CutSegment& part : cut_segments(process.engagement, process.cutter)) teeth = std::max(teeth, part.teeth);
  const auto& k = process.coefficients;
  return teeth * std::hypot(k.K_t, k.K_r, k.K_a);
}

// Contact stiffness and inertia set a rate of their own, √(w ‖D‖ ‖C Λ B‖): C Λ B is the inverse mass at the contact.
double contact_rate(const ContactState& state, const MillingProcess& process, double depth_m) {
  const Eigen::Index n = state.decay.size();
  Eigen::MatrixXd velocity = state.B;
  for (Eigen::Index i = 0; i < n; ++i) {
    velocity.row(i) = state.decay(i) * state.B.row(i) - state.frequency(i) * state.B.row(n + i);
    velocity.row(n + i) = state.frequency(i) * state.B.row(i) + state.decay(i) * state.B.row(n + i);
  }
  velocity.bottomRows(state.real_pole.size()).array().colwise() *= state.real_pole;
  return std::sqrt(depth_m * largest_stiffness(process) * (state.C * velocity).norm());
}

double mean_stiffness(const MillingProcess& process) {
  DirectionalMatrix mean = DirectionalMatrix::Zero();
  for (const CutSegment& part : cut_segments(process.engagement, process.cutter)) {
    mean += mean_directional_matrix(process.coefficients, process.cutter, process.engagement, part.teeth, part.from_rad,
                                    part.to_rad) *
            ((part.to_rad - part.from_rad) / process.cutter.pitch_rad());
  }
  return mean.norm();
}

}  // namespace

Regeneration::Regeneration(const RelativeStructure& structure, const ContactState& state, const MillingProcess& process,
                           double spindle_speed_rpm, double deepest_m)
    : structure_(structure),
      state_(state),
      process_(process),
      spindle_speed_rpm_(spindle_speed_rpm),
      rate_rad_s_(std::hypot(fastest_pole(state), contact_rate(state, process, deepest_m))),
      mean_stiffness_(mean_stiffness(process)) {
  const double pitch = process.cutter.pitch_rad();
  cut_s_ = tooth_period_s(process.cutter, spindle_speed_rpm) * std::min(1.0, process.engagement.arc_rad() / pitch);
}

DominantEigenvalue Regeneration::multiplier(double depth_m, StepCount steps, double tolerance) {
  auto [found, is_new] =
      maps_.try_emplace(Key{steps.base, steps.division}, state_, process_, spindle_speed_rpm_, steps, rate_rad_s_);
  ToothPeriodMap& map = found->second;
  map.set_depth(depth_m);
  DominantEigenvalue eigen =
      dominant_eigenvalue([&map](const auto& in, auto out) { map.apply(in, out); }, map.size(), tolerance, first_look_);
  // A little less than last time, so that an easier map is noticed.
  if (eigen.basis > 0) first_look_ = std::max<Eigen::Index>(12, eigen.basis - 2);
  return eigen;
}

int Regeneration::resolving_steps(double depth_m) const {
  double fastest = 0.0;
  for (Eigen::Index k = 0; k < structure_.poles.size(); ++k) {
    const std::complex<double> pole = structure_.poles(k);
    const double peak = structure_.phi.col(k).norm() * structure_.b.col(k).norm() / std::abs(pole.real());
    if (2.0 * depth_m * mean_stiffness_ * peak >= 0.5) fastest = std::max(fastest, pole.imag());
  }
  return std::max(8, static_cast<int>(std::ceil(5.0 * fastest * cut_s_ / (2.0 * std::numbers::pi))));
}

double Regeneration::small_gain_depth_m() const {
  // Each term peaks at its own pole, and so, to a few per cent, does the sum; the factor covers what lies between.
  constexpr double between_peaks = 1.1;
  double largest = 0.0;
  for (const std::complex<double> at : structure_.poles) {
    const std::complex<double> i_omega(0.0, at.imag());
    double magnitude = 0.0;
    for (Eigen::Index k = 0; k < structure_.poles.size(); ++k) {
      const std::complex<double> pole = structure_.poles(k);
      const double size = structure_.phi.col(k).norm() * structure_.b.col(k).norm();
      magnitude += size / std::abs(i_omega - pole);
      if (pole.imag() != 0.0) magnitude += size / std::abs(i_omega - std::conj(pole));
    }
    largest = std::max(largest, magnitude);
  }
  return 1.0 / (2.0 * largest_stiffness(process_) * between_peaks * largest);
}

double Regeneration::chatter_frequency_hz(const DominantEigenvalue& eigen, StepCount steps) const {
  const ToothPeriodMap& map = maps_.at({steps.base, steps.division});
  const Eigen::Matrix3d R = process_.frame.rotation();
  const double period = tooth_period_s(process_.cutter, spindle_speed_rpm_);
  const double spacing = 2.0 * std::numbers::pi / period;
  const double base = std::arg(eigen.value) / period;
  // Beyond the fastest pole a structure is all inertia: no response can be largest there.
  const int reach = 1 + static_cast<int>(std::ceil(1.5 * fastest_pole(state_) / spacing));
  double largest = -1.0;
  double chatter = base;
  for (int k = -reach; k <= reach; ++k) {
    const double omega = base + k * spacing;
    const Eigen::Vector3cd force = R * map.force_harmonic(eigen.vector, eigen.value, omega);
    const double motion = (receptance(structure_, omega) * force).norm();
    if (motion <= largest) continue;
    largest = motion;
    chatter = omega;
  }
  return std::abs(chatter) / (2.0 * std::numbers::pi);
}

int Regeneration::steps(StepCount steps) const {
  return maps_.at({steps.base, steps.division}).steps();
}

double Regeneration::longest_step_s(StepCount steps) const {
  return maps_.at({steps.base, steps.division}).longest_step_s();
}

}  // namespace thinwall::milling
