#pragma once
// The teeth of a cut on the steps of a simulation: which points of which edges cut at each node, and whose surface they
// meet.

#include <vector>

#include "milling/cut/process.hpp"

namespace thinwall::milling {

/// The fineness of a simulation.
struct StepOptions {
  int steps_in_cut = 200;  ///< ≥ 4: of a tooth from its entry to its exit
  int discs = 12;          ///< ≥ 1: Gauss points over each piece of the edge, where height matters; else there is one
};

/// Every violation, empty if there is none.
[[nodiscard]] std::vector<std::string> validate(const StepOptions& options);

/// A disc of the cutter: a Gauss point over the height of its edges, and its share of them.
struct Disc {
  double height_m = 0.0;
  double sin_kappa = 1.0, cos_kappa = 0.0;
  double width_m = 0.0;   ///< its share of the width of cut b
  double radius_m = 0.0;  ///< lever of the torque
};

/// The discs of a cutter at a depth, from the tip up: one where height does not matter. Throws InputError if the depth
/// exceeds the height of the edges.
[[nodiscard]] std::vector<Disc> discs_of(const MillingProcess& process, double depth_m, const StepOptions& options);

/// The part of a surface on which a point of an edge lies: `weight` times what the point `point` has left.
struct PastSurface {
  int point = 0;
  double weight = 1.0;
};

/// A disc of a tooth in the cut at a node. Its angle is φ, as in ToolFrame.
struct CutPoint {
  double sine = 0.0, cosine = 0.0;  ///< of φ
  double feed_chip_m = 0.0;         ///< f sin κ sin φ: the feed since the tooth ahead was there, along the normal
  double runout_m = 0.0;            ///< of the tooth, along the normal
  double edge_share = 1.0;          ///< length of edge over width of cut, dS/db
  int disc = 0;
  int tooth = 0;
  bool at_rim = false;            ///< where the disc enters or leaves: neither in contact nor without
  int first_past = 0, pasts = 1;  ///< of MarchGrid::pasts; of several, the first two lie on either side of the moment
};

/// Steps of equal length between moments at which a disc of a tooth enters or leaves the cut. A step has three nodes:
/// its start, its middle and its end, which is the start of the next one.
struct MarchStretch {
  double from_rad = 0.0;  ///< rotation since the period began
  double to_rad = 0.0;
  int steps = 0;
  int first_node = 0;  ///< of 2 steps + 1
};

/// The rotation at which the tip of a tooth enters an arc of the cut, and at which it leaves it, rad since the period
/// began: an entry from 0 to below the period, an exit above 0 to the period.
struct TipPass {
  int tooth = 0;
  double entry_rad = 0.0;
  double exit_rad = 0.0;
  double entry_phi_rad = 0.0;  ///< the angle φ at which the arc begins
  double arc_rad = 0.0;
};

/// One period of the cut, after which it repeats itself: a pitch where all teeth leave one surface, else a turn. It
/// begins when the tip of the first tooth enters the first arc.
struct MarchGrid {
  double period_rad = 0.0;
  int periods_a_turn = 1;
  std::vector<Disc> discs;
  std::vector<MarchStretch> stretches;
  std::vector<int> first_point;  ///< of each node, and one more entry for the end
  std::vector<CutPoint> points;
  std::vector<PastSurface> pasts;
  std::vector<TipPass> tips;

  /// Nodes of all stretches.
  [[nodiscard]] int nodes() const { return static_cast<int>(first_point.size()) - 1; }
  /// Steps of all stretches.
  [[nodiscard]] int steps() const;
  /// Rotation at a node of a stretch, rad since the period began.
  [[nodiscard]] static double rotation_rad(const MarchStretch& stretch, int node);
};

/// Steps divide what lies between entries and exits, so that no jump of the force lies within a step. The surface that
/// a point meets was left by the tooth ahead at the same angle. With equal teeth, and with straight ones of which one
/// cuts at a time, that was at a node, and the delay is exact without interpolation; else it is the polynomial through
/// six nodes about that moment within its stretch, of a higher order than the steps. Stretches of unequal teeth end
/// where an entry or exit is felt again a pitch later, too (cut_stretches()). `feed_per_tooth_m` is the mean over the
/// teeth, along x_T. Throws InputError for a bad process or option, or a depth above the height of the edges. Cost
/// O(nodes teeth discs).
[[nodiscard]] MarchGrid march_grid(const MillingProcess& process, double depth_m, double feed_per_tooth_m,
                                   const StepOptions& options);

}  // namespace thinwall::milling
