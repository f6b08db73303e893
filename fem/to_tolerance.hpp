#pragma once
// Choice of element order and size from a tolerance: an hp hierarchy that ends when its own error estimate meets the
// tolerance.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fem/modes.hpp"
#include "fem/points.hpp"
#include "fem/supports.hpp"

namespace thinwall::fem {

/// The part to be solved. `mesh(level)` makes meshes with more and smaller elements as the level rises from 0; `shape`
/// moves their nodes onto a curved part, or is empty.
struct SolidPart {
  std::function<mesh::TetMesh(int level)> mesh;
  Shaping shape;
  Material material;
  std::vector<Support> supports;
  Attachments attachments{};
  std::function<Materials(const mesh::TetMesh&)> materials{};  ///< used instead of material, if set
  std::function<Shaping(const mesh::TetMesh&)> shaping{};      ///< used instead of shape, if set
  std::function<double(const Model&)> shape_error{};           ///< of a model's frequencies, relative, by its shape
  /// True for a mesh with rows of narrow elements at all sharp edges, where errors fall faster at first; or empty.
  std::function<bool(const mesh::TetMesh&)> has_rows{};
};

/// One solution on the way: its size, and its difference from the one before it on the same mesh.
struct RefinementStep {
  int level = 0;
  int order = 0;
  Eigen::Index dofs = 0;
  std::optional<double> frequency_change;   ///< largest relative; none for the first order of a level
  std::optional<double> receptance_change;  ///< likewise, by the largest magnitude of all entries; none without points
  std::optional<double> entry_change{};     ///< largest change of an entry by its own magnitude; none without points
  std::string worst_receptance{};           ///< name of that entry, "P.x" or "P.x to Q.z"
};

/// Options of refine_to_tolerance().
struct ToleranceOptions {
  double tolerance = 1e-3;  ///< relative, on frequencies and receptances; 1e-6 to 0.1
  ModeOptions modes;
  std::vector<NamedPoint> points{};  ///< points between which receptances must meet the tolerance
  bool points_hold = false;          ///< true if the points must determine all rigid motions
  int first_order = 4;               ///< first order of a level; 1 to 5
  int last_order = 6;                ///< last order of a level; above first_order, to 6
  int levels = 4;
  bool reentrant_edges = false;  ///< true if the part has a re-entrant edge, beside which errors fall more slowly
  double untold_ratio = 0.5;  ///< of the errors of successive orders, at least, before two changes show it; 0.5 to 0.9
  double memory_limit_bytes = 0.0;  ///< limit for a factor; 0: the memory that is left
  std::int64_t largest_dofs = 0;    ///< no model with more rows than this before supports is solved; 0: no bound
  std::int64_t first_dofs =
      0;                       ///< first_order is lowered, to 1 at least, until the next one has no more rows; 0: never
  double time_budget_s = 0.0;  ///< wall time after which nothing more is solved than the first two orders; 0: none
  std::function<void(const RefinementStep&)> solved{};  ///< is told of each solution as soon as it is known, if set
};

/// The estimated error of a solution (docs/theory/elements.md, Eq. 3-4). Two orders p and p + 1 on one mesh differ by
/// d. If the error of the higher is r times that of the lower, the error of the lower is d / (1 − r) and that of the
/// higher r d / (1 − r). At an edge of exponent λ where the elements are not graded from all sides the error falls as
/// (p+½)^−4λ (Babuska & Suri 1994): r = ((p+½)/(p+3/2))^4λ. Frequencies take λ of the edges of clamps
/// (clamped_edge_exponent()): 0.57 from order 4 to 5 and 0.62 from 5 to 6 for steel. Beside a re-entrant edge λ is
/// 0.544 for receptances too: 0.65 and 0.70, or less where the last two changes on one mesh show a smooth share of the
/// error, which falls by thirty an order. Otherwise, and at least, r = 1/2, because the law does not hold at low
/// orders; with elements graded to all edges r is smaller. Where the last two changes on one mesh have a larger ratio,
/// that one is taken, up to 0.9.
struct Estimate {
  double frequency = 0.0;          ///< largest relative error, that of SolidPart::shape_error included
  double receptance = 0.0;         ///< largest error of a receptance by the largest magnitude; 0 without points
  double entry = 0.0;              ///< largest error of a receptance by its own magnitude; held to no tolerance
  std::string worst_receptance{};  ///< name of the receptance of that error, "P.x" or "P.x to Q.z"
  double tolerance = 0.0;          ///< 0: none was asked for
  bool met = false;                ///< false if all levels were used, or the refinement was held back
  /// The reason that ended the refinement before the tolerance was met or all levels were used, as the end of a
  /// sentence: "the time_budget of 24 s was over"; otherwise empty.
  std::string held_back_by{};
  /// The error to which all levels would have come at best, where the refinement was ended because that is more than
  /// twice the tolerance; otherwise 0.
  double within_reach = 0.0;
  std::vector<RefinementStep> steps;
};

/// The cheapest solution that meets the tolerance: the lower of the last two orders if its estimate does, else the
/// higher.
struct [[nodiscard]] Refined {
  Model model;
  Factored factored;
  Modes modes;
  Estimate estimate;
  int level = 0;  ///< level of its mesh; not the last one of the steps where that one's error is larger
};

/// The lower of the first two orders that refine_to_tolerance() solves on the coarsest mesh: options.first_order, or,
/// if options.first_dofs is not 0, the highest order below it, 1 at least, for which the next one has no more rows than
/// first_dofs and largest_dofs. Where modes are wanted up to a frequency, only largest_dofs lowers it, for low orders
/// may have no mode below that frequency.
[[nodiscard]] int first_order_on(const mesh::TetMesh& mesh, const ToleranceOptions& options);

/// Throws InputError if the first two orders on the coarsest mesh, from first_order_on() on, exceed
/// options.largest_dofs.
void require_fit(const mesh::TetMesh& mesh, const ToleranceOptions& options);

/// The inverse residual of modes with which frequencies that need keep a tolerance are right to 1e-4 of it: 0.01
/// √tolerance, for their error is its square.
[[nodiscard]] double enough_for_frequencies(double tolerance);

/// Solves a part to a tolerance. The order is raised on a mesh, beginning with first_order. The modes of first_order
/// are found from those of the next order, with frequencies to a hundredth of the tolerance, and anew if they are
/// returned; those of a raised order from the order before, where options.modes asks for few digits
/// (enough_for_frequencies()). If the estimate is still above the tolerance at last_order, or too far above it for the
/// orders left to help, the next level is taken (Babuska & Guo 1992: convergence is exponential with elements graded to
/// edges and rising order). It is not if it would be in vain: the changes of one order on two successive levels have
/// the ratio q, at most 1, and an error e is at best e q²ⁿ after the n levels left, for convergence may become faster;
/// more than twice the tolerance ends the refinement. Orders are judged likewise beside re-entrant edges, by the ratio
/// of two successive changes on one mesh; those up to first_order + 1 are taken in any case where they were lowered,
/// and no further ones for an error that is mostly that of the shape and above the tolerance. A solution after the
/// first two that fails, for memory, for time_budget_s or for its mesh, ends the refinement, too; the result is the
/// solution of the least estimated error. Receptances between the points are compared entry by entry, relative to the
/// largest √(B_ii B_jj), which is held to the tolerance, and relative to each entry's own, where B_ii is the sum of the
/// magnitudes of all modes' contributions to the direct receptance; at zero (or at the shift of a free part) and midway
/// between resonances more than a quarter apart, for nearer to a resonance the error of its frequency would be
/// magnified. Throws InputError for options out of range, for largest_dofs below the size of the first two orders on
/// the first level, for points that do not determine the rigid motions although they must, what the first two solutions
/// throw, and Interrupted. Cost: that of the last step, and about a third more for those before.
Refined refine_to_tolerance(const SolidPart& part, const ToleranceOptions& options);

/// The estimated error of a solution on a mesh that is given, by the one of the next order: d / (1 − r), with r by the
/// exponent of a re-entrant edge where options.reentrant_edges says that there may be one (docs/theory/elements.md, Eq.
/// 3). `higher`: the same part on the same mesh, one order higher. Of the options it takes the modes, the points,
/// reentrant_edges and the limit of memory. Throws linalg::MemoryLimitError where the higher factor would exceed that
/// limit, and as modes(). Cost: that of the higher solution, which takes about three times the unknowns at order 2.
[[nodiscard]] Estimate estimate_by_next_order(const Model& model, const Factored& factored, const Modes& modes,
                                              const Model& higher, const ToleranceOptions& options);

}  // namespace thinwall::fem
