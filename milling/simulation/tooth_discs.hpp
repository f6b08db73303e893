#pragma once
// The teeth of a cutter in discs, for paths that are followed in the plane of the cut.

#include <vector>

#include "milling/cut/process.hpp"
#include "milling/simulation/march_grid.hpp"

namespace thinwall::milling {

/// An earlier pass of a tooth, whose surface a tooth may meet.
struct EarlierTooth {
  double ahead_rad = 0.0;
  double radius_m = 0.0;
};

/// A disc of a tooth.
struct ToothDisc {
  int tooth = 0;
  int slice = 0;            ///< its height among those of discs_of()
  double behind_rad = 0.0;  ///< by which it follows the tip of the first tooth
  double radius_m = 0.0;
  double width_m = 0.0;
  double edge_share = 1.0;            ///< length of edge over width of cut
  double largest_radius_m = 0.0;      ///< of all teeth
  std::vector<EarlierTooth> earlier;  ///< nearest first
};

/// The discs of all teeth at a depth, each with that many passes of teeth before it. Sides of cylinders only: throws
/// InputError for another envelope, and as discs_of().
[[nodiscard]] std::vector<ToothDisc> tooth_discs(const MillingProcess& process, double depth_m,
                                                 const StepOptions& options, int earlier_passes);

/// The width of cut of all discs of a tooth, m.
[[nodiscard]] double width_of_cut(const std::vector<ToothDisc>& discs, const Cutter& cutter);

/// The passes of all tips through the arc of the cut within a turn that begins when the first tooth enters it.
[[nodiscard]] std::vector<TipPass> tips_of_turn(const MillingProcess& process);

}  // namespace thinwall::milling
