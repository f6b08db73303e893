#include "mesh/surface/smooth_patches.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace thinwall::mesh {

namespace {

constexpr double planar_rad = 1e-6;
constexpr double cosine_of_largest_turn = 0.5;  // 60°

std::vector<std::vector<int>> triangles_by_patch(const SurfaceFeatures& features) {
  std::vector<std::vector<int>> result(static_cast<std::size_t>(features.patches));
  for (std::size_t t = 0; t < features.patch_of_triangle.size(); ++t)
    result[static_cast<std::size_t>(features.patch_of_triangle[t])].push_back(static_cast<int>(t));
  return result;
}

std::map<std::array<int, 2>, std::vector<Polyline>> lines_by_patches(const TriangleSurface& surface,
                                                                     const SurfaceFeatures& features) {
  std::map<std::array<int, 2>, std::vector<Polyline>> result;
  for (const FeatureLine& line : features.lines) {
    Polyline places;
    for (const int v : line.vertices) places.push_back(surface.vertices[static_cast<std::size_t>(v)]);
    result[{std::min(line.patches[0], line.patches[1]), std::max(line.patches[0], line.patches[1])}].push_back(places);
  }
  return result;
}

}  // namespace

bool is_planar(const TriangleSurface& surface, const std::vector<int>& triangles) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const int t : triangles) sum += area_vector(surface, t);
  const Eigen::Vector3d normal = sum.normalized();
  return std::ranges::all_of(triangles, [&](int t) {
    const Eigen::Vector3d own = area_vector(surface, t).normalized();
    return own.dot(normal) > 0.0 && own.cross(normal).norm() < planar_rad;
  });
}

SmoothPatches smooth_patches(const TriangleSurface& surface, double sharp_angle_rad) {
  SurfaceFeatures features = surface_features(surface, sharp_angle_rad);
  std::vector<SmoothPatch> patches;
  for (const auto& triangles : triangles_by_patch(features))
    patches.push_back({TriangleTree(surface, triangles), is_planar(surface, triangles)});
  auto lines = lines_by_patches(surface, features);
  return {surface, std::move(features), TriangleTree(surface), std::move(patches), std::move(lines)};
}

bool all_planar(const SmoothPatches& of) {
  return std::ranges::all_of(of.patches, [](const SmoothPatch& patch) { return patch.planar; });
}

int patch_beneath(const SmoothPatches& of, const TetMesh& mesh, const BoundaryTriangle& face) {
  const auto at = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(face.vertices[k])]; };
  const Eigen::Vector3d normal = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
  const int nearest = of.whole.nearest((at(0) + at(1) + at(2)) / 3.0).triangle;
  if (area_vector(of.surface, nearest).normalized().dot(normal) < cosine_of_largest_turn) return -1;
  return of.features.patch_of_triangle[static_cast<std::size_t>(nearest)];
}

Eigen::Vector3d nearest_between(const SmoothPatches& of, int patch, int other, const Eigen::Vector3d& x) {
  if (patch == other) return of.patches[static_cast<std::size_t>(patch)].tree.nearest(x).point;
  const auto found = of.lines.find({std::min(patch, other), std::max(patch, other)});
  Eigen::Vector3d result = x;
  if (found == of.lines.end()) return result;
  double least = std::numeric_limits<double>::infinity();
  for (const Polyline& line : found->second) {
    const Eigen::Vector3d candidate = nearest_on(line, x);
    if ((candidate - x).norm() >= least) continue;
    least = (candidate - x).norm();
    result = candidate;
  }
  return result;
}

}  // namespace thinwall::mesh
