#include "mesh/triangle_soup.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <unordered_map>

#include "core/error.hpp"

namespace thinwall::mesh {

namespace {

/// The indices of a cell of a grid of the tolerance's width, or the bits of a point's coordinates.
using Key = std::array<std::int64_t, 3>;

struct KeyHash {
  std::size_t operator()(const Key& key) const {
    std::uint64_t mixed = 0x9E3779B97F4A7C15U;
    for (const std::int64_t part : key) {
      mixed ^= static_cast<std::uint64_t>(part);
      mixed *= 0xBF58476D1CE4E5B9U;
      mixed ^= mixed >> 29U;
    }
    return static_cast<std::size_t>(mixed);
  }
};

/// Finds the first earlier point that is equal: a table of point numbers with open addressing, at most half full.
class EqualPoints {
 public:
  EqualPoints(const std::vector<Eigen::Vector3d>& points, std::size_t most)
      : points_(points), slots_(std::bit_ceil(2 * most + 1), none) {}

  /// The number of the point that x becomes; `own` if there is no earlier one, which is then remembered.
  int find_or_add(const Eigen::Vector3d& x, int own) {
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t slot = KeyHash()(bits(x)) & mask;; slot = (slot + 1) & mask) {
      if (slots_[slot] == none) return slots_[slot] = own;
      if (points_[static_cast<std::size_t>(slots_[slot])] == x) return slots_[slot];
    }
  }

 private:
  static constexpr int none = -1;

  static Key bits(const Eigen::Vector3d& x) {
    const Eigen::Vector3d y = x + Eigen::Vector3d::Zero();  // -0 becomes 0
    return {std::bit_cast<std::int64_t>(y(0)), std::bit_cast<std::int64_t>(y(1)), std::bit_cast<std::int64_t>(y(2))};
  }

  const std::vector<Eigen::Vector3d>& points_;
  std::vector<int> slots_;
};

/// Finds the first earlier point within a tolerance above 0.
class NearPoints {
 public:
  NearPoints(const std::vector<Eigen::Vector3d>& points, double tolerance_m)
      : points_(points), tolerance_(tolerance_m) {}

  /// The number of the point that x becomes, as in EqualPoints::find_or_add().
  int find_or_add(const Eigen::Vector3d& x, int own) {
    constexpr int no_point = std::numeric_limits<int>::max();
    const Key cell = cell_of(x);
    int found = no_point;
    for (std::int64_t i = -1; i <= 1; ++i)
      for (std::int64_t j = -1; j <= 1; ++j)
        for (std::int64_t k = -1; k <= 1; ++k)
          found = std::min(found, first_in({cell[0] + i, cell[1] + j, cell[2] + k}, x));
    if (found != no_point) return found;
    in_cell_[cell].push_back(own);
    return own;
  }

 private:
  /// The cell of x in a grid as wide as the tolerance. Beyond 2^53 cells from the origin doubles are further apart than
  /// the tolerance: only equal points are near each other, and the bits identify the cell, so that no cell ever holds
  /// many points.
  [[nodiscard]] Key cell_of(const Eigen::Vector3d& x) const {
    Key key{};
    for (int k = 0; k < 3; ++k) {
      const double cells = std::floor(x(k) / tolerance_);
      key[static_cast<std::size_t>(k)] =
          std::abs(cells) < 0x1p53 ? static_cast<std::int64_t>(cells) : std::bit_cast<std::int64_t>(x(k));
    }
    return key;
  }

  [[nodiscard]] int first_in(const Key& cell, const Eigen::Vector3d& x) const {
    const auto found = in_cell_.find(cell);
    if (found == in_cell_.end()) return std::numeric_limits<int>::max();
    for (const int p : found->second)
      if ((points_[static_cast<std::size_t>(p)] - x).norm() <= tolerance_) return p;
    return std::numeric_limits<int>::max();
  }

