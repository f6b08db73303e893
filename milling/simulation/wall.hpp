#pragma once
// The wall that the teeth of a simulated cut leave: its place and its roughness.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "milling/cut/process.hpp"
#include "milling/simulation/march_grid.hpp"
#include "milling/simulation/march_step.hpp"

namespace thinwall::milling {

/// The turns and heights at which a wall is recorded.
struct WallOptions {
  int turns = 0;                          ///< the last of the recorded turns, at least 4; 0: no wall
  std::vector<double> heights_m = {0.0};  ///< from the tip up, within the depth
  double cutoff_m = 0.0;                  ///< of filtered(); 0: none
};

/// The rotation of a tooth from its entry into an arc up to where it points along the normal of the wall on a side, +1:
/// φ = 0, −1: φ = π; none where it leaves the arc before.
[[nodiscard]] std::optional<double> rotation_to_wall(const Engagement& arc, int side);

/// The least length of the walls that these turns leave, m, whose ends are not known; a filter needs twice its cutoff.
[[nodiscard]] double recorded_length_m(const WallOptions& options, double feed_a_turn_m);

/// The tip of a tooth while it passes the wall at a height.
struct TipPath {
  int height = 0;       ///< index into WallOptions::heights_m
  Eigen::VectorXd x_m;  ///< along the feed, ascending, from a fixed place
  Eigen::VectorXd e_m;  ///< beyond the place of the wall that a rigid tool without runout leaves: positive, into it
};

/// The wall at a height. Errors are positive where too much is taken, as those of surface_error.hpp.
struct Wall {
  int side = 1;  ///< +1: the wall on the +y_T side, −1: the other
  double height_m = 0.0;
  Eigen::VectorXd x_m;      ///< along the feed, equal steps
  Eigen::VectorXd error_m;  ///< of the deepest tip at each place
  double mean_m = 0.0;      ///< location error of the mean line
  double deepest_m = 0.0;   ///< the largest error
  double highest_m = 0.0;   ///< the least error: the top of the highest cusp, found between the steps
  double R_a_m = 0.0;       ///< mean distance from the mean line
  double R_q_m = 0.0;       ///< its root mean square
  double R_t_m = 0.0;       ///< highest peak to lowest valley
};

/// Sets the mean, R_a, R_q and R_t of a wall from its errors.
void set_roughness(Wall& wall);

/// Follows the tips of the teeth by the walls: an observer of the march. A tooth leaves the wall where it points along
/// its normal, at φ = 0 on the +y_T side and φ = π on the other; with a helix every height at a moment of its own.
/// Paths reach 0.3 rad and the feed of a turn to either side, because a tip that moves along the normal by v_n is
/// deepest v_n/(R Ω) before or after, and one that is deeper than its neighbours by Δ takes more than they √(2RΔ) away.
class WallRecorder {
 public:
  /// `feed_m_per_rad`: v_f/Ω.
  WallRecorder(const MillingProcess& process, double feed_m_per_rad, const std::vector<TipPass>& tips,
               double period_rad, const WallOptions& options);

  /// The period to be marched next begins at this rotation since the record began, below 0 before.
  void begin_period(double recorded_rad);
  /// Takes a step in.
  void operator()(const MarchStep& step);
  /// The walls that the paths leave: none where no arc reaches a wall, two in a slot; one a height, of
  /// 200 points a turn, and filtered if that is asked. At either end a turn is left out, or as much as a pass that was
  /// not recorded may reach, √(2RΔ) with Δ from the shallowest to the deepest of the turns. None where the vibration
  /// is so large that a tip turns back along the feed, that no recorded tip passes some place, or that less is left
  /// than a turn, or than the filter takes.
  [[nodiscard]] std::vector<Wall> walls() const;

 private:
  /// A sample of a tip path, at a rotation of every period.
  struct Sample {
    double rotation_rad = 0.0;
    int path = 0;   ///< index into `open_`
    int place = 0;  ///< of the samples of a pass
  };
  /// A tooth at a height by a wall, between its first and its last sample.
  struct OpenPath {
    int side = 1;
    double radius_m = 0.0;
    bool begun = false;
    TipPath path;
  };

  /// Passes of a wall at a height in a turn.
  [[nodiscard]] std::size_t passes_a_turn(int side, int height) const;

  double radius_m_;  ///< without runout
  double feed_m_per_rad_;
  double feed_a_turn_m_;
  long periods_a_turn_;
  WallOptions options_;
  std::vector<Sample> samples_;  ///< by rotation
  std::vector<double> offset_rad_;
  std::vector<OpenPath> open_;
  std::vector<std::pair<int, TipPath>> done_;  ///< side and path
  std::size_t next_ = 0;
  double recorded_rad_ = -1.0;
};

/// R_a, R_q and R_t after the long waves were taken out by a Gaussian filter of ISO 16610-21 with this cutoff, m; the
/// profile loses a cutoff at either end. Throws InputError if nothing is left.
[[nodiscard]] Wall filtered(const Wall& wall, double cutoff_m);

}  // namespace thinwall::milling
