#include "tests/milling/marching.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

namespace thinwall::milling::testing {

Marching::Marching(const MillingProcess& process, const std::vector<Mode>& modes, double rpm, double depth_m,
                   int steps_a_turn, Profile profile)
    : process_(process),
      modes_(modes),
      depth_m_(depth_m),
      steps_(steps_a_turn),
      dt_(60.0 / rpm / steps_a_turn),
      rule_(core::gauss_legendre(process.cutter.depends_on_depth() ? 6 : 1)),
      profile_(std::move(profile)),
      heights_{0.0} {
  for (int j = 1; j < process.cutter.teeth; ++j) entry_.push_back(entry_.back() + process.cutter.pitch_rad(j));
  for (const double joint : profile_.joints) {
    if (joint > 0.0 && joint < depth_m) heights_.push_back(joint);
  }
  heights_.push_back(depth_m);
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  for (const Mode& m : modes_) start += Eigen::Vector3d(1e-6, 0.3e-6, 0.2e-6).dot(m.direction) * m.direction;
  history_.assign(static_cast<std::size_t>(steps_) + 1, {start, Eigen::Vector3d::Zero()});
}

double Marching::modulus_of_turn(int turns) {
  std::vector<Eigen::Vector3d> seen;
  for (int turn = 0; turn < turns; ++turn) {
    for (int i = 0; i < steps_; ++i) step(i);
    seen.push_back(history_.back().q);
  }
  // Least squares over the last turns, each weighed by its own size.
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (std::size_t n = seen.size() - 12; n + 1 < seen.size(); ++n) {
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector2d row(seen[n][k], seen[n - 1][k]);
      normal += row * row.transpose() / seen[n].squaredNorm();
      right += row * seen[n + 1][k] / seen[n].squaredNorm();
    }
  }
  const Eigen::Vector2d ab = normal.fullPivLu().solve(right);
  return std::sqrt(-ab(1));
}

std::vector<Eigen::Vector3d> Marching::last_turn_fed(double feed_per_tooth_m, int turns) {
  feed_m_per_rad_ = feed_per_tooth_m / process_.cutter.pitch_rad();
  edge_acts_ = true;
  std::vector<Eigen::Vector3d> seen;
  for (int turn = 0; turn < turns; ++turn) {
    seen.clear();
    for (int i = 0; i < steps_; ++i) {
      seen.push_back(history_.back().q);
      step(i);
    }
  }
  return seen;
}

Eigen::Vector3d Marching::delayed(double steps_ago, double part) const {
  // history_.back() is the state at the start of the step, `part` the share of the step at which we are.
  const double at = static_cast<double>(history_.size()) - 1.0 + part - steps_ago;
  const auto first = static_cast<std::size_t>(std::floor(at + 1e-9));
  const double x = at - static_cast<double>(first);
  const State& a = history_[first];
  const State& b = history_[std::min(first + 1, history_.size() - 1)];
  if (std::abs(x) < 1e-9) return a.q;
  const double x2 = x * x;
  const double x3 = x2 * x;
  return (2 * x3 - 3 * x2 + 1) * a.q + (x3 - 2 * x2 + x) * dt_ * a.v + (3 * x2 - 2 * x3) * b.q + (x3 - x2) * dt_ * b.v;
}

Eigen::Vector3d Marching::at_point(const State& x, int tooth, double phi, double z, double part) const {
  constexpr double turn = 2.0 * std::numbers::pi;
  const Cutter& cutter = process_.cutter;
  const CuttingCoefficients& k = coefficients(process_, tooth);
  const int ahead = (tooth + cutter.teeth - 1) % cutter.teeth;
  const double delay = cutter.pitch_rad(tooth) + z * (cutter.lag_rad_per_m(tooth) - cutter.lag_rad_per_m(ahead));
  const double kappa = profile_.kappa(z);
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d r(std::sin(phi), std::cos(phi), 0.0);
  const Eigen::Vector3d t(std::cos(phi), -std::sin(phi), 0.0);
  const Eigen::Vector3d n = std::sin(kappa) * r - std::cos(kappa) * up;
  const Eigen::Vector3d a = std::cos(kappa) * r + std::sin(kappa) * up;
  const double chip =
      n.dot(x.q - delayed(delay / turn * steps_, part) + delay * feed_m_per_rad_ * Eigen::Vector3d::UnitX());
  const double speed = 0.5 * cutter.diameter_m * turn / (steps_ * dt_);
  const double flank = process_.damping.C / speed * r.dot(x.v);
  // Edges of a cylinder: √(1 + (r ψ')²) of them a height.
  const double edge = edge_acts_ ? std::hypot(1.0, 0.5 * cutter.diameter_m * cutter.lag_rad_per_m(tooth)) : 0.0;
  return chip / std::sin(kappa) * (k.K_t * t + k.K_r * n - k.K_a * a) + flank * (r + process_.damping.friction * t) +
         edge * (k.K_te * t + k.K_re * n - k.K_ae * a);
}