  const std::vector<Eigen::Vector3d>& points_;
  double tolerance_;
  std::unordered_map<Key, std::vector<int>, KeyHash> in_cell_;  ///< ascending; few, they are a tolerance apart
};

void require_point(const TriangleSoup& soup, std::size_t triangle, int point) {
  const std::string where = "triangle " + std::to_string(triangle) + " of the surface";
  if (point < 0 || static_cast<std::size_t>(point) >= soup.points.size()) {
    throw core::InputError(where + " names point " + std::to_string(point) + " of " +
                           std::to_string(soup.points.size()) + "; number the points from 0");
  }
  if (!soup.points[static_cast<std::size_t>(point)].allFinite()) {
    throw core::InputError(where + " has a corner that is not finite, " +
                           place_text(soup.points[static_cast<std::size_t>(point)]) + "; export the surface again");
  }
}

/// Replaces the points of all triangles by those that `earlier` finds among result.soup.points.
template <class Finder>
void merge(const TriangleSoup& soup, Finder earlier, MergedPoints& result) {
  constexpr int unseen = -1;
  std::vector<int> number(soup.points.size(), unseen);
  const auto number_of = [&](std::size_t p) {
    const int own = static_cast<int>(result.soup.points.size());
    const int found = earlier.find_or_add(soup.points[p], own);
    if (found == own) {
      result.soup.points.push_back(soup.points[p]);
      return own;
    }
    if (result.merged++ == 0) result.first_merged = soup.points[p];
    const double way = (soup.points[p] - result.soup.points[static_cast<std::size_t>(found)]).norm();
    result.largest_way = std::max(result.largest_way, way);
    return found;
  };
  result.soup.triangles.reserve(soup.triangles.size());
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    std::array<int, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      require_point(soup, t, soup.triangles[t][k]);
      const auto p = static_cast<std::size_t>(soup.triangles[t][k]);
      if (number[p] == unseen) number[p] = number_of(p);
      corners[k] = number[p];
    }
    result.soup.triangles.push_back(corners);
  }
  for (std::size_t p = 0; p < number.size(); ++p)
    if (number[p] == unseen && result.unused++ == 0) result.first_unused = soup.points[p];
}

}  // namespace

TriangleSoup soup(const TriangleSurface& surface) {
  return {surface.vertices, surface.triangles};
}

MergedPoints merged_points(const TriangleSoup& soup, double tolerance_m) {
  if (!(tolerance_m >= 0.0 && std::isfinite(tolerance_m))) {
    throw core::InputError("points of a surface are merged within " + std::to_string(tolerance_m) +
                           " m; give 0 or a positive length");
  }
  MergedPoints result;
  if (tolerance_m == 0.0) {
    merge(soup, EqualPoints(result.soup.points, soup.points.size()), result);
  } else {
    merge(soup, NearPoints(result.soup.points, tolerance_m), result);
  }
  return result;
}

SoupBounds bounds(const TriangleSoup& soup) {
  SoupBounds result;
  if (soup.triangles.empty()) return result;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  result.least.setConstant(infinity);
  result.largest.setConstant(-infinity);
  for (const auto& triangle : soup.triangles) {
    for (const int p : triangle) {
      const Eigen::Vector3d& x = soup.points[static_cast<std::size_t>(p)];
      result.least = result.least.cwiseMin(x);
      result.largest = result.largest.cwiseMax(x);
    }
  }
  return result;
}

std::string size_text(const TriangleSoup& soup) {
  const SoupBounds block = bounds(soup);
  const Eigen::Vector3d size_mm = 1e3 * (block.largest - block.least);
  char text[96];
  std::snprintf(text, sizeof text, "%.4g x %.4g x %.4g mm", size_mm(0), size_mm(1), size_mm(2));
  return text;
}

std::string place_text(const Eigen::Vector3d& x_m) {
  char text[96];
  std::snprintf(text, sizeof text, "(%.6g, %.6g, %.6g) mm", 1e3 * x_m(0), 1e3 * x_m(1), 1e3 * x_m(2));
  return text;
}

}  // namespace thinwall::mesh
