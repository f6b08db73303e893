#include "fem/closed_part.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "mesh/surface/closed_surface.hpp"
#include "mesh/surface/edge_uses.hpp"
#include "mesh/surface/smooth_patches.hpp"
#include "mesh/volume/beneath_curves.hpp"
#include "mesh/volume/edge_rows.hpp"
#include "mesh/volume/surface_to_volume.hpp"

namespace thinwall::fem {

namespace {

constexpr double coarsest_turn_rad = 0.5;
constexpr double smaller_per_level = 1.5;
constexpr double share_of_wave = 0.15;
constexpr double volume_of_chords = 0.08;         // by which straight elements may err that are curved afterwards
constexpr double deviation_of_chords = 0.2;       // of the wall thickness, likewise
constexpr double roundest = 1.4;                  // circumradius over shortest edge of elements that need not be flat
constexpr double size_of_round_parts = 0.8;       // of the mean wall thickness
constexpr double most_of_round_body = 4000.0;     // triangles
constexpr double most_of_rod = 6000.0;            // likewise, of bodies that are as thin across as along their surface
constexpr double largest_in_rod = 1.3;            // of the mean wall thickness
constexpr double smaller_if_none = 0.6;           // element size where no other attempt makes a mesh
constexpr double thinnest_plate = 0.75;           // mean over median thickness: 1 of a plate, 1/2 of a rod
constexpr double share_of_curves = 0.4;           // of the tolerance, by which the volume of curved elements may err
constexpr double most_off = 0.02;                 // by volume, of curved elements that are taken nevertheless
constexpr double most_straight = 30000.0;         // elements, about, beyond which they are
constexpr double sharp_rad = 0.5235987755982988;  // 30°
constexpr double most_for_rows = 1.2;             // unknowns with rows at order 4 over those without at order 6
constexpr double untold_ratio = 2.0 / 3.0;  // of errors of successive orders without layers, 0.63 to 0.75 in strips

void validate(const ClosedPartOptions& o) {
  if (!(o.tolerance >= 1e-3 && o.tolerance <= 0.1)) {
    throw core::InputError(
        "a tolerance of " + std::to_string(o.tolerance) +
        " for a part of a closed surface is outside 0.001 to 0.1: its elements follow the surface only so far");
  }
  if (o.levels < 1 || o.levels > 4)
    throw core::InputError("a closed surface was to be meshed at " + std::to_string(o.levels) + " levels; give 1 to 4");
  if (o.largest_dofs < 0) throw core::InputError("the bound on degrees of freedom is negative; give 0 for none");
}

/// True if the border of the support may lie within a face, where the surface has no edge to which the mesh is graded.
/// Only a support on a plane region surely ends at edges.
bool ends_within_a_face(const Support& support) {
  return !std::holds_alternative<mesh::PlaneRegion>(support.region);
}

/// About the length of a bending wave of the highest mode wanted, m. Of a plate of area A N modes have waves longer
/// than λ = (π A / N)^½ (Cremer, Heckl & Petersson 2005), and free edges lower their frequencies by 0.6; A is half of
/// the surface. 0 if modes are wanted up to a frequency.
double bending_wavelength(const mesh::TriangleSurface& surface, const ModeOptions& modes) {
  if (modes.up_to_hz) return 0.0;
  double area = 0.0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    area += 0.5 * mesh::area_vector(surface, static_cast<int>(t)).norm();
  return std::sqrt(std::numbers::pi * area / (0.6 * std::max(1, modes.count)));
}

/// The options of the mesher at a level, as solid_part() describes them.
mesh::SurfaceMeshOptions mesh_options(const mesh::TriangleSurface& surface, const ClosedPartOptions& options,
                                      int level) {
  mesh::SurfaceMeshOptions result;
  for (const Support& support : options.supports)
    if (ends_within_a_face(support)) result.size.refined.push_back(support.region);
  result.size.layers = std::min(4, level + (result.size.refined.empty() ? 0 : 1));
  if (result.size.layers == 0) result.size.least_plane_m = share_of_wave * bending_wavelength(surface, options.modes);
  result.size.scale = std::pow(smaller_per_level, -level);
  result.size.turn_rad = coarsest_turn_rad * std::pow(2.0, -level);
  result.volume_tolerance = share_of_surface * options.tolerance;
  result.limits = options.limits;
  return result;
}

/// The size of isotropic elements of a body that is round rather than thin, 0.8 times its mean wall thickness 2 V / A,
/// m; in rods to 1.3 times it, where there would be too many. Long elements between its sides would be spoilt when both
/// are curved. 0 for a body that would take too many. `median`: the wall thickness beneath half of the surface, m.
double size_of_round_body(const mesh::TriangleSurface& surface, double median) {
  double area = 0.0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    area += mesh::area_vector(surface, static_cast<int>(t)).norm();
  const double thickness = 2.0 * mesh::volume(surface) / area;
  const bool is_rod = thickness < thinnest_plate * median;
  const double least =
      std::sqrt(area / (0.433 * (is_rod ? most_of_rod : most_of_round_body)));  // √3/4 size² a triangle
  if (least > (is_rod ? largest_in_rod : size_of_round_parts) * thickness) return 0.0;
  return std::max(least, size_of_round_parts * thickness);
}

/// The options of the mesher in successive attempts for elements that are curved afterwards, whose chords may lie far
/// off the surface. The last but one has shorter chords; the last one has smaller elements, for walls so thin towards
/// an edge that tetrahedra as long as the others' would be slivers there.
std::vector<mesh::SurfaceMeshOptions> attempts_with_chords(const mesh::SurfaceMeshOptions& straight,
                                                           double size_of_round) {
  mesh::SurfaceMeshOptions first = straight;
  first.volume_tolerance = volume_of_chords;
  first.radius_edge_ratio = roundest;
  first.size.deviation = deviation_of_chords;
  std::vector<mesh::SurfaceMeshOptions> result{first};
  if (size_of_round > 0.0) {
    result.push_back(first);
    result.back().size.size_m = size_of_round;
    result.back().size.turn_rad *= 1.4;
  }
  result.push_back(first);
  result.back().size.deviation *= 0.5;
  result.back().size.turn_rad *= 0.7;
  result.push_back(first);
  result.back().size.scale *= smaller_if_none;
  return result;
}

/// The mesh of a surface that is known to be closed.
mesh::SurfaceMeshed filled(const mesh::TriangleSurface& surface, const mesh::SurfaceMeshOptions& options) {
  return mesh::mesh_closed_surface(surface, options, mesh::volume_meshers(surface, options));
}

/// The mesh of a level. If a finer level cannot be meshed, the size field of level 0 is used with elements 0.7^level as
/// large.
mesh::SurfaceMeshed meshed(const mesh::TriangleSurface& surface, const ClosedPartOptions& options, int level) {
  try {
    return filled(surface, mesh_options(surface, options, level));
  } catch (const core::NumericalError&) {
    if (level == 0) throw;
  }
  mesh::SurfaceMeshOptions other = mesh_options(surface, options, 0);
  other.size.scale = std::pow(0.7, level);
  return filled(surface, other);
}

FirstMesh straight_mesh(const mesh::TriangleSurface& surface, const ClosedPartOptions& options, int level) {
  mesh::SurfaceMeshed result = meshed(surface, options, level);
  SurfaceFit fit{level, std::move(result.mesher), result.volume_error_relative, result.surface_distance_m,
                 std::move(result.failures)};
  return {std::move(result.mesh), std::move(fit)};
}

/// The first mesh of a part of plane walls with rows of narrow elements at its sharp edges, if they pay: elements
/// beside a re-entrant edge need order 6 without them and order 4 with them, which must then not have many more
/// unknowns. They are few at long edges, as of profiles. Beside a wall that one element spans there are none, and of
/// such edges there may be a tenth. Where a support ends within a face the mesh has layers already.
FirstMesh with_rows_if_few(const mesh::TriangleSurface& surface, const ClosedPartOptions& options, FirstMesh first) {
  const bool has_layers = std::ranges::any_of(options.supports, ends_within_a_face);
  if (has_layers || first.fit.mesher != "TetGen" || !has_reentrant_edge(surface)) return first;
  mesh::EdgeRows rows;
  try {
    rows = mesh::with_rows_at_edges(first.mesh, sharp_rad);
  } catch (const core::NumericalError&) {  // the mesh's own boundary does not tell the walls
    return first;
  }
  const auto nodes = [](const mesh::TetMesh& mesh, int order) {
    return static_cast<double>(mesh::lagrange_node_count(mesh, order));
  };
  const double count = nodes(rows.mesh, options.first_order + 1);
  const bool is_small = (options.largest_dofs == 0 || 3.0 * count <= static_cast<double>(options.largest_dofs)) &&
                        count <= most_for_rows * nodes(first.mesh, options.last_order);
  const bool is_complete = rows.divided > 0 && 10 * rows.whole <= rows.divided;
  first.has_rows =
      is_small && is_complete && mesh::smallest_shape(rows.mesh) >= mesh::SurfaceMeshOptions{}.smallest_shape;
  if (first.has_rows) first.mesh = std::move(rows.mesh);
  return first;
}

/// The mesh of a level of straight elements, divided as the options say.
FirstMesh straight_and_divided(const mesh::TriangleSurface& surface, const ClosedPartOptions& options, int level,
                               bool is_plane) {
  FirstMesh result = straight_mesh(surface, options, level);
  if (level == 0 && is_plane) result = with_rows_if_few(surface, options, std::move(result));
  if (options.divided) result.mesh = options.divided(std::move(result.mesh));
  return result;
}

/// A mesh with curved elements.
struct CurvedMesh {
  FirstMesh mesh;
  double chords_off = 0.0;  ///< by volume, relative, of the straight elements between its vertices
  bool is_small = true;     ///< order 3 can be solved on it
  bool is_round = false;    ///< the part is round rather than thin
  [[nodiscard]] double off() const { return std::abs(mesh.fit.volume_error_relative); }
  [[nodiscard]] bool is_better_than(const CurvedMesh& other) const {
    return is_small != other.is_small ? is_small : off() < other.off();
  }
};

/// The mesh of one attempt, with its elements on the surface.
CurvedMesh curved_mesh(const mesh::TriangleSurface& surface, const mesh::SmoothPatches& patches,
                       const std::shared_ptr<const mesh::AnalysedSurface>& analysed, const ClosedPartOptions& options,
                       const mesh::SurfaceMeshOptions& attempt, int level) {
  auto meshers = mesh::volume_meshers(surface, attempt, analysed);
  meshers.pop_back();  // isotropic elements of thin walls would be too many
  mesh::SurfaceMeshed chords = mesh::mesh_closed_surface(surface, attempt, meshers);
  mesh::TetMesh mesh = mesh::fitted_beneath_curves(patches, std::move(chords.mesh));
  auto shape = std::make_shared<const CubicShape>(curved_onto(patches, mesh, first_order_on(mesh, options)));
  const double error = shape->volume_m3 / mesh::volume(surface) - 1.0;
  if (!std::isfinite(error)) throw core::NumericalError("the curved elements of a mesh have no finite volume");
  SurfaceFit fit{level, std::move(chords.mesher), error, chords.surface_distance_m, std::move(chords.failures)};
  const bool is_small = options.largest_dofs == 0 || 3 * mesh::lagrange_node_count(mesh, 3) <= options.largest_dofs;
  return {{std::move(mesh), std::move(fit), std::move(shape)}, std::abs(chords.volume_error_relative), is_small};
}

/// The mesh of a level with curved elements: that of the first attempt whose volume keeps its share of the tolerance,
/// or of the one whose volume is the best, of those with few enough elements if there are such. Empty if no mesher
/// succeeds.
std::optional<CurvedMesh> best_curved_mesh(const mesh::TriangleSurface& surface, const mesh::SmoothPatches& patches,
                                           const ClosedPartOptions& options, int level) {
  const auto analysed = mesh::analysed_surface(surface, mesh::SurfaceSize{}.sharp_angle_rad);
  std::optional<CurvedMesh> best;
  const double size_of_round = size_of_round_body(surface, analysed->median);
  const auto attempts = attempts_with_chords(mesh_options(surface, options, level), size_of_round);
  for (std::size_t i = 0; i < attempts.size(); ++i) {
    const bool smaller = i + 1 == attempts.size(), shorter_chords = i + 2 == attempts.size();
    if (best && smaller) break;
    if (best && shorter_chords && !best->is_small && best->off() <= most_off) break;  // they would make more elements
    const auto& attempt = attempts[i];
    try {
      CurvedMesh mesh = curved_mesh(surface, patches, analysed, options, attempt, level);
      mesh.is_round = size_of_round > 0.0;
      if (!best || mesh.is_better_than(*best)) best = std::move(mesh);
      if (best->is_small && best->off() <= share_of_curves * options.tolerance) break;
    } catch (const core::NumericalError&) {
      core::check_interrupt();
    }
  }
  return best;
}

/// True if curved elements are to be taken rather than straight ones, which would have to be smaller by the square root
/// of what the volume between the vertices is off, in both directions of the surface.
bool suffices(const CurvedMesh& curved, const ClosedPartOptions& options) {
  if (curved.off() <= share_of_curves * options.tolerance) return true;
  if (!(curved.off() <= most_off)) return false;
  const double smaller = curved.chords_off / (share_of_surface * options.tolerance);
  return curved.is_round || smaller * static_cast<double>(curved.mesh.mesh.tets.size()) > most_straight;
}

/// True if the first two orders on the mesh are within the bound on degrees of freedom.
bool can_be_solved(const mesh::TetMesh& mesh, const ClosedPartOptions& options) {
  const int order = first_order_on(mesh, options) + 1;
  return options.largest_dofs == 0 || 3 * mesh::lagrange_node_count(mesh, order) <= options.largest_dofs;
}

/// The patches of a closed surface; null if all of them are planar, so that straight elements follow them.
std::shared_ptr<const mesh::SmoothPatches> curved_patches(const mesh::TriangleSurface& surface) {
  const mesh::SurfaceSize sizes;
  auto patches = std::make_shared<const mesh::SmoothPatches>(mesh::smooth_patches(surface, sizes.sharp_angle_rad));
  return mesh::all_planar(*patches) ? nullptr : patches;
}

/// The mesh of a level: curved where the surface is and the part has one material, for elements of several are cut
/// after they are made; straight where that fails. Where no straight mesh can be had or solved either, the best curved
/// one.
FirstMesh mesh_of_level(const mesh::TriangleSurface& surface, const mesh::SmoothPatches* patches,
                        const ClosedPartOptions& options, int level) {
  std::optional<CurvedMesh> curved;
  if (patches != nullptr) curved = best_curved_mesh(surface, *patches, options, level);
  if (curved && suffices(*curved, options)) return std::move(curved->mesh);
  const bool is_usable = curved && curved->off() <= volume_of_chords;
  try {
    FirstMesh straight = straight_and_divided(surface, options, level, patches == nullptr);
    if (!is_usable || can_be_solved(straight.mesh, options)) return straight;
  } catch (const core::NumericalError&) {
    core::check_interrupt();
    if (!is_usable) throw;
  }
  return std::move(curved->mesh);
}

/// The options of the levels after the first one, whose orders are those of the first.
ClosedPartOptions of_finer_levels(const ClosedPartOptions& options, const std::vector<FirstMesh>& meshes) {
  ClosedPartOptions result = options;
  if (!meshes.empty()) result.first_order = first_order_on(meshes.front().mesh, options);
  result.first_dofs = 0;
  return result;
}

}  // namespace

SolidPart solid_part(const mesh::TriangleSurface& surface, const Material& material, const ClosedPartOptions& options,
                     std::vector<FirstMesh>& meshes) {
  SolidPart part;
  part.material = material;
  part.supports = options.supports;
  part.attachments = options.attachments;
  part.materials = options.materials;
  part.shaping = [&meshes](const mesh::TetMesh& mesh) {
    const auto own =
        std::ranges::find_if(meshes, [&](const FirstMesh& m) { return m.mesh.tets == mesh.tets && m.shape; });
    return own == meshes.end() ? Shaping{} : shaping_by(own->shape);
  };
  part.has_rows = [&meshes](const mesh::TetMesh& mesh) {
    return std::ranges::any_of(meshes, [&](const FirstMesh& m) { return m.has_rows && m.mesh.tets == mesh.tets; });
  };
  const double wanted = options.solid_volume_m3 > 0.0 ? options.solid_volume_m3 : mesh::volume(surface);
  part.shape_error = [wanted, density = material.density_kg_m3,
                      is_straight = static_cast<bool>(options.materials)](const Model& model) {
    const double volume_m3 = is_straight ? mesh::volume(model.mesh) : model.mass.mass_kg / density;
    return std::abs(volume_m3 / wanted - 1.0);
  };
  if (!options.first) mesh::require_closed(surface);
  part.mesh = [&surface, &options, &meshes](int level) {
    if (level == 0 && options.first) {
      meshes.push_back(*options.first);
    } else {
      const auto curved = options.materials ? nullptr : curved_patches(surface);
      meshes.push_back(
          mesh_of_level(surface, curved.get(), level == 0 ? options : of_finer_levels(options, meshes), level));
    }
    return meshes.back().mesh;
  };
  return part;
}

bool has_reentrant_edge(const mesh::TriangleSurface& surface) {
  bool found = false;
  mesh::for_each_edge(mesh::sorted_edges(surface.triangles), [&](std::span<const mesh::EdgeUse> both) {
    if (found || both.size() != 2 || both[0].is_forward == both[1].is_forward) return;
    const bool first_is_left = both[0].is_forward;
    const Eigen::Vector3d a = mesh::area_vector(surface, both[first_is_left ? 0 : 1].triangle).normalized();
    const Eigen::Vector3d b = mesh::area_vector(surface, both[first_is_left ? 1 : 0].triangle).normalized();
    if (a.dot(b) > std::cos(sharp_rad)) return;
    const auto& [from, to] = both[0].ends;
    const Eigen::Vector3d way =
        surface.vertices[static_cast<std::size_t>(to)] - surface.vertices[static_cast<std::size_t>(from)];
    found = a.cross(b).dot(way) < 0.0;  // the edge is re-entrant: the other face rises above this one
  });
  return found;
}

namespace {

/// The options of the refinement.
ToleranceOptions steps_of(const mesh::TriangleSurface& surface, const ClosedPartOptions& options) {
  ToleranceOptions steps;
  steps.tolerance = options.tolerance;
  steps.modes = options.modes;
  steps.points = options.points;
  steps.points_hold = options.points_hold;
  steps.first_order = options.first_order;
  steps.last_order = options.last_order;
  steps.levels = options.levels;
  steps.reentrant_edges = has_reentrant_edge(surface);
  steps.untold_ratio = untold_ratio;
  steps.memory_limit_bytes = options.memory_limit_bytes;
  steps.largest_dofs = options.largest_dofs;
  steps.first_dofs = options.first_dofs;
  steps.time_budget_s = options.time_budget_s;
  steps.solved = options.solved;
  return steps;
}

}  // namespace

int first_order_on(const mesh::TetMesh& mesh, const ClosedPartOptions& options) {
  return first_order_on(mesh, ToleranceOptions{.modes = options.modes,
                                               .first_order = options.first_order,
                                               .largest_dofs = options.largest_dofs,
                                               .first_dofs = options.first_dofs});
}

FirstMesh first_mesh(const mesh::TriangleSurface& surface, const ClosedPartOptions& options) {
  validate(options);
  std::vector<FirstMesh> meshes;
  require_fit(solid_part(surface, {}, options, meshes).mesh(0), steps_of(surface, options));
  return std::move(meshes.front());
}

ClosedPart refine_closed_part(const mesh::TriangleSurface& surface, const Material& material,
                              const ClosedPartOptions& options) {
  validate(options);
  const ToleranceOptions steps = steps_of(surface, options);
  std::vector<FirstMesh> meshes;
  Refined refined = refine_to_tolerance(solid_part(surface, material, options, meshes), steps);
  ClosedPart result{std::move(refined), {}, 0.0, false};
  for (FirstMesh& mesh : meshes) result.fits.push_back(std::move(mesh.fit));
  result.frequency_error = result.refined.estimate.frequency;
  result.met = result.refined.estimate.met;
  return result;
}

}  // namespace thinwall::fem
