// Cutters with helix and unequal pitches: against equal teeth, closed forms, and the linear equation marched in time.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "milling/product_rule.hpp"
#include "milling/stability.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::milling {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

const std::vector<testing::Mode> modes{{500.0, 0.02, 0.05, Eigen::Vector3d::UnitX()},
                                       {700.0, 0.03, 0.08, Eigen::Vector3d::UnitY()}};

RelativeStructure structure() {
  return relative_structure(testing::modal_model(modes), "P");
}

MillingProcess process_with(Cutter cutter, double entry_rad, double exit_rad) {
  MillingProcess process;
  process.cutter = std::move(cutter);
  process.coefficients = {6e8, 2e8, 0.0, 0.0, 0.0, 0.0};
  process.engagement = {entry_rad, exit_rad};
  return process;
}

StabilityOptions sharp() {
  StabilityOptions options;
  options.error_tolerance = 1e-8;
  return options;
}

/// The linear equation M q'' + C q' + K q = −w Σ_j ∫ D(φ_j − k_j ζ) [q(t) − q(t − τ_j(ζ))] dζ / w marched by
/// Runge-Kutta's fourth-order method with the delayed displacement from cubic Hermite polynomials, heights by
/// Gauss's rule: independent of every matrix of the program but D(φ). Entries, exits and pitches are multiples of
/// the step, so that no step crosses a jump. |μ| of a turn from the recurrence s_{n+1} = a s_n + b s_{n−1} of two
/// conjugate multipliers, |μ|² = −b, or from one real multiplier.
class Marching {
 public:
  Marching(const MillingProcess& process, double rpm, double depth_m, int steps_a_turn)
      : process_(process),
        depth_m_(depth_m),
        steps_(steps_a_turn),
        dt_(60.0 / rpm / steps_a_turn),
        rule_(gauss_legendre(process.cutter.has_helix() ? 6 : 1)) {
    for (int j = 1; j < process.cutter.teeth; ++j) entry_.push_back(entry_.back() + process.cutter.pitch_rad(j));
    for (int i = 0; i <= steps_; ++i) history_.push_back({Eigen::Vector2d(1e-6, 0.3e-6), Eigen::Vector2d::Zero()});
  }

  double modulus_of_turn(int turns) {
    std::vector<Eigen::Vector2d> seen;
    for (int turn = 0; turn < turns; ++turn) {
      for (int i = 0; i < steps_; ++i) step(i);
      seen.push_back(history_.back().q);
    }
    // Least squares over the last turns, each weighed by its own size.
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (std::size_t n = seen.size() - 12; n + 1 < seen.size(); ++n) {
      for (int k = 0; k < 2; ++k) {
        const Eigen::Vector2d row(seen[n][k], seen[n - 1][k]);
        normal += row * row.transpose() / seen[n].squaredNorm();
        right += row * seen[n + 1][k] / seen[n].squaredNorm();
      }
    }
    const Eigen::Vector2d ab = normal.fullPivLu().solve(right);
    return std::sqrt(-ab(1));
  }

 private:
  struct State {
    Eigen::Vector2d q, v;
  };

  [[nodiscard]] Eigen::Vector2d delayed(double steps_ago, double part) const {
    // history_.back() is the state at the start of the step, `part` the share of the step at which we are.
    const double at = static_cast<double>(history_.size()) - 1.0 + part - steps_ago;
    const auto first = static_cast<std::size_t>(std::floor(at + 1e-9));
    const double x = at - static_cast<double>(first);
    const State& a = history_[first];
    const State& b = history_[std::min(first + 1, history_.size() - 1)];
    if (std::abs(x) < 1e-9) return a.q;
    const double x2 = x * x;
    const double x3 = x2 * x;
    return (2 * x3 - 3 * x2 + 1) * a.q + (x3 - 2 * x2 + x) * dt_ * a.v + (3 * x2 - 2 * x3) * b.q +
           (x3 - x2) * dt_ * b.v;
  }

