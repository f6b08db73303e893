#include "setup/part.hpp"

#include <algorithm>

#include "core/overloaded.hpp"
#include "setup/imported_part.hpp"

namespace thinwall::setup {

namespace {

Eigen::AlignedBox3d bounds(const BoxShape& shape) {
  Eigen::AlignedBox3d box;
  box.min().setZero();
  box.max()[shape.length_axis] = shape.length;
  box.max()[shape.height_axis] = shape.height;
  box.max()[shape.thickness_axis] = shape.thickness;
  return box;
}

Eigen::AlignedBox3d bounds(const mesh::Prism& prism) {
  Eigen::AlignedBox3d box;
  for (const auto& corner : prism.outline) box.extend(Eigen::Vector3d(corner.x(), corner.y(), prism.bottom));
  if (!box.isEmpty()) box.max().z() = prism.top;
  for (const auto& zone : prism.zones) {
    box.min().z() = std::min(box.min().z(), zone.bottom);
    box.max().z() = std::max(box.max().z(), zone.top);
  }
  return box;
}

}  // namespace

Eigen::AlignedBox3d bounds(const Part& part) {
  return std::visit(
      core::overloaded{
          [](const BoxShape& box) { return bounds(box); }, [](const PrismShape& shape) { return bounds(shape.prism); },
          [&](const auto& /*from a file*/) { return part.imported ? part.imported->box : Eigen::AlignedBox3d(); }},
      part.shape);
}

const Bend* bend(const Part& part) {
  const auto given = [](const std::optional<Bend>& bend) { return bend ? &*bend : nullptr; };
  if (const auto* box = std::get_if<BoxShape>(&part.shape)) return given(box->bend);
  if (const auto* prism = std::get_if<PrismShape>(&part.shape)) return given(prism->bend);
  return nullptr;
}

const PartFile* shape_file(const Part& part) {
  if (const auto* surface = std::get_if<SurfaceShape>(&part.shape)) return &surface->file;
  const auto* mesh = std::get_if<MeshShape>(&part.shape);
  return mesh != nullptr ? &mesh->file : nullptr;
}

std::string file_unit(const Part& part) {
  if (const PartFile* file = shape_file(part)) return file->unit;
  const auto* matrices = std::get_if<MatrixShape>(&part.shape);
  return matrices != nullptr ? matrices->files.length_unit : "";
}

double usual_tolerance(const Part& part) {
  return kind(part) == ShapeKind::surface ? 1e-2 : 1e-3;
}

std::optional<double> usual_time_budget(const Part& part) {
  return kind(part) == ShapeKind::surface ? std::optional(30.0) : std::nullopt;
}

bool may_be_held(const Part& part) {
  return !part.supports.empty() || !part.clamps.empty() || !part.springs.empty() || kind(part) == ShapeKind::matrices;
}

Eigen::Vector3d box_size(const Part& part) {
  return bounds(part).sizes();
}

Eigen::Vector3d position(const Part& part, const Point& point) {
  if (point.position) return *point.position + point.offset;
  if (part.imported && (point.node || kind(part) == ShapeKind::matrices))
    return node_position(part, node_of(*part.imported, point).value_or(-1));
  return bounds(part).min() + point.at->cwiseProduct(box_size(part)) + point.offset;
}

}  // namespace thinwall::setup