Eigen::Vector3d Marching::over_heights(const State& x, int tooth, double tip_phi, double low, double high,
                                       double part) const {
  const double lag = process_.cutter.lag_rad_per_m(tooth);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t p = 1; p < heights_.size(); ++p) {
    const double from = std::max(low, heights_[p - 1]);
    const double to = std::min(high, heights_[p]);
    if (to <= from) continue;
    const double root_from = std::sqrt(from - heights_[p - 1]);
    const double root_to = std::sqrt(to - heights_[p - 1]);
    for (Eigen::Index h = 0; h < rule_.node.size(); ++h) {
      const double root = root_from + (root_to - root_from) * rule_.node(h);
      const double z = heights_[p - 1] + root * root;
      sum += 2.0 * root * (root_to - root_from) * rule_.weight(h) * at_point(x, tooth, tip_phi - lag * z, z, part);
    }
  }
  return sum;
}

Eigen::Vector3d Marching::force(const State& x, double theta, double part) const {
  constexpr double turn = 2.0 * std::numbers::pi;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int j = 0; j < process_.cutter.teeth; ++j) {
    const double lag = process_.cutter.lag_rad_per_m(j);
    for (const Engagement& arc : arcs(process_)) {
      // Heights z with 0 < s − lag z < arc, s since the tip entered, in this turn or the one before.
      const double later = arc.entry_rad - process_.engagement.entry_rad;
      double s = std::fmod(theta - entry_[static_cast<std::size_t>(j)] - later + 4.0 * turn, turn);
      for (; s < arc.arc_rad() + lag * depth_m_; s += turn) {
        const double low = lag > 0.0 ? std::clamp((s - arc.arc_rad()) / lag, 0.0, depth_m_) : 0.0;
        const double high = lag > 0.0 ? std::clamp(s / lag, 0.0, depth_m_) : depth_m_;
        sum -= over_heights(x, j, arc.entry_rad + s, low, high, part);
      }
    }
  }
  return sum;
}

Marching::State Marching::slope(const State& x, double theta, double part) const {
  const Eigen::Vector3d f = force(x, theta, part);
  State result{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  for (const Mode& m : modes_) {
    const double omega = 2.0 * std::numbers::pi * m.frequency_hz;
    result.q += x.v.dot(m.direction) * m.direction;
    result.v += (f.dot(m.direction) / m.mass_kg - 2.0 * m.damping_ratio * omega * x.v.dot(m.direction) -
                 omega * omega * x.q.dot(m.direction)) *
                m.direction;
  }
  return result;
}

void Marching::step(int i) {
  // Just inside of the step at both ends: jumps lie on its ends.
  const double d = 2.0 * std::numbers::pi / steps_;
  const double inside = 1e-9;
  const auto moved = [&](const State& x, const State& k, double share) {
    return State{x.q + share * dt_ * k.q, x.v + share * dt_ * k.v};
  };
  const State x = history_.back();
  const State k1 = slope(x, (i + inside) * d, 0.0);
  const State k2 = slope(moved(x, k1, 0.5), (i + 0.5) * d, 0.5);
  const State k3 = slope(moved(x, k2, 0.5), (i + 0.5) * d, 0.5);
  const State k4 = slope(moved(x, k3, 1.0), (i + 1.0 - inside) * d, 1.0);
  history_.push_back({x.q + dt_ / 6.0 * (k1.q + 2.0 * k2.q + 2.0 * k3.q + k4.q),
                      x.v + dt_ / 6.0 * (k1.v + 2.0 * k2.v + 2.0 * k3.v + k4.v)});
}

}  // namespace thinwall::milling::testing
