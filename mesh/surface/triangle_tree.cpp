#include "mesh/surface/triangle_tree.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

#include "core/error.hpp"
#include "mesh/nearest_point.hpp"

namespace thinwall::mesh {

namespace {

using Box3 = Eigen::AlignedBox3d;

constexpr std::size_t largest_leaf = 4;  // triangles
constexpr std::size_t deepest = 64;      // levels of a tree that halves at each
constexpr double nowhere = std::numeric_limits<double>::infinity();
constexpr double beside = 1e-12;  // relative, by which a ray may pass an edge and still meet its triangles

/// The corners of a triangle, and its index in the surface.
struct Facet {
  std::array<Eigen::Vector3d, 3> corners;
  int number = -1;
};

/// A node of the tree over facets first to last - 1. A node that is no leaf has its first child behind it and its
/// second one at `second`.
struct Node {
  Box3 box;
  std::uint32_t first = 0, last = 0;
  std::uint32_t second = 0;  ///< 0 of a leaf
};

std::vector<int> every_triangle(const TriangleSurface& surface) {
  std::vector<int> all(surface.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// A ray in the axes in which it goes along the third one, sheared so that it is that axis (Woop, Benthin & Wald 2013).
struct Ray {
  Eigen::Vector3d origin, inverse;
  std::array<int, 3> axes{};
  Eigen::Vector3d shear;  ///< of the first two, and the scale of the third

  Ray(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) : origin(from), inverse(direction.cwiseInverse()) {
    direction.cwiseAbs().maxCoeff(&axes[2]);
    axes[0] = (axes[2] + 1) % 3;
    axes[1] = (axes[2] + 2) % 3;
    shear = {direction(axes[0]), direction(axes[1]), 1.0};
    shear /= direction(axes[2]);
  }

  /// A point in the ray's axes: the ray is (0, 0, t).
  [[nodiscard]] Eigen::Vector3d sheared(const Eigen::Vector3d& x) const {
    const Eigen::Vector3d d = x - origin;
    const double along = d(axes[2]);
    return {d(axes[0]) - shear(0) * along, d(axes[1]) - shear(1) * along, shear(2) * along};
  }

  /// The distance along the ray at which it enters a box; infinity if it does not.
  [[nodiscard]] double entry(const Box3& box) const {
    double in = 0.0, out = nowhere;
    for (int k = 0; k < 3; ++k) {
      const double low = box.min()(k) - origin(k), high = box.max()(k) - origin(k);
      if (std::isinf(inverse(k))) {
        if (low > 0.0 || high < 0.0) return nowhere;
        continue;
      }
      in = std::max(in, std::min(low * inverse(k), high * inverse(k)));
      out = std::min(out, std::max(low * inverse(k), high * inverse(k)));
    }
    return in <= out * (1.0 + beside) ? in : nowhere;
  }

  /// The distance along the ray at which it meets a triangle, its edges included; infinity if it does not, and for a
  /// triangle in whose plane it lies, the neighbours of which it meets.
  [[nodiscard]] double meeting(const Facet& facet) const {
    std::array<Eigen::Vector3d, 3> x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = sheared(facet.corners[k]);
    Eigen::Vector3d share, size;
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d &a = x[(k + 1) % 3], &b = x[(k + 2) % 3];
      share(static_cast<Eigen::Index>(k)) = a(0) * b(1) - a(1) * b(0);
      size(static_cast<Eigen::Index>(k)) = beside * (std::abs(a(0) * b(1)) + std::abs(a(1) * b(0)));
    }
    if ((share + size).minCoeff() < 0.0 && (share - size).maxCoeff() > 0.0) return nowhere;
    const double sum = share.sum();
    if (std::abs(sum) <= size.sum()) return nowhere;
    const double way = share.dot(Eigen::Vector3d(x[0](2), x[1](2), x[2](2))) / sum;
    return way >= 0.0 ? way : nowhere;
  }
};

}  // namespace

struct TriangleTree::Implementation {
  std::vector<Facet> facets;
  std::vector<Node> nodes;