  [[nodiscard]] Eigen::Vector2d force(const Eigen::Vector2d& q, double theta, double part) const {
    const Cutter& cutter = process_.cutter;
    constexpr double turn = 2.0 * std::numbers::pi;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (int j = 0; j < cutter.teeth; ++j) {
      const int ahead = (j + cutter.teeth - 1) % cutter.teeth;
      const double lag = cutter.lag_rad_per_m(j);
      // Heights z with 0 < s − lag z < arc, s since the tip entered, in this turn or the one before.
      double s = std::fmod(theta - entry_[static_cast<std::size_t>(j)] + 2.0 * turn, turn);
      for (; s < process_.engagement.arc_rad() + lag * depth_m_; s += turn) {
        const double low = lag > 0.0 ? std::clamp((s - process_.engagement.arc_rad()) / lag, 0.0, depth_m_) : 0.0;
        const double high = lag > 0.0 ? std::clamp(s / lag, 0.0, depth_m_) : depth_m_;
        for (Eigen::Index h = 0; h < rule_.node.size(); ++h) {
          const double z = low + (high - low) * rule_.node(h);
          const double delay = cutter.pitch_rad(j) + z * (lag - cutter.lag_rad_per_m(ahead));
          const DirectionalMatrix D =
              directional_matrix(process_.coefficients, process_.engagement.entry_rad + s - lag * z);
          sum -= (high - low) * rule_.weight(h) * (D.topRows<2>() * (q - delayed(delay / turn * steps_, part)));
        }
      }
    }
    return sum;
  }

  [[nodiscard]] State slope(const State& x, double theta, double part) const {
    const Eigen::Vector2d f = force(x.q, theta, part);
    State result{x.v, {}};
    for (int k = 0; k < 2; ++k) {
      const testing::Mode& m = modes[static_cast<std::size_t>(k)];
      const double omega = 2.0 * std::numbers::pi * m.frequency_hz;
      result.v[k] = f[k] / m.mass_kg - 2.0 * m.damping_ratio * omega * x.v[k] - omega * omega * x.q[k];
    }
    return result;
  }

