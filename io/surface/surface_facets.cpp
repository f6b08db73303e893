#include "io/surface/surface_facets.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <string>

#include "io/surface/ear_clipping.hpp"

namespace thinwall::io {

namespace {

/// Share of the facet's area by which a triangle of a fan may be turned over, because of corners on a straight edge and
/// round-off.
constexpr double allowed_relative_overlap = 1e-9;

/// Number of fans that are compared for a facet, which limits the cost of a facet to this number times its corners.
constexpr std::size_t most_tried = 64;

using Points = std::vector<Eigen::Vector3d>;

const Eigen::Vector3d& at(const Points& points, std::span<const int> corners, std::size_t k) {
  return points[static_cast<std::size_t>(corners[k % corners.size()])];
}

/// Twice the vector area of the facet, about its first corner.
Eigen::Vector3d newell_normal(const Points& points, std::span<const int> corners) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const Eigen::Vector3d& origin = at(points, corners, 0);
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    sum += (at(points, corners, k) - origin).cross(at(points, corners, k + 1) - origin);
  return sum;
}

/// Twice the area of the smallest triangle of the fan from corner `apex`, seen along the unit normal.
double smallest_of_fan(const Points& points, std::span<const int> corners, std::size_t apex,
                       const Eigen::Vector3d& normal) {
  double smallest = std::numeric_limits<double>::infinity();
  const Eigen::Vector3d& origin = at(points, corners, apex);
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    const Eigen::Vector3d a = at(points, corners, apex + k) - origin;
    smallest = std::min(smallest, a.cross(at(points, corners, apex + k + 1) - origin).dot(normal));
  }
  return smallest;
}

/// The corner from which the facet is divided into a fan, or the number of corners if there is none. For a facet
/// without area any corner is taken.
std::size_t best_apex(const Points& points, std::span<const int> corners) {
  const Eigen::Vector3d normal = newell_normal(points, corners);
  const double area = normal.norm();
  if (!(area > 0.0) || corners.size() == 3) return 0;
  std::size_t best = corners.size();
  double largest = -allowed_relative_overlap * area;
  const std::size_t step = (corners.size() + most_tried - 1) / most_tried;
  for (std::size_t apex = 0; apex < corners.size(); apex += step) {
    const double smallest = smallest_of_fan(points, corners, apex, normal / area);
    if (!(smallest > largest)) continue;
    largest = smallest;
    best = apex;
  }
  for (std::size_t apex = 0; step > 1 && best == corners.size() && apex < corners.size(); ++apex)
    if (smallest_of_fan(points, corners, apex, normal / area) > largest) return apex;
  return best;
}

/// The triangles of a facet that no fan fills, as seen along its normal; empty if its outline crosses itself.
std::vector<std::array<std::size_t, 3>> ears_of(const Points& points, std::span<const int> corners) {
  const Eigen::Vector3d normal = newell_normal(points, corners).normalized();
  const Eigen::Vector3d along_x = normal.unitOrthogonal();
  const Eigen::Vector3d along_y = normal.cross(along_x);
  std::vector<Eigen::Vector2d> seen;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Eigen::Vector3d x = at(points, corners, k) - at(points, corners, 0);
    seen.emplace_back(along_x.dot(x), along_y.dot(x));
  }
  return clipped_ears(seen);
}

}  // namespace

mesh::TriangleSoup triangles_of(std::vector<Eigen::Vector3d> points, const FacetList& facets,
                                const std::function<void(int, const std::string&)>& fail) {
  mesh::TriangleSoup result;
  result.triangles.reserve(facets.corners.size() - std::min(facets.corners.size(), 2 * facets.ends.size()));
  std::size_t begin = 0;
  for (std::size_t f = 0; f < facets.ends.size(); ++f) {
    const std::span<const int> corners(facets.corners.data() + begin, facets.ends[f] - begin);
    begin = facets.ends[f];
    for (const int p : corners) {
      if (p >= 0 && static_cast<std::size_t>(p) < points.size()) continue;
      fail(facets.places[f], "a facet names point " + std::to_string(p) + " (counted from 0), and there are " +
                                 std::to_string(points.size()));
    }
    const std::size_t apex = best_apex(points, corners);
    if (apex == corners.size()) {
      const auto ears = ears_of(points, corners);
      if (ears.empty())
        fail(facets.places[f], "a facet of " + std::to_string(corners.size()) +
                                   " corners crosses itself and cannot be cut into triangles; export triangles");
      for (const auto& ear : ears) result.triangles.push_back({corners[ear[0]], corners[ear[1]], corners[ear[2]]});
      continue;
    }
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
      const auto corner = [&](std::size_t i) { return corners[(apex + i) % corners.size()]; };
      result.triangles.push_back({corner(0), corner(k), corner(k + 1)});
    }
  }
  result.points = std::move(points);
  return result;
}

}  // namespace thinwall::io
