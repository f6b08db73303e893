#pragma once
// The growth of regenerative vibration at one speed, for any depth and step count.

#include <complex>
#include <map>

#include "milling/dominant_eigenvalue.hpp"
#include "milling/semi_discretization.hpp"

namespace thinwall::milling {

/// The cut at one spindle speed. Keeps the maps of the step counts used so far, which depend on the speed only.
class Regeneration {
 public:
  /// Arguments are valid (validate()) and outlive this object. `deepest_m`: the largest depth to come.
  Regeneration(const RelativeStructure& structure, const ContactState& state, const MillingProcess& process,
               double spindle_speed_rpm, double deepest_m);

  /// The dominant multiplier at depth `depth_m`, to the given relative residual.
  DominantEigenvalue multiplier(double depth_m, StepCount steps, double tolerance = 1e-7);

  /// Five steps a wave, over the cut, for the fastest mode that can regenerate at this depth; at least 8.
  [[nodiscard]] int resolving_steps(double depth_m) const;

  /// A depth below which no cut of this process can be unstable, m: 1/(2 max‖D‖ max‖G‖), with ‖G‖ bounded by the sum of
  /// the modes' magnitudes.
  [[nodiscard]] double small_gain_depth_m() const;

  /// Frequency of the motion of an eigenvector, Hz. A Floquet solution e^{iωt} (periodic) has components at
  /// ω_k = (arg μ + 2πk)/T, all k; the chatter frequency is that of the largest displacement |G(ω_k) F(ω_k)|, with F
  /// the harmonic of the cutting force (ToothPeriodMap::force_harmonic): receptance and content of the eigenvector in
  /// one.
  [[nodiscard]] double chatter_frequency_hz(const DominantEigenvalue& eigen, StepCount steps) const;

  /// Steps in the cut, and the length of the longest, of a step count used before.
  [[nodiscard]] int steps(StepCount steps) const;
  [[nodiscard]] double longest_step_s(StepCount steps) const;

 private:
  using Key = std::pair<int, int>;

  const RelativeStructure& structure_;
  const ContactState& state_;
  const MillingProcess& process_;
  double spindle_speed_rpm_;
  double rate_rad_s_;
  double mean_stiffness_;  ///< ‖D̄‖ over the tooth period, N/m²
  double cut_s_ = 0.0;
  Eigen::Index first_look_ = 20;  ///< basis at which the next eigenvalue is expected
  std::map<Key, ToothPeriodMap> maps_;
};

}  // namespace thinwall::milling
