#pragma once
// The linear equation of a cut marched in time: slow, and independent of every matrix of the program.

#include <Eigen/Core>
#include <functional>
#include <numbers>
#include <vector>

#include "core/gauss_rule.hpp"
#include "milling/cut/process.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::milling::testing {

/// Axial immersion angle over height, m, and the heights between which it is smooth.
struct Profile {
  std::function<double(double)> kappa = [](double) { return 0.5 * std::numbers::pi; };
  std::vector<double> joints = {};
};

/// M q'' + C q' + K q = −Σ_j ∫ (K_t t + K_r n − K_a a) nᵀ [q(t) − q(t − τ_j(z))] dz/sin κ − process damping, marched by
/// Runge-Kutta's fourth-order method with the delayed displacement from cubic Hermite polynomials. Heights by Gauss's
/// rule between joints, in the square root of the height above the lower one, so that the tip of a ball is smooth.
/// Entries, exits and pitches should be multiples of the step, so that no step crosses a jump. |μ| of a turn from the
/// recurrence s_{n+1} = a s_n + b s_{n−1} of two conjugate multipliers, |μ|² = −b. Modes along the axes.
class Marching {
 public:
  Marching(const MillingProcess& process, const std::vector<Mode>& modes, double rpm, double depth_m, int steps_a_turn,
           Profile profile = {});

  double modulus_of_turn(int turns);

  /// The last of `turns` turns with the chip of the feed and the edge forces, a displacement a step; the first lies at
  /// the start of the turn.
  std::vector<Eigen::Vector3d> last_turn_fed(double feed_per_tooth_m, int turns);

 private:
  struct State {
    Eigen::Vector3d q, v;
  };

  [[nodiscard]] Eigen::Vector3d delayed(double steps_ago, double part) const;
  [[nodiscard]] Eigen::Vector3d at_point(const State& x, int tooth, double phi, double z, double part) const;
  /// Over heights from low to high, m, within joints.
  [[nodiscard]] Eigen::Vector3d over_heights(const State& x, int tooth, double tip_phi, double low, double high,
                                             double part) const;
  [[nodiscard]] Eigen::Vector3d force(const State& x, double theta, double part) const;
  [[nodiscard]] State slope(const State& x, double theta, double part) const;
  void step(int i);

  const MillingProcess& process_;
  std::vector<Mode> modes_;
  double depth_m_;
  int steps_;
  double dt_;
  core::GaussRule rule_;  // over the heights in the cut, between joints
  Profile profile_;
  std::vector<double> heights_;  // the joints, 0 and the depth
  std::vector<double> entry_{0.0};
  std::vector<State> history_;
  double feed_m_per_rad_ = 0.0;
  bool edge_acts_ = false;
};

}  // namespace thinwall::milling::testing
