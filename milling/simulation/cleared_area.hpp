#pragma once
// The area of the stock that teeth on their paths have cleared, by geometry: what the chips are held against.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "milling/simulation/centre_path.hpp"
#include "milling/simulation/path_march.hpp"
#include "milling/simulation/stock.hpp"

namespace thinwall::milling {

/// The cleared area of a cut along its path, mean over the discs. A line across the feed follows the tool at a distance
/// L, where the walls are finished. The area is that which the line has passed between the walls, and that ahead of it:
///
///     A(t) = ∫ (y₊ − y₋) dx + ½ ∮ (ρ² − ρ₀²) dφ
///
/// y± where the line meets the walls; ρ the distance from the centre up to the material or that line, ρ₀ to where the
/// ray enters the stock (docs/theory/time-domain.md, Eq. 5). Both are looked for in the paths of earlier teeth, so that
/// chips have no part in them. The memory does not grow.
class ClearedArea {
 public:
  /// Keeps a reference to the cut. The path will be remembered for its earlier passes.
  ClearedArea(const PathCut& cut, Stock stock);

  /// The newest node of a path.
  struct Moment {
    long node = 0;
    Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< of the tool, m
    double reach_m = 0.0;                              ///< half of how far apart vibration has moved it lately
  };

  /// Takes in the walls that the line passes in a step; they are looked at 12 times a turn.
  void pass(const CentrePath& path, const Moment& now);

  /// A since the simulation began, up to a constant, m². None where passes of such a vibration may still reach the
  /// walls behind the line. Cost: 720 rays a disc, each meets some of the earlier passes.
  [[nodiscard]] std::optional<double> area_m2(const CentrePath& path, const Moment& now) const;

 private:
  /// A disc's height, and the discs of all teeth there.
  struct Slice {
    double share = 0.0;  ///< of the width of cut
    std::vector<const ToothDisc*> discs;
  };

  [[nodiscard]] double rotation_rad(long node) const;
  [[nodiscard]] double line_m(long node) const;
  [[nodiscard]] double farthest_m(const CentrePath& path, const Moment& now, const Slice& slice,
                                  const Eigen::Vector2d& from, double before_m, double phi_rad) const;
  [[nodiscard]] double between_walls_m(const CentrePath& path, const Moment& now, const Slice& slice) const;
  [[nodiscard]] double since_look_m2(const CentrePath& path, const Moment& now) const;
  [[nodiscard]] double ahead_m2(const CentrePath& path, const Moment& now, const Slice& slice) const;

  const PathCut& cut_;
  Stock stock_;
  std::vector<Slice> slices_;
  double behind_m_ = 0.0;  ///< L
  long nodes_a_look_ = 1, looked_at_ = 0;
  double passed_m2_ = 0.0;
};

}  // namespace thinwall::milling
