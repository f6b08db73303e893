#pragma once
// One edge between two of its heights: the sum of what its points do.

#include <Eigen/Core>
#include <vector>

#include "milling/cut/process.hpp"

namespace thinwall::milling {

/// The edges of a cutter up to a depth, heights as shares of the depth.
struct EdgeShape {
  std::vector<MeridianPiece> pieces;  ///< from 0 to 1
  double depth_m = 0.0;               ///< what a share of 1 stands for

  /// 0, the joints between pieces, 1.
  [[nodiscard]] std::vector<double> joints() const;
};

/// `depth_m` matters unless the envelope is straight. Throws InputError if the depth exceeds the height of the edges,
/// or is 0 where it matters.
[[nodiscard]] EdgeShape edge_shape(const Cutter& cutter, double depth_m);

/// The weight of a point of the edge in the mean over the depth.
struct EdgeWeight {
  double height = 0.0;  ///< share of the depth
  double kappa_rad = 0.0;
  double weight = 0.0;  ///< db/w
};

/// ∫ D db/w, N/m²: of the edge between the heights `low` and `high` (shares of the depth), whose tip stands at
/// `tip_rad` and which lags behind it by `lag_rad` at the depth. In closed form where the envelope is straight, by
/// Gauss's rule to 1e-10 on its arc.
[[nodiscard]] Eigen::Matrix3d edge_matrix(const EdgeShape& shape, const CuttingCoefficients& coefficients,
                                          double tip_rad, double lag_rad, double low, double high);

/// Points for a sum in place of that integral, where more than D changes along the edge: `points` of Gauss's a piece.
[[nodiscard]] std::vector<EdgeWeight> edge_weights(const EdgeShape& shape, int points, double low, double high);

/// The mean of an edge's ∫ D db/w over an arc and over the teeth, N/m²: z arc/2π times it, summed over the arcs, is the
/// A_0 of the zeroth-order solution, with any helix.
[[nodiscard]] Eigen::Matrix3d arc_mean(const MillingProcess& process, const Engagement& arc, double depth_m);

}  // namespace thinwall::milling
