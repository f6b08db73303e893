#pragma once
// The modes, to a tolerance, of a part that is given as a closed surface: element sizes follow from its wall thickness,
// order and level of refinement are raised as needed.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "fem/curved_boundary.hpp"
#include "fem/to_tolerance.hpp"
#include "mesh/confined.hpp"
#include "mesh/faceted_surface.hpp"

namespace thinwall::fem {

/// The share of the tolerance on frequencies by which the volume of straight elements may differ from the surface's.
inline constexpr double share_of_surface = 0.2;

/// The fit of the elements to the surface at one level.
struct SurfaceFit {
  int level = 0;
  std::string mesher;                  ///< "TetGen" or "CGAL"
  double volume_error_relative = 0.0;  ///< volume of the elements relative to that of the surface, less 1
  double surface_distance_m = 0.0;     ///< distance between both, two-sided, at sampled points
  std::vector<std::string> failures;   ///< a message for each attempt that failed before
};

/// The mesh of a level, the first one among them.
struct FirstMesh {
  mesh::TetMesh mesh;
  SurfaceFit fit;
  std::shared_ptr<const CubicShape> shape{};  ///< of its elements; null if they are straight
  bool has_rows = false;                      ///< it has mesh::with_rows_at_edges()
};

/// Options of refine_closed_part().
struct ClosedPartOptions {
  /// Tolerance on frequencies, relative, 1e-3 to 0.1: on the sum of the error of the elements and the share of the
  /// volume by which they do not follow the surface.
  double tolerance = 1e-2;
  ModeOptions modes{.count = 5, .up_to_hz = {}};
  std::vector<Support> supports;   ///< empty for a free part
  std::vector<NamedPoint> points;  ///< points between which receptances must meet the tolerance
  bool points_hold = false;        ///< as in ToleranceOptions
  Attachments attachments{};
  std::function<Materials(const mesh::TetMesh&)> materials{};  ///< materials on each mesh, for a part of several
  std::function<mesh::TetMesh(mesh::TetMesh)> divided{};       ///< applied to each mesh before use, if set
  int first_order = 3;                                         ///< first order of a level; 1 to 5
  int last_order = 6;                                          ///< last order of a level; above first_order, to 6
  int levels = 1;                      ///< number of levels, 1 to 4; each has five times as many elements as the last
  double solid_volume_m3 = 0.0;        ///< for which the surface stands; 0: its own
  std::int64_t largest_dofs = 400000;  ///< no model with more is solved; 0: no bound
  std::int64_t first_dofs = 150000;    ///< as in ToleranceOptions, so that the first answer takes seconds
  double memory_limit_bytes = 0.0;     ///< limit for a factor; 0: the memory that is left
  double time_budget_s = 0.0;          ///< as in ToleranceOptions
  std::function<void(const RefinementStep&)> solved{};  ///< as in ToleranceOptions
  /// The mesh that first_mesh() has made of this surface by these options, which is then not made again; or empty.
  std::shared_ptr<const FirstMesh> first{};
  /// Limits of each attempt of a mesher. The time is short because TetGen either ends within seconds or not at all.
  mesh::ProcessLimits limits{.time_s = 20.0, .memory_bytes = 4e9};
};

/// The solution, and its estimated error.
struct [[nodiscard]] ClosedPart {
  Refined refined;
  std::vector<SurfaceFit> fits;  ///< one for each level meshed; not all need have been solved
  /// The estimated relative error of frequencies, that of refined.estimate, from the elements and the surface: a wall
  /// whose volume is too small by a share bends at frequencies lower by the same share.
  double frequency_error = 0.0;
  /// True if frequency_error and the estimated error of receptances are within the tolerance. If not, refined.estimate
  /// says what prevented it, if it is no lack of levels.
  bool met = false;
};

/// The part whose mesh(level) is mesh::mesh_closed_surface with edges of 9 wall thicknesses (one element through the
/// wall), on plane faces at least 0.15 bending waves of the highest of `count` modes where there are no layers, divided
/// by 1.5^level, `level` graded layers beside sharp edges (one more if a support ends within a face) and a turning
/// angle of 0.5 / 2^level rad along an edge. The first mesh of a part of plane faces has mesh::with_rows_at_edges() if
/// it has a re-entrant edge and order 4 then has at most 1.2 times the unknowns of order 6 without rows, unless more
/// than a tenth as many edges as are divided stay whole or a support ends within a face. Elements of a part of one
/// material follow curved patches of the surface by
/// their shape (curved_onto()): their chords may lie a fifth of the wall off it. Until the volume is right to 0.4 ·
/// tolerance, a body that is round rather than thin gets isotropic elements, and then chords are half as far off and
/// turn 0.7 times as far. Where no such mesh can be had, elements of 0.6 times the size are tried. Where that fails,
/// and with several materials, elements are straight, and the turning angle is as small as 0.2 · tolerance on the
/// volume requires; of a round body, and where these would be tens of thousands, or cannot be made or exceed
/// largest_dofs, the best curved mesh is taken, whose error the estimate tells. If a finer level cannot be meshed,
/// straight elements of the first level made 0.7^level times as large are used instead. Each mesh is appended to
/// `meshes`, which must outlive the part, as must `surface` and `options`.
[[nodiscard]] SolidPart solid_part(const mesh::TriangleSurface& surface, const Material& material,
                                   const ClosedPartOptions& options, std::vector<FirstMesh>& meshes);

/// True if two faces meet at a re-entrant edge, which turns inwards by more than 30°.
[[nodiscard]] bool has_reentrant_edge(const mesh::TriangleSurface& surface);

/// The first order that refine_closed_part() solves on its first mesh, first_order_on() by its options.
[[nodiscard]] int first_order_on(const mesh::TetMesh& mesh, const ClosedPartOptions& options);

/// The first mesh of refine_closed_part(), which solves nothing. Throws what that throws for options, surface and mesh.
[[nodiscard]] FirstMesh first_mesh(const mesh::TriangleSurface& surface, const ClosedPartOptions& options);

/// Meshes, solves and refines a part (refine_to_tolerance()) until the tolerance is met, or levels, degrees of freedom,
/// memory or time are exhausted; the best solution is the result. Throws InputError for options out of range, a surface
/// that is not closed (mesh::require_closed; repair it with mesh::repaired_surface) or a part whose coarsest mesh
/// exceeds largest_dofs; NumericalError if no mesher can fill the surface; Interrupted.
ClosedPart refine_closed_part(const mesh::TriangleSurface& surface, const Material& material,
                              const ClosedPartOptions& options = {});

}  // namespace thinwall::fem
