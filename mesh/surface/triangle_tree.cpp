#include "mesh/surface/triangle_tree.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <numeric>

#include "core/error.hpp"

namespace thinwall::mesh {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 point(const Eigen::Vector3d& x) {
  return {x(0), x(1), x(2)};
}

std::vector<int> every_triangle(const TriangleSurface& surface) {
  std::vector<int> all(surface.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace

struct TriangleTree::Implementation {
  std::vector<int> numbers;
  Triangles triangles;
  Tree tree;
};

TriangleTree::TriangleTree(const TriangleSurface& surface) : TriangleTree(surface, every_triangle(surface)) {}

TriangleTree::TriangleTree(const TriangleSurface& surface, std::vector<int> triangles)
    : implementation_(std::make_unique<Implementation>()) {
  if (triangles.empty())
    throw core::InputError("a surface without triangles cannot be searched; give a closed surface");
  auto& own = *implementation_;
  own.numbers = std::move(triangles);
  for (const int t : own.numbers) {
    const auto& corners = surface.triangles[static_cast<std::size_t>(t)];
    const auto at = [&](std::size_t k) { return point(surface.vertices[static_cast<std::size_t>(corners[k])]); };
    own.triangles.emplace_back(at(0), at(1), at(2));
  }
  own.tree.rebuild(own.triangles.begin(), own.triangles.end());
  own.tree.accelerate_distance_queries();
}

TriangleTree::~TriangleTree() = default;
TriangleTree::TriangleTree(TriangleTree&&) noexcept = default;
TriangleTree& TriangleTree::operator=(TriangleTree&&) noexcept = default;

TriangleTree::Nearest TriangleTree::nearest(const Eigen::Vector3d& x) const {
  const auto& own = *implementation_;
  const auto [found, primitive] = own.tree.closest_point_and_primitive(point(x));
  Nearest result;
  result.point = {found.x(), found.y(), found.z()};
  result.triangle = own.numbers[static_cast<std::size_t>(primitive - own.triangles.begin())];
  result.distance_m = (result.point - x).norm();
  return result;
}

std::optional<double> TriangleTree::first_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                              int skipped) const {
  const auto& own = *implementation_;
  const Kernel::Ray_3 ray(point(origin), Kernel::Vector_3(direction(0), direction(1), direction(2)));
  const auto is_skipped = [&](const Triangles::const_iterator& t) {
    return own.numbers[static_cast<std::size_t>(t - own.triangles.begin())] == skipped;
  };
  const auto hit = own.tree.first_intersected_primitive(ray, is_skipped);
  if (!hit) return std::nullopt;
  // The ray is cut with the triangle's plane; a ray within the plane meets the triangle where it enters it.
  const Kernel::Triangle_3& triangle = **hit;
  const Kernel::Vector_3 normal = triangle.supporting_plane().orthogonal_vector();
  const double along = normal * ray.to_vector();
  const double away = normal * (triangle[0] - ray.source());
  if (along != 0.0) return std::max(0.0, away / along);
  return std::sqrt(CGAL::squared_distance(ray.source(), triangle));
}

}  // namespace thinwall::mesh
