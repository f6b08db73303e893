#include "fem/closed_part.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "mesh/surface/closed_surface.hpp"
#include "mesh/surface/smooth_patches.hpp"
#include "mesh/volume/beneath_curves.hpp"
#include "mesh/volume/surface_to_volume.hpp"

namespace thinwall::fem {

namespace {

constexpr double coarsest_turn_rad = 0.5;
constexpr double smaller_per_level = 1.5;
constexpr double share_of_wave = 0.15;
constexpr double volume_of_chords = 0.08;         // by which straight elements may err that are curved afterwards
constexpr double deviation_of_chords = 0.2;       // of the wall thickness, likewise
constexpr double roundest = 1.4;                  // circumradius over shortest edge of elements that need not be flat
constexpr double most_of_round_body = 4000.0;     // triangles
constexpr double most_off_of_round_body = 0.02;   // by volume, which its estimate tells
constexpr double sharp_rad = 0.5235987755982988;  // 30°

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
/// m. Long elements between its sides would be spoilt when both are curved. 0 for a body that would take thousands of
/// them.
double size_of_round_body(const mesh::TriangleSurface& surface) {
  double area = 0.0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    area += mesh::area_vector(surface, static_cast<int>(t)).norm();
  const double size = 0.8 * 2.0 * mesh::volume(surface) / area;
  return area < most_of_round_body * 0.433 * size * size ? size : 0.0;  // √3/4 of its square is a triangle's area
}

/// The options of the mesher in successive attempts for elements that are curved afterwards, whose chords may lie far
/// off the surface.
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
  return result;
}

/// The mesh of a level. If a finer level cannot be meshed, the size field of level 0 is used with elements 0.7^level as
/// large.
mesh::SurfaceMeshed meshed(const mesh::TriangleSurface& surface, const ClosedPartOptions& options, int level) {
  try {
    return mesh::mesh_closed_surface(surface, mesh_options(surface, options, level));
  } catch (const core::NumericalError&) {
    if (level == 0) throw;
  }
  mesh::SurfaceMeshOptions other = mesh_options(surface, options, 0);
  other.size.scale = std::pow(0.7, level);
  return mesh::mesh_closed_surface(surface, other);
}

FirstMesh straight_mesh(const mesh::TriangleSurface& surface, const ClosedPartOptions& options, int level) {
  mesh::SurfaceMeshed result = meshed(surface, options, level);
  SurfaceFit fit{level, std::move(result.mesher), result.volume_error_relative, result.surface_distance_m,
                 std::move(result.failures)};
  return {options.divided ? options.divided(std::move(result.mesh)) : std::move(result.mesh), std::move(fit)};
}

/// The mesh of a level with curved elements whose volume keeps its share of the tolerance. If no attempt does, the best
/// one for a round body, which straight elements would follow by very many, and otherwise none. Empty, too, if no
/// mesher succeeds.
std::optional<FirstMesh> curved_mesh(const mesh::TriangleSurface& surface, const mesh::SmoothPatches& patches,
                                     const ClosedPartOptions& options, int level) {
  const double wanted = mesh::volume(surface), bound = share_of_surface * options.tolerance;
  const double size_of_round = size_of_round_body(surface);
  std::optional<FirstMesh> best;
  for (const auto& attempt : attempts_with_chords(mesh_options(surface, options, level), size_of_round)) {
    try {
      auto meshers = mesh::volume_meshers(surface, attempt);
      meshers.pop_back();  // isotropic elements of thin walls would be too many
      mesh::SurfaceMeshed chords = mesh::mesh_closed_surface(surface, attempt, meshers);
      mesh::TetMesh mesh = mesh::fitted_beneath_curves(patches, std::move(chords.mesh));
      auto shape = std::make_shared<const CubicShape>(curved_onto(patches, mesh));
      const double error = shape->volume_m3 / wanted - 1.0;
      if (best && std::abs(best->fit.volume_error_relative) <= std::abs(error)) continue;
      best = FirstMesh{std::move(mesh),
                       {level, std::move(chords.mesher), error, chords.surface_distance_m, std::move(chords.failures)},
                       std::move(shape)};
      if (std::abs(error) <= bound) break;
    } catch (const core::NumericalError&) {
      core::check_interrupt();
    }
  }
  const double most = size_of_round > 0.0 ? most_off_of_round_body : bound;
  if (best && std::abs(best->fit.volume_error_relative) > most) best.reset();
  return best;
}

/// The patches of a surface; null if all of them are planar, so that straight elements follow them.
std::shared_ptr<const mesh::SmoothPatches> curved_patches(const mesh::TriangleSurface& surface) {
  mesh::require_closed(surface);
  const mesh::SurfaceSize sizes;
  auto patches = std::make_shared<const mesh::SmoothPatches>(mesh::smooth_patches(surface, sizes.sharp_angle_rad));
  return mesh::all_planar(*patches) ? nullptr : patches;
}

/// The mesh of a level: curved where the surface is and the part has one material, for elements of several are cut
/// after they are made; straight where that fails.
FirstMesh mesh_of_level(const mesh::TriangleSurface& surface, const mesh::SmoothPatches* curved,
                        const ClosedPartOptions& options, int level) {
  if (curved != nullptr)
    if (auto mesh = curved_mesh(surface, *curved, options, level)) return std::move(*mesh);
  return straight_mesh(surface, options, level);
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
  const auto curved = options.materials ? nullptr : curved_patches(surface);
  part.mesh = [&surface, &options, &meshes, curved](int level) {
    meshes.push_back(level == 0 && options.first ? *options.first
                                                 : mesh_of_level(surface, curved.get(), options, level));
    return meshes.back().mesh;
  };
  return part;
}

bool has_reentrant_edge(const mesh::TriangleSurface& surface) {
  std::map<std::pair<int, int>, int> along;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      along[{surface.triangles[t][k], surface.triangles[t][(k + 1) % 3]}] = static_cast<int>(t);
  return std::any_of(along.begin(), along.end(), [&](const auto& entry) {
    const auto [from, to] = entry.first;
    const auto other = along.find({to, from});
    if (other == along.end()) return false;
    const Eigen::Vector3d a = mesh::area_vector(surface, entry.second).normalized();
    const Eigen::Vector3d b = mesh::area_vector(surface, other->second).normalized();
    if (a.dot(b) > std::cos(sharp_rad)) return false;
    const Eigen::Vector3d way =
        surface.vertices[static_cast<std::size_t>(to)] - surface.vertices[static_cast<std::size_t>(from)];
    return a.cross(b).dot(way) < 0.0;  // the edge is re-entrant: the other face rises above this one
  });
}

namespace {

/// The options of the refinement; its share of the tolerance is what the surface leaves.
ToleranceOptions steps_of(const mesh::TriangleSurface& surface, const ClosedPartOptions& options) {
  ToleranceOptions steps;
  steps.tolerance = (1.0 - share_of_surface) * options.tolerance;
  steps.modes = options.modes;
  steps.points = options.points;
  steps.points_hold = options.points_hold;
  steps.first_order = options.first_order;
  steps.last_order = options.last_order;
  steps.levels = options.levels;
  steps.reentrant_edges = has_reentrant_edge(surface);
  steps.memory_limit_bytes = options.memory_limit_bytes;
  steps.largest_dofs = options.largest_dofs;
  steps.time_budget_s = options.time_budget_s;
  steps.solved = options.solved;
  return steps;
}

}  // namespace

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
  const int level = result.refined.level;
  const auto solved =
      std::find_if(result.fits.begin(), result.fits.end(), [&](const SurfaceFit& fit) { return fit.level == level; });
  result.frequency_error = result.refined.estimate.frequency + std::abs(solved->volume_error_relative);
  result.met = result.frequency_error <= options.tolerance && result.refined.estimate.receptance <= options.tolerance;
  return result;
}

}  // namespace thinwall::fem