  /// Adds the node of these facets and those below it, halved by their middles along the longest side of their box.
  void add(std::uint32_t first, std::uint32_t last) {
    Box3 box, middles;
    for (std::uint32_t i = first; i < last; ++i) {
      for (const Eigen::Vector3d& x : facets[i].corners) box.extend(x);
      middles.extend(middle(facets[i]));
    }
    const std::size_t own = nodes.size();
    nodes.push_back({box, first, last});
    if (last - first <= largest_leaf) return;
    Eigen::Index axis = 0;
    middles.sizes().maxCoeff(&axis);
    const std::uint32_t half = first + (last - first) / 2;
    std::nth_element(facets.begin() + first, facets.begin() + half, facets.begin() + last,
                     [&](const Facet& a, const Facet& b) { return middle(a)(axis) < middle(b)(axis); });
    add(first, half);
    nodes[own].second = static_cast<std::uint32_t>(nodes.size());
    add(half, last);
  }

  /// Visits leaves from near to far: `bound(box)` is the least that a facet in a box can have, `visit(facet)` returns
  /// the least found so far.
  template <class Bound, class Visit>
  void descend(const Bound& bound, const Visit& visit) const {
    std::array<std::pair<double, std::uint32_t>, deepest> open;
    std::size_t count = 0;
    double least = nowhere;
    open[count++] = {bound(nodes[0].box), 0};
    while (count > 0) {
      const auto [at_least, n] = open[--count];
      if (!(at_least < least)) continue;
      const Node& node = nodes[n];
      if (node.second == 0) {
        for (std::uint32_t i = node.first; i < node.last; ++i) least = visit(facets[i]);
        continue;
      }
      std::pair<double, std::uint32_t> near{bound(nodes[n + 1].box), n + 1};
      std::pair<double, std::uint32_t> far{bound(nodes[node.second].box), node.second};
      if (far.first < near.first) std::swap(near, far);
      if (far.first < least) open[count++] = far;
      if (near.first < least) open[count++] = near;
    }
  }

  static Eigen::Vector3d middle(const Facet& facet) {
    return facet.corners[0] + facet.corners[1] + facet.corners[2];  // three times it
  }
};

TriangleTree::TriangleTree(const TriangleSurface& surface) : TriangleTree(surface, every_triangle(surface)) {}

TriangleTree::TriangleTree(const TriangleSurface& surface, std::vector<int> triangles)
    : implementation_(std::make_unique<Implementation>()) {
  if (triangles.empty())
    throw core::InputError("a surface without triangles cannot be searched; give a closed surface");
  auto& own = *implementation_;
  own.facets.reserve(triangles.size());
  for (const int t : triangles) {
    const auto& corners = surface.triangles[static_cast<std::size_t>(t)];
    const auto at = [&](std::size_t k) { return surface.vertices[static_cast<std::size_t>(corners[k])]; };
    own.facets.push_back({{at(0), at(1), at(2)}, t});
  }
  own.nodes.reserve(own.facets.size());
  own.add(0, static_cast<std::uint32_t>(own.facets.size()));
}

TriangleTree::~TriangleTree() = default;
TriangleTree::TriangleTree(TriangleTree&&) noexcept = default;
TriangleTree& TriangleTree::operator=(TriangleTree&&) noexcept = default;

TriangleTree::Nearest TriangleTree::nearest(const Eigen::Vector3d& x) const {
  if (!x.allFinite()) throw core::InputError("the point nearest to one that is not finite is not known");
  const auto& own = *implementation_;
  Nearest result{own.facets[0].corners[0], own.facets[0].number, 0.0};
  double least = nowhere;
  own.descend([&](const Box3& box) { return box.squaredExteriorDistance(x); },
              [&](const Facet& facet) {
                const auto& [a, b, c] = facet.corners;
                const Eigen::Vector3d point = nearest_on_triangle(x, a, b, c);
                const double squared = (point - x).squaredNorm();
                if (squared < least) {
                  least = squared;
                  result.point = point;
                  result.triangle = facet.number;
                }
                return least;
              });
  result.distance_m = (result.point - x).norm();
  return result;
}

std::optional<double> TriangleTree::first_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                              int skipped) const {
  const Ray ray(origin, direction);
  double least = nowhere;
  implementation_->descend([&](const Box3& box) { return ray.entry(box); },
                           [&](const Facet& facet) {
                             if (facet.number != skipped) least = std::min(least, ray.meeting(facet));
                             return least;
                           });
  if (!std::isfinite(least)) return std::nullopt;
  return least;
}

}  // namespace thinwall::mesh
