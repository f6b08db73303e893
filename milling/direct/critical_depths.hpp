#pragma once
// All depths at which a multiplier crosses the unit circle at one speed, directly: no search over depths.

#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <map>
#include <optional>
#include <vector>

#include "milling/direct/crossing.hpp"

namespace thinwall::milling {

/// The search for all critical depths. On the boundary det(I + w Z(e^{iθ})) = 0: the depths are the reciprocals of real
/// positive eigenvalues ν of −Z(e^{iθ}) as θ runs over the half circle. The eigenvalues are followed between stops;
/// where the nearest match is not clear or a path so near to the real axis that it could touch it the step is halved. A
/// path that crosses the axis is brought to it by to_axis(). At θ = π (and 0) real eigenvalues count as they are.
/// Eigenvalues are found only where a bound of them says that the depth can reach one, of large Z only those that can
/// (linalg::largest_eigenvalues()), and kept, so that a search to a greater depth costs little more.
class CriticalDepths {
 public:
  /// Eigenvalues of a large Z: those that a depth can reach, of which one whose vector the starting vectors lack would
  /// be missed, and a part of those beyond for a search that goes on deeper; or all, where nothing else would tell of
  /// one that was missed.
  enum class Eigenvalues { reached, deeper, all };

  /// Keeps `gain`, whose references must outlive the search.
  explicit CriticalDepths(GainOnCircle gain, Eigenvalues of_large = Eigenvalues::reached);

  /// An eigenvalue ν(θ) of −Z, and how it came there.
  struct Path {
    std::complex<double> nu;
    std::complex<double> slope = 0.0;           ///< over the last step, rad⁻¹
    std::complex<double> slope_of_depth = 0.0;  ///< that of 1/ν, m/rad
    bool slope_known = false;
  };

  /// Below this depth, m, hardly any crossing lies: 1/max |ν| over the stops, less a quarter for what lies between
  /// them. Where a search may begin; up_to() finds what lies below all the same. Throws NumericalError if Z is not
  /// finite. Cost: Z at every stop and two products, once.
  [[nodiscard]] double none_below_m();

  /// Depths from 0 to depth_limit_m (> 0), ascending. Throws NumericalError if Z is not finite or an eigen-solution
  /// fails. Cost: Z at every stop, and an eigenvalue problem of its size at those that matter.
  [[nodiscard]] std::vector<Crossing> up_to(double depth_limit_m);

  /// An eigenvalue near the real axis.
  struct NearAxis {
    double theta_rad = 0.0;
    std::complex<double> nu;
  };

  /// The eigenvalues with 1/Re ν < depth_m, at most twice as deep as up_to() was asked for, and |Im ν| of at most that
  /// share of Re ν, at all angles that up_to() has looked at so far. Between two of these a path may come nearer: steps
  /// are halved only where one could cross the axis. Cost: that of reading them.
  [[nodiscard]] std::vector<NearAxis> near_axis(double depth_m, double share) const;

 private:
  struct Stop {
    Eigen::MatrixXcd Z;
    double norm = 0.0;            ///< of Z, no less than any eigenvalue's modulus
    std::optional<double> bound;  ///< of these moduli, sharper; none as long as it was not needed
    Eigen::VectorXcd nu;          ///< of −Z, those above `known_above`
    double known_above = INFINITY;
  };

  Stop& at(double theta_rad);
  static double bound_of(Stop& stop);
  [[nodiscard]] bool finds_largest_only(const Stop& stop) const;
  [[nodiscard]] bool reaches(Stop& stop, double smallest) const;
  void find_above(Stop& stop, double theta_rad, double smallest);
  /// Eigenvalues of −Z that a depth within twice the limit can reach.
  std::vector<Path> reached_at(double theta_rad, double depth_limit_m);
  void between(double from_rad, const std::vector<Path>& from, double to_rad, std::vector<Path>& to, int halvings,
               double depth_limit_m);

  GainOnCircle gain_;
  Eigenvalues of_large_;
  Eigen::Index steps_ = 0;        ///< that the largest eigenvalues of the last stop have taken
  std::map<double, Stop> stops_;  ///< by angle
  std::vector<Crossing> found_;
};

/// The least depth, m, at which a multiplier is −1 or +1: 1/ν of the largest real eigenvalue ν of −Z at the ends of the
/// half circle; infinite if none is positive. Unlike a search it follows nothing, so that it serves to check one.
/// Throws NumericalError if an eigen-solution fails. Cost: Z and its eigenvalues at two angles.
[[nodiscard]] double least_real_depth_m(const GainOnCircle& gain);

/// Stops that Z needs with poles whose flow over a period is `flow` (e^{λT}): steps of at most 0.35 rad, and of 0.6 of
/// the distance to the nearest.
[[nodiscard]] std::vector<double> stops_between(const Eigen::VectorXcd& flow);

}  // namespace thinwall::milling
