#pragma once
// The record of a simulated motion: extremes, means, samples once a tooth, a trace.

#include <Eigen/Core>
#include <deque>
#include <optional>
#include <vector>

#include "milling/simulation/march_grid.hpp"
#include "milling/simulation/march_step.hpp"
#include "milling/simulation/simulation.hpp"

namespace thinwall::milling {

/// The size of a motion, which its differences are held against: the largest range along an axis, and a millionth of
/// the farthest place at least, for the range of a steady motion is round-off. NaN where nothing was taken in.
[[nodiscard]] double size_of_motion(const Extremes& displacement_m);

/// Sums over the recorded periods: an observer of the march, which calls it with every step.
class Record {
 public:
  /// `tips` are those of a period of the march. Where they are `alike`, one arc of teeth that leave one surface, each
  /// of their entries begins a period of the cut; else that of the first alone. `result` receives extremes and trace at
  /// once, the rest at finish().
  Record(const std::vector<TipPass>& tips, bool alike, double rad_per_s, const SimulationOptions& options,
         SimulatedCut& result);

  /// The period to be marched next begins at this time; `traced_rad`: rotation since the trace began, below 0 before.
  void begin_period(double time_s, double traced_rad);
  /// Takes a step in. No allocation but of the passes that are kept.
  void operator()(const MarchStep& step);
  /// The area that chips have taken in the recorded steps so far, m², mean over depth; of exact paths.
  [[nodiscard]] double removed_m2() const { return removed_; }
  /// Means over the recorded rotation, the passes, and the kind of the motion.
  void finish(double recorded_rad);

 private:
  void take_trace(const MarchStep& step);
  void take_contact(const MarchStep& step, ContactOutcome& contact);
  void take_mean(const MarchStep& step, const Eigen::Vector3d& integral);
  void take_passes(const MarchStep& step);

  std::vector<TipPass> tips_;
  bool alike_;
  double rad_per_s_;
  double sample_rad_;
  std::size_t kept_;
  SimulatedCut& result_;
  std::vector<std::optional<ToothPass>> open_;  ///< of each of the tips, between entry and exit
  std::deque<ToothPass> passes_;
  std::deque<Eigen::Matrix<double, 6, 1>> samples_;  ///< displacement and slope, m/rad, once a period of the cut
  Eigen::Index next_sample_ = 0;
  double period_start_s_ = 0.0, traced_rad_ = -1.0;
  double part_rad_ = 0.0, recorded_rad_ = 0.0;  ///< of a mean, and of the steps so far
  Eigen::VectorXd of_part_rad_;                 ///< rotation that each mean has taken in
  Eigen::Vector3d impulse_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d displaced_ = Eigen::Vector3d::Zero();
  double work_ = 0.0, removed_ = 0.0, within_ = 0.0, without_contact_ = 0.0, open_rad_ = 0.0;
};

}  // namespace thinwall::milling
