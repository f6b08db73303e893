#include "mesh/volume/surface_to_volume.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/units.hpp"
#include "mesh/surface/closed_surface.hpp"
#include "mesh/surface/matched_walls.hpp"
#include "mesh/surface/remesh.hpp"
#include "mesh/surface/surface_distance.hpp"
#include "mesh/surface/wall_thickness.hpp"
#include "mesh/volume/delaunay_volume.hpp"
#include "mesh/volume/tetgen.hpp"

namespace thinwall::mesh {

namespace {

constexpr double walls_per_isotropic_element = 1.5;
constexpr double walls_off_the_surface = 0.02;  // of isotropic facets; finer ones make 50 times as many elements
constexpr double smallest_turn_rad = 0.01;
constexpr double samples_per_diagonal = 100.0;
constexpr double share_of_tetgen = 0.25;  // of the time that a mesher has; it ends within seconds or not at all

void validate(const SurfaceMeshOptions& options) {
  validate(options.size);
  if (!(options.volume_tolerance >= 1e-6 && options.volume_tolerance <= 0.1)) {
    throw core::InputError("the volume tolerance of a surface mesh is " +
                           core::number_text(options.volume_tolerance, 3) + "; choose 1e-6 to 0.1");
  }
  if (!(options.smallest_shape >= 0.0 && options.smallest_shape <= 1e-3)) {
    throw core::InputError("the smallest V/L³ of a surface mesh is " + core::number_text(options.smallest_shape, 3) +
                           "; choose 0 to 1e-3");
  }
}

/// The surface remeshed with smaller and smaller turns until the volume is kept. On a bent wall the error of the volume
/// is turn²/6, because both sides move together. On a twisted wall each side errs separately, up or down with the
/// direction of every diagonal; the sum then decreases with the turn on average only, so that the steps are small.
Remeshed remesh_to_volume(const TriangleSurface& surface, const AnalysedSurface& part, SurfaceSize size,
                          double tolerance) {
  constexpr int repetitions = 5;
  const double wanted = volume(surface);
  for (int k = 0;; ++k) {
    Remeshed result = remesh(surface, part.features, SizeSpace(surface, part.features, part.thickness, size));
    const double error = std::abs(volume(result.surface) / wanted - 1.0);
    if (error <= tolerance || k == repetitions || size.turn_rad <= smallest_turn_rad) return result;
    const double factor = std::clamp(std::sqrt(tolerance / error), 0.5, 0.85);
    size.turn_rad = std::max(smallest_turn_rad, factor * size.turn_rad);
  }
}

/// The remeshed surface filled by TetGen; throws NumericalError if it crosses itself.
TetMesh filled(const TriangleSurface& remeshed, const ProcessLimits& limits, double radius_edge_ratio = 0.0) {
  const auto crossings = self_intersections(remeshed);
  if (!crossings.empty()) {
    const Eigen::Vector3d x = 1e3 * centroid(remeshed, crossings[0][0]);
    throw core::NumericalError("the coarse surface crosses itself near (" + core::number_text(x(0), 3) + ", " +
                               core::number_text(x(1), 3) + ", " + core::number_text(x(2), 3) + ") mm");
  }
  return tetrahedralise_as_given(faceted(remeshed), limits, radius_edge_ratio);
}

/// True if the walls beneath half of the surface are thicker than its triangles are long.
bool is_bulky(const TriangleSurface& remeshed, double median_thickness) {
  double edges = 0.0;
  for (const auto& t : remeshed.triangles) {
    for (std::size_t k = 0; k < 3; ++k)
      edges += (remeshed.vertices[static_cast<std::size_t>(t[(k + 1) % 3])] -
                remeshed.vertices[static_cast<std::size_t>(t[k])])
                   .norm();
  }
  return edges < 3.0 * median_thickness * static_cast<double>(remeshed.triangles.size());
}

/// The mesh with its measures; throws NumericalError if it does not keep the volume or has a degenerate tetrahedron.
SurfaceMeshed judged(TetMesh mesh, const TriangleSurface& surface, const SurfaceMeshOptions& options) {
  SurfaceMeshed result;
  result.volume_error_relative = volume(mesh) / volume(surface) - 1.0;
  result.smallest_shape = smallest_shape(mesh);
  result.mesh = std::move(mesh);
  if (!(std::abs(result.volume_error_relative) <= options.volume_tolerance)) {
    throw core::NumericalError("the mesh's volume is off by " + core::number_text(result.volume_error_relative, 3) +
                               ", more than " + core::number_text(options.volume_tolerance, 3));
  }
  if (!(result.smallest_shape >= options.smallest_shape)) {
    throw core::NumericalError("the mesh has a tetrahedron with V/L³ = " + core::number_text(result.smallest_shape, 3) +
                               ", below " + core::number_text(options.smallest_shape, 3));
  }
  return result;
}

/// The surface remeshed, with both sides of its walls alike, and filled by TetGen; with the sides as they are if that
/// fails or does not keep the volume.
TetMesh fill_remeshed(const TriangleSurface& surface, const AnalysedSurface& part, const SurfaceSize& size,
                      const SurfaceMeshOptions& options) {
  const Remeshed remeshed = remesh_to_volume(surface, part, size, options.volume_tolerance);
  if (options.radius_edge_ratio > 0.0 && is_bulky(remeshed.surface, part.median))
    return filled(remeshed.surface, options.limits, options.radius_edge_ratio);
  if (size.layers == 0) {
    try {
      return judged(filled(matched_walls(remeshed).surface, options.limits), surface, options).mesh;
    } catch (const core::NumericalError&) {
      core::check_interrupt();
    }
  }
  return filled(remeshed.surface, options.limits);
}

/// The mesh by the first mesher that succeeds, with the messages of those before it.
SurfaceMeshed first_that_works(const TriangleSurface& surface, const SurfaceMeshOptions& options,
                               const std::vector<VolumeMesher>& meshers) {
  std::vector<std::string> failures;
  for (const auto& mesher : meshers) {
    core::check_interrupt();
    try {
      SurfaceMeshed result = judged(mesher.run(surface), surface, options);
      result.mesher = mesher.name;
      result.failures = std::move(failures);
      result.surface_distance_m =
          surface_distance(boundary_surface(result.mesh), surface, diagonal(surface) / samples_per_diagonal);
      return result;
    } catch (const core::NumericalError& error) {
      failures.push_back(mesher.name + ": " + error.what());
    }
  }
  std::string all;
  for (const auto& failure : failures) all += (all.empty() ? "" : "; ") + failure;
  throw core::NumericalError("no mesher could fill the surface (" + all +
                             "); try a smaller size, or mend the surface where it is nearly touching itself");
}

}  // namespace

double smallest_shape(const TetMesh& mesh) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t tet = 0; tet < mesh.tets.size(); ++tet) {
    double longest = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const auto& a = mesh.vertices[static_cast<std::size_t>(mesh.tets[tet][i])];
        const auto& b = mesh.vertices[static_cast<std::size_t>(mesh.tets[tet][j])];
        longest = std::max(longest, (a - b).norm());
      }
    }
    smallest = std::min(smallest, volume(mesh, static_cast<int>(tet)) / std::pow(longest, 3));
  }
  return smallest;
}

