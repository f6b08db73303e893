#pragma once
// The modes of a part that comes as a closed surface, to a tolerance: sizes from its walls, order and level as needed.

#include <string>
#include <vector>

#include "fem/to_tolerance.hpp"
#include "mesh/confined.hpp"
#include "mesh/faceted_surface.hpp"

namespace thinwall::fem {

/// Of a tolerance on frequencies, what is for the volume of the mesh against the surface's.
inline constexpr double share_of_surface = 0.2;

/// Of refine_closed_part().
struct ClosedPartOptions {
  /// On frequencies, relative, 1e-3 to 0.1. share_of_surface of it is for the surface, which the elements follow with
  /// straight edges, the rest for the elements.
  double tolerance = 1e-2;
  ModeOptions modes{.count = 5, .up_to_hz = {}, .verify_count = false};
  std::vector<Support> supports;   ///< none: a free part
  std::vector<NamedPoint> points;  ///< where receptances count
  bool points_hold = false;        ///< as ToleranceOptions has it
  Attachments attachments{};
  std::function<Materials(const mesh::TetMesh&)> materials{};  ///< of a part of several, on each mesh
  std::function<mesh::TetMesh(mesh::TetMesh)> divided{};       ///< each mesh, before it is used; none: as it is
  int first_order = 3;                                         ///< of a level; 1 to 5
  int last_order = 6;                                          ///< of a level; above first_order, to 6
  int levels = 1;  ///< of ever smaller and more graded elements, 1 to 4; each has five times as many
  std::int64_t largest_dofs = 400000;  ///< no model with more is solved; 0: no bound
  double memory_limit_bytes = 0.0;     ///< of a factor; 0: none
  /// Of each attempt of a mesher. TetGen takes a second or never ends.
  mesh::ProcessLimits limits{.time_s = 20.0, .memory_bytes = 4e9};
};

/// How the elements lie to the surface of one level.
struct SurfaceFit {
  int level = 0;
  std::string mesher;                  ///< "TetGen" or "CGAL"
  double volume_error_relative = 0.0;  ///< of the elements against the surface
  double surface_distance_m = 0.0;     ///< two-sided, sampled
  std::vector<std::string> failures;   ///< a line for each attempt that failed before
};

/// What was found, and how far it may be off.
struct [[nodiscard]] ClosedPart {
  Refined refined;
  std::vector<SurfaceFit> fits;  ///< of the levels that were meshed; the last but those held back was solved
  /// Elements (refined.estimate) and surface: a wall that is thinner by a share of its volume bends at frequencies
  /// lower by the same share.
  double frequency_error = 0.0;
  bool met = false;  ///< frequency_error and the elements' error of receptances ≤ tolerance; if not, refined.estimate
                     ///< says whether largest_dofs was in the way
};

/// A part whose mesh(level) is mesh::mesh_closed_surface with edges of 9 wall thicknesses (one element through the
/// wall) divided by 1.5^level, `level` graded layers beside sharp edges (one more where a support ends within a face)
/// and a turning of 0.5 / 2^level along an edge, finer where the volume asks for it (0.2 · tolerance). Where
/// a finer level cannot be meshed, elements of the first level made 0.7 times as large take its place. Each mesh's fit
/// is appended to `fits`, which must outlive the part, as must surface and options.
[[nodiscard]] SolidPart solid_part(const mesh::TriangleSurface& surface, const Material& material,
                                   const ClosedPartOptions& options, std::vector<SurfaceFit>& fits);

/// True if two faces meet at a sharp edge that turns inwards by more than 30°.
[[nodiscard]] bool has_reentrant_edge(const mesh::TriangleSurface& surface);

/// Meshes, solves and refines (refine_to_tolerance) until the tolerance is met, or levels or degrees of freedom run
/// out. Throws InputError for options out of range, a surface that is not closed (mesh::require_closed; mend it with
/// mesh::repaired_surface) or a part whose coarsest mesh exceeds largest_dofs; NumericalError if no mesher fills the
/// surface; Interrupted.
ClosedPart refine_closed_part(const mesh::TriangleSurface& surface, const Material& material,
                              const ClosedPartOptions& options = {});

}  // namespace thinwall::fem
