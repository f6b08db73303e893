#include "mesh/polyline.hpp"

#include <algorithm>
#include <limits>

namespace thinwall::mesh {

namespace {

Eigen::Vector3d nearest_on_segment(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& x) {
  const Eigen::Vector3d along = b - a;
  const double squared = along.squaredNorm();
  const double s = squared > 0.0 ? std::clamp((x - a).dot(along) / squared, 0.0, 1.0) : 0.0;
  return a + s * along;
}

void keep_needed(const Polyline& line, std::size_t first, std::size_t last, double tolerance, std::vector<bool>& kept) {
  double farthest = tolerance;
  std::size_t at = last;
  for (std::size_t i = first + 1; i < last; ++i) {
    const double distance = (line[i] - nearest_on_segment(line[first], line[last], line[i])).norm();
    if (distance > farthest) {
      farthest = distance;
      at = i;
    }
  }
  if (at == last) return;
  kept[at] = true;
  keep_needed(line, first, at, tolerance, kept);
  keep_needed(line, at, last, tolerance, kept);
}

}  // namespace

Eigen::Vector3d nearest_on(const Polyline& line, const Eigen::Vector3d& x) {
  Eigen::Vector3d nearest = line.front();
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Eigen::Vector3d candidate = nearest_on_segment(line[i], line[i + 1], x);
    const double distance = (candidate - x).squaredNorm();
    if (distance < smallest) {
      smallest = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

Polyline simplified(const Polyline& line, double tolerance_m) {
  std::vector<bool> kept(line.size(), false);
  kept.front() = kept.back() = true;
  keep_needed(line, 0, line.size() - 1, tolerance_m, kept);
  Polyline result;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (kept[i]) result.push_back(line[i]);
  return result;
}

}  // namespace thinwall::mesh