std::shared_ptr<const AnalysedSurface> analysed_surface(const TriangleSurface& surface, double sharp_angle_rad) {
  AnalysedSurface result{surface_features(surface, sharp_angle_rad), wall_thickness(surface, TriangleTree(surface))};
  std::vector<int> all(surface.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  result.median = median_thickness(surface, result.thickness, all);
  return std::make_shared<const AnalysedSurface>(std::move(result));
}

std::vector<VolumeMesher> volume_meshers(const TriangleSurface& surface, const SurfaceMeshOptions& options,
                                         std::shared_ptr<const AnalysedSurface> analysed) {
  const auto part = analysed ? std::move(analysed) : analysed_surface(surface, options.size.sharp_angle_rad);
  std::vector<VolumeMesher> meshers;
  double shorter = 1.0;
  double straighter = 1.0;
  SurfaceMeshOptions of_tetgen = options;
  of_tetgen.limits.time_s *= share_of_tetgen;
  for (int attempt = 0; attempt < 3; ++attempt, shorter *= 0.8, straighter *= 0.7) {
    SurfaceSize size = options.size;
    size.scale *= shorter;
    size.turn_rad = std::max(smallest_turn_rad, size.turn_rad * straighter);
    size.deviation =
        std::min(size.deviation, std::max(SurfaceSize{}.deviation, size.deviation * straighter * straighter));
    meshers.push_back({"TetGen", [part, size, of_tetgen](const TriangleSurface& input) {
                         return fill_remeshed(input, *part, size, of_tetgen);
                       }});
  }
  DelaunayVolumeOptions delaunay;
  delaunay.size_m = walls_per_isotropic_element * part->median;
  delaunay.surface_distance_m = walls_off_the_surface * part->median;
  delaunay.sharp_angle_rad = options.size.sharp_angle_rad;
  delaunay.limits = options.limits;
  meshers.push_back({"CGAL", [delaunay](const TriangleSurface& input) { return delaunay_volume(input, delaunay); }});
  return meshers;
}

SurfaceMeshed mesh_closed_surface(const FacetedSurface& surface, const SurfaceMeshOptions& options) {
  return mesh_closed_surface(triangulated(surface), options);
}

SurfaceMeshed mesh_closed_surface(const TriangleSurface& surface, const SurfaceMeshOptions& options) {
  validate(options);
  require_closed(surface);
  return first_that_works(surface, options, volume_meshers(surface, options));
}

SurfaceMeshed mesh_closed_surface(const TriangleSurface& surface, const SurfaceMeshOptions& options,
                                  const std::vector<VolumeMesher>& meshers) {
  validate(options);
  require_closed_shell(surface);
  return first_that_works(surface, options, meshers);
}

}  // namespace thinwall::mesh