  void step(int i) {
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

  const MillingProcess& process_;
  double depth_m_;
  int steps_;
  double dt_;
  GaussRule rule_;  // over the heights in the cut
  std::vector<double> entry_{0.0};
  std::vector<State> history_;
};

TEST(Pitch, NearlyEqualTeethOverATurnAreEqualTeethOverAPitch) {
  // Pitches that differ by a ten-millionth go the way of unequal ones: a turn's multiplier is the product of the
  // pitches'. A short cut, and one with two and three teeth at a time.
  for (const double arc : {40.0 * degree, 200.0 * degree}) {
    const double p = 0.5 * std::numbers::pi;
    const double off = 1e-7;
    const MillingProcess equal = process_with({4, 0.012}, 10.0 * degree, 10.0 * degree + arc);
    const MillingProcess unequal =
        process_with({4, 0.012, {p + off, p - off, p + off, p - off}}, 10.0 * degree, 10.0 * degree + arc);
    for (const double rpm : {6000.0, 9500.0}) {
      const Multiplier pitch = multiplier_at(structure(), equal, rpm, 0.3e-3, sharp());
      const Multiplier turn = multiplier_at(structure(), unequal, rpm, 0.3e-3, sharp());
      EXPECT_NEAR(turn.modulus / std::pow(pitch.modulus, 4), 1.0, 3e-6) << arc << " rad, " << rpm << " rpm";
    }
  }
}

TEST(Pitch, UnequalPitchesAgainstMarchingInTime) {
  const MillingProcess process =
      process_with({4, 0.012, {80.0 * degree, 100.0 * degree, 70.0 * degree, 110.0 * degree}}, 0.0, 60.0 * degree);
  for (const double rpm : {5000.0, 10000.0}) {
    const double depth = 0.9e-3;
    const Multiplier exact = multiplier_at(structure(), process, rpm, depth, sharp());
    EXPECT_EQ(exact.status, StabilityStatus::converged);
    EXPECT_EQ(exact.kind, Bifurcation::hopf);
    EXPECT_NEAR(Marching(process, rpm, depth, 1800).modulus_of_turn(30) / exact.modulus, 1.0, 1e-4) << rpm;
  }
}

TEST(Helix, AgainstMarchingInTime) {
  const MillingProcess process =
      process_with({3, 0.012, {}, {30.0 * degree, 30.0 * degree, 30.0 * degree}}, 120.0 * degree, 180.0 * degree);
  const double rpm = 12000.0;
  const double depth = 2e-3;
  const Multiplier exact = multiplier_at(structure(), process, rpm, depth, sharp());
  EXPECT_EQ(exact.status, StabilityStatus::converged);
  EXPECT_NEAR(Marching(process, rpm, depth, 1440).modulus_of_turn(24) / std::pow(exact.modulus, 3), 1.0, 1e-4);
}

TEST(Helix, UnequalHelicesAgainstMarchingInTime) {
  // The delay changes along the edges.
  const MillingProcess process =
      process_with({2, 0.012, {}, {25.0 * degree, 40.0 * degree}}, 120.0 * degree, 180.0 * degree);
  const double rpm = 12000.0;
  const double depth = 2e-3;
  StabilityOptions options;
  options.error_tolerance = 1e-5;
  const Multiplier exact = multiplier_at(structure(), process, rpm, depth, options);
  EXPECT_EQ(exact.status, StabilityStatus::converged);
  EXPECT_NEAR(Marching(process, rpm, depth, 1440).modulus_of_turn(30) / exact.modulus, 1.0, 1e-4);
}

TEST(Helix, WholePitchOfEdgeInTheDepthMakesTheForceConstant) {
  // At w = πD/(z tan β) the directional matrix does not depend on time: turning, with a closed form (see lobes_test).
  const double zeta = 0.02;
  const double r = 1.05;
  const double hz = 150.0;
  const double mass = 20.0;
  const double omega = 2.0 * std::numbers::pi * hz;
  const double stiffness = mass * omega * omega;
  const double diameter = 0.01;
  const int teeth = 3;
  MillingProcess process = process_with({teeth, diameter}, 20.0 * degree, 150.0 * degree);
  process.coefficients = {3e8, 2e8, 0.0, 0.0, 0.0, 0.0};
  const double share = teeth * process.engagement.arc_rad() / (2.0 * std::numbers::pi);
  const double per_depth = share * mean_directional_matrix(process.coefficients, process.engagement.entry_rad,
                                                           process.engagement.exit_rad)(0, 0);
  const double r2 = r * r;
  const double depth = stiffness * (std::pow(1.0 - r2, 2) + 4.0 * zeta * zeta * r2) / (2.0 * (r2 - 1.0)) / per_depth;
  const double helix = std::atan(std::numbers::pi * diameter / (teeth * depth));
  ASSERT_LT(helix, 80.0 * degree);
  process.cutter.helices_rad.assign(teeth, helix);
  const auto tool = relative_structure(testing::modal_model({{hz, zeta, mass, Eigen::Vector3d::UnitX()}}), "P");
  for (const int j : {1, 2}) {
    const double rpm =
        hz * r * std::numbers::pi / (j * std::numbers::pi - std::atan((r2 - 1.0) / (2.0 * zeta * r))) * 60.0 / teeth;
    EXPECT_NEAR(multiplier_at(tool, process, rpm, depth, sharp()).modulus, 1.0, 1e-9) << "lobe " << j;
  }
}

TEST(Helix, LimitingDepthIsWhereTheMultiplierCrossesOne) {
  const MillingProcess process = process_with(
      {4, 0.012, {}, {35.0 * degree, 35.0 * degree, 35.0 * degree, 35.0 * degree}}, 100.0 * degree, 180.0 * degree);
  StabilityOptions options;
  options.error_tolerance = 1e-6;
  options.depth_limit_m = 0.02;
  for (const double rpm : {4000.0, 7000.0, 8800.0}) {
    const LobeRow row = limiting_depth(structure(), process, rpm, options);
    ASSERT_EQ(row.status, StabilityStatus::converged) << rpm;
    const auto modulus = [&](double factor) {
      return multiplier_at(structure(), process, rpm, factor * row.limiting_depth_m, options).modulus;
    };
    EXPECT_NEAR(modulus(1.0), 1.0, 1e-5) << rpm;
    EXPECT_LT(modulus(0.99), 1.0);
    EXPECT_GT(modulus(1.01), 1.0);
  }
}

TEST(Cutter, RefusesPitchesThatAreNoTurnAndHelicesTooSteep) {
  EXPECT_EQ(validate(Cutter{2, 0.01, {1.0, 2.0}}).size(), 1u);
  EXPECT_EQ(validate(Cutter{2, 0.01, {-1.0, 1.0 + 2.0 * std::numbers::pi}}).size(), 1u);
  EXPECT_EQ(validate(Cutter{2, 0.01, {std::numbers::pi, 0.5 * std::numbers::pi, 0.5 * std::numbers::pi}}).size(), 1u);
  EXPECT_EQ(validate(Cutter{2, 0.01, {}, {90.0 * degree, 90.0 * degree}}).size(), 2u);
  EXPECT_EQ(validate(Cutter{2, 0.01, {}, {0.5}}).size(), 1u);
  EXPECT_TRUE(validate(Cutter{2, 0.01, {3.0, 2.0 * std::numbers::pi - 3.0}, {0.5, 0.6}}).empty());
}

}  // namespace
}  // namespace thinwall::milling
