#include "setup/part.hpp"

#include <algorithm>

#include "setup/imported_part.hpp"

namespace thinwall::setup {

Eigen::AlignedBox3d bounds(const Part& part) {
  Eigen::AlignedBox3d box;
  if (from_file(part)) return part.imported ? part.imported->box : box;
  if (part.shape == PartShape::prism) {
    for (const auto& corner : part.prism.outline)
      box.extend(Eigen::Vector3d(corner.x(), corner.y(), part.prism.bottom));
    if (!box.isEmpty()) box.max().z() = part.prism.top;
    for (const auto& zone : part.prism.zones) {
      box.min().z() = std::min(box.min().z(), zone.bottom);
      box.max().z() = std::max(box.max().z(), zone.top);
    }
    return box;
  }
  box.min().setZero();
  box.max()[part.length_axis] = part.length;
  box.max()[part.height_axis] = part.height;
  box.max()[part.thickness_axis] = part.thickness;
  return box;
}

double usual_tolerance(const Part& part) {
  return part.shape == PartShape::surface ? 1e-2 : 1e-3;
}

bool may_be_held(const Part& part) {
  return !part.supports.empty() || !part.clamps.empty() || !part.springs.empty() || part.shape == PartShape::matrices;
}

Eigen::Vector3d box_size(const Part& part) {
  return bounds(part).sizes();
}

Eigen::Vector3d position(const Part& part, const Point& point) {
  if (point.position) return *point.position + point.offset;
  if (part.imported && (point.node || part.shape == PartShape::matrices))
    return node_position(part, node_of(*part.imported, point).value_or(-1));
  return bounds(part).min() + point.at->cwiseProduct(box_size(part)) + point.offset;
}

}  // namespace thinwall::setup
