#include "mesh/surface/facet_repair.hpp"

#include <algorithm>
#include <span>
#include <tuple>

#include "mesh/surface/closed_surface.hpp"
#include "mesh/surface/edge_uses.hpp"

namespace thinwall::mesh {

namespace {

using Triangle = std::array<int, 3>;

const Eigen::Vector3d& point(const TriangleSoup& soup, int p) {
  return soup.points[static_cast<std::size_t>(p)];
}

Eigen::Vector3d middle(const TriangleSoup& soup, const Triangle& t) {
  return (point(soup, t[0]) + point(soup, t[1]) + point(soup, t[2])) / 3.0;
}

/// Removes the dropped triangles.
void keep_only(TriangleSoup& soup, const std::vector<bool>& dropped) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    if (!dropped[t]) soup.triangles[kept++] = soup.triangles[t];
  soup.triangles.resize(kept);
}

Triangle ascending(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

/// True if the corners in ascending order have the same orientation as the triangle.
bool is_even(const Triangle& t) {
  return (t[0] < t[1]) + (t[1] < t[2]) + (t[2] < t[0]) == 2;
}

std::vector<bool> flat_triangles(const TriangleSoup& soup) {
  std::vector<bool> flat(soup.triangles.size());
  for (std::size_t i = 0; i < flat.size(); ++i) {
    const Triangle& t = soup.triangles[i];
    flat[i] = !has_area(point(soup, t[0]), point(soup, t[1]), point(soup, t[2]));
  }
  return flat;
}

/// The corner opposite to the longest edge, which in a flat triangle lies between the two others.
std::size_t corner_between(const TriangleSoup& soup, const Triangle& t) {
  const auto length = [&](std::size_t k) {
    return (point(soup, t[(k + 1) % 3]) - point(soup, t[(k + 2) % 3])).squaredNorm();
  };
  std::size_t best = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (length(k) > length(best)) best = k;
  return best;
}

/// The uses of the edge between a and b.
std::span<const EdgeUse> uses_of(const std::vector<EdgeUse>& edges, int a, int b) {
  const std::array<int, 2> ends{std::min(a, b), std::max(a, b)};
  const auto first = std::lower_bound(edges.begin(), edges.end(), ends,
                                      [](const EdgeUse& use, const auto& wanted) { return use.ends < wanted; });
  auto last = first;
  while (last != edges.end() && last->ends == ends) ++last;
  return {first, last};
}

/// One pass over the flat triangles. Each triangle is changed at most once, because the list of edges is made before.
class FlatPass {
 public:
  FlatPass(TriangleSoup& soup, const std::vector<bool>& flat)
      : soup_(soup), edges_(sorted_edges(soup.triangles)), is_changed_(flat.size()), is_dropped_(flat.size()) {
    for (std::size_t t = 0; t < flat.size(); ++t)
      if (flat[t] && !is_changed_[t]) resolve(t);
    keep_only(soup_, is_dropped_);
  }

  [[nodiscard]] bool changed_any() const { return changed_any_; }

 private:
  /// Splits the neighbour beyond the longest edge of a flat triangle, or drops the triangle if it has none there.
  void resolve(std::size_t t) {
    const Triangle flat = soup_.triangles[t];
    const std::size_t k = corner_between(soup_, flat);
    const int b = flat[k];
    const int c = flat[(k + 1) % 3];
    const int a = flat[(k + 2) % 3];
    const auto uses = uses_of(edges_, a, c);
    if (uses.size() > 2) return;
    if (uses.size() == 2) {
      const auto n = static_cast<std::size_t>(uses[0].triangle) == t ? static_cast<std::size_t>(uses[1].triangle)
                                                                     : static_cast<std::size_t>(uses[0].triangle);
      if (is_changed_[n]) return;
      split(n, t, a, b, c);
    } else {
      is_dropped_[t] = true;
    }
    is_changed_[t] = true;
    changed_any_ = true;
  }

  /// Triangle n on the edge a-c becomes two, with b between; the second takes the place of t.
  void split(std::size_t n, std::size_t t, int a, int b, int c) {
    const Triangle whole = soup_.triangles[n];
    std::replace(soup_.triangles[n].begin(), soup_.triangles[n].end(), a, b);
    soup_.triangles[t] = whole;
    std::replace(soup_.triangles[t].begin(), soup_.triangles[t].end(), c, b);
    is_changed_[n] = true;
  }

  TriangleSoup& soup_;
  std::vector<EdgeUse> edges_;
  std::vector<bool> is_changed_;
  std::vector<bool> is_dropped_;
  bool changed_any_ = false;
};

}  // namespace

SurfaceFinding drop_collapsed(TriangleSoup& soup) {
  SurfaceFinding finding{.what = "facets with two corners in one point"};
  std::vector<bool> dropped(soup.triangles.size());
  for (std::size_t i = 0; i < dropped.size(); ++i) {
    const Triangle& t = soup.triangles[i];
    dropped[i] = t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
    if (dropped[i]) finding.add(middle(soup, t));
  }
  keep_only(soup, dropped);
  return finding;
}

DroppedDuplicates drop_duplicates(TriangleSoup& soup) {
  std::vector<std::tuple<Triangle, int>> order;
  order.reserve(soup.triangles.size());
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    order.emplace_back(ascending(soup.triangles[t]), static_cast<int>(t));
  std::sort(order.begin(), order.end());
  DroppedDuplicates result{{.what = "facets that stood more than once"}, {}};
  std::vector<bool> dropped(order.size());
  std::vector<bool> has_opposite(order.size());
  std::size_t first = 0;
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (std::get<0>(order[i]) != std::get<0>(order[first])) {
      first = i;
      continue;
    }
    const auto kept = static_cast<std::size_t>(std::get<1>(order[first]));
    const auto twin = static_cast<std::size_t>(std::get<1>(order[i]));
    dropped[twin] = true;
    if (is_even(soup.triangles[kept]) != is_even(soup.triangles[twin])) has_opposite[kept] = true;
    result.dropped.add(middle(soup, soup.triangles[twin]));
  }
  int number = 0;
  for (std::size_t t = 0; t < dropped.size(); ++t) {
    if (has_opposite[t]) result.opposite.push_back(number);
    if (!dropped[t]) ++number;
  }
  keep_only(soup, dropped);
  return result;
}

SplitFlat split_flat(TriangleSoup& soup) {
  constexpr int most_passes = 32;
  SplitFlat result{{.what = "facets without area"},
                   {.what = "facets without area that have no neighbour to be joined to",
                    .remedy = "merge points within a tolerance"}};
  for (int pass = 0;; ++pass) {
    const std::vector<bool> flat = flat_triangles(soup);
    result.left.count = 0;
    for (std::size_t t = 0; t < flat.size(); ++t)
      if (flat[t]) result.left.add(middle(soup, soup.triangles[t]));
    if (pass == 0) {
      result.removed.count = result.left.count;
      result.removed.first_m = result.left.first_m;
    }
    if (result.left.count == 0 || pass == most_passes || !FlatPass(soup, flat).changed_any()) break;
  }
  result.removed.count = std::max(0, result.removed.count - result.left.count);
  return result;
}

}  // namespace thinwall::mesh
