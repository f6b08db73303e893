#pragma once
// Order and element size from a tolerance: an hp hierarchy that ends when its own estimate says so.

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "fem/modes.hpp"
#include "fem/points.hpp"
#include "fem/supports.hpp"

namespace thinwall::fem {

/// What is to be solved. `mesh(level)` makes meshes with more and smaller elements as the level rises from 0; `shape`
/// moves their nodes onto a curved part, or is empty.
struct SolidPart {
  std::function<mesh::TetMesh(int level)> mesh;
  Shaping shape;
  Material material;
  std::vector<Support> supports;
  Attachments attachments{};
  std::function<Materials(const mesh::TetMesh&)>
      materials{};  ///< of a part of several, on each mesh; instead of material
};

/// Of refine_to_tolerance().
struct ToleranceOptions {
  double tolerance = 1e-3;  ///< on frequencies and receptances, relative; 1e-6 to 0.1
  ModeOptions modes;
  std::vector<NamedPoint> points;  ///< where receptances count
  bool points_hold = false;        ///< whether the points must see what rigid motions there are (require_motions_seen)
  int first_order = 4;             ///< of a level; 1 to 5
  int last_order = 6;              ///< of a level; above first_order, to 6
  int levels = 4;
  bool reentrant_edges = false;     ///< whether an edge of the part turns inwards: errors fall more slowly then
  double memory_limit_bytes = 0.0;  ///< of a factor; 0: none
  std::int64_t largest_dofs = 0;    ///< no model with more rows than this before supports is solved; 0: no bound
};

/// One solution on the way: its size, and how far the one before it on the same mesh was from it.
struct RefinementStep {
  int level = 0;
  int order = 0;
  Eigen::Index dofs = 0;
  std::optional<double> frequency_change;   ///< largest relative; none for the first order of a level
  std::optional<double> receptance_change;  ///< likewise; none without points
};

/// How wrong the solution may be. Two orders p and p + 1 on one mesh differ by d; if the higher leaves the part r of
/// the lower's error, the lower is wrong by d / (1 − r) and the higher by r d / (1 − r). r = 1/2: with elements graded
/// to all edges an order leaves less (docs/theory/elements.md). Beside an edge that turns inwards, where the elements
/// across a rib are as wide as it is thick, the error falls as p^−4λ with λ = 0.544, the exponent of a 270° edge
/// (Babuska & Suri 1994; Williams 1952): r = (p / (p + 1))^4λ, 0.61 from order 4 to 5,
/// and no less than 1/2 at low orders, of which the law says nothing.
struct Estimate {
  double frequency = 0.0;   ///< largest relative error
  double receptance = 0.0;  ///< largest error over the sum of the modes' magnitudes at its frequency; 0 without points
  double tolerance = 0.0;
  bool met = false;        ///< false: all levels were used, or the next solution would exceed largest_dofs
  bool held_back = false;  ///< ended by largest_dofs
  std::vector<RefinementStep> steps;
};

/// The cheaper solution that meets the tolerance: the lower of the last two orders if its estimate does, else the
/// higher.
struct [[nodiscard]] Refined {
  Model model;
  Factored factored;
  Modes modes;
  Estimate estimate;
};

/// Raises the order on a mesh from first_order, whose modes are made from those of the next order (modes_near) to a
/// hundredth of the tolerance, and found anew if they are returned; where the estimate is still above the tolerance at
/// last_order, or too far above for an order to help, goes to the next level (Babuska & Guo 1992: exponential
/// convergence with elements graded to edges and rising order). Receptances between the points are compared at zero (or
/// at the shift of a free part) and between resonances that lie more than a quarter apart; nearer to a resonance they
/// magnify the error of its frequency. Throws InputError for options out of range and for largest_dofs below what the
/// first two orders of the first level have, points that do not see what they must, and what the steps throw. Cost:
/// that of the last step, and about a third more for those before.
Refined refine_to_tolerance(const SolidPart& part, const ToleranceOptions& options);

}  // namespace thinwall::fem
