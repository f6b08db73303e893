#include "fem/closed_part.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "mesh/volume/surface_to_volume.hpp"

namespace thinwall::fem {

namespace {

constexpr double coarsest_turn_rad = 0.5;
constexpr double smaller_per_level = 1.5;
constexpr double share_of_wave = 0.15;
constexpr double sharp_rad = 0.5235987755982988;  // 30°

void validate(const ClosedPartOptions& o) {
  if (!(o.tolerance >= 1e-3 && o.tolerance <= 0.1)) {
    throw core::InputError("a tolerance of " + std::to_string(o.tolerance) +
                           " for a part of a closed surface is outside 0.001 to 0.1: its elements have straight edges");
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

}  // namespace

SolidPart solid_part(const mesh::TriangleSurface& surface, const Material& material, const ClosedPartOptions& options,
                     std::vector<SurfaceFit>& fits) {
  SolidPart part;
  part.material = material;
  part.supports = options.supports;
  part.attachments = options.attachments;
  part.materials = options.materials;
  part.mesh = [&surface, &options, &fits](int level) {
    if (level == 0 && options.first) {
      fits.push_back(options.first->fit);
      return options.first->mesh;
    }
    mesh::SurfaceMeshed result = meshed(surface, options, level);
    fits.push_back({level, std::move(result.mesher), result.volume_error_relative, result.surface_distance_m,
                    std::move(result.failures)});
    return options.divided ? options.divided(std::move(result.mesh)) : std::move(result.mesh);
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
  std::vector<SurfaceFit> fits;
  mesh::TetMesh mesh = solid_part(surface, {}, options, fits).mesh(0);
  require_fit(mesh, steps_of(surface, options));
  return {std::move(mesh), std::move(fits.front())};
}

ClosedPart refine_closed_part(const mesh::TriangleSurface& surface, const Material& material,
                              const ClosedPartOptions& options) {
  validate(options);
  const ToleranceOptions steps = steps_of(surface, options);
  std::vector<SurfaceFit> fits;
  Refined refined = refine_to_tolerance(solid_part(surface, material, options, fits), steps);
  ClosedPart result{std::move(refined), std::move(fits), 0.0, false};
  const int level = result.refined.level;
  const auto solved =
      std::find_if(result.fits.begin(), result.fits.end(), [&](const SurfaceFit& fit) { return fit.level == level; });
  result.frequency_error = result.refined.estimate.frequency + std::abs(solved->volume_error_relative);
  result.met = result.frequency_error <= options.tolerance && result.refined.estimate.receptance <= options.tolerance;
  return result;
}

}  // namespace thinwall::fem
