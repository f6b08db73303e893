#include "report/geometry_summary.hpp"

#include <nlohmann/json.hpp>

namespace thinwall::report {

namespace {

nlohmann::json vector_json(const Eigen::Vector3d& x) {
  return {x.x(), x.y(), x.z()};
}

void add_surface(nlohmann::json& result, const mesh::SurfaceRepair& surface) {
  result["triangles"] = surface.surface.triangles.size();
  result["volume_m3"] = surface.volume_m3;
  result["largest_movement_m"] = surface.largest_movement_m;
  result["mended"] = nlohmann::json::array();
  for (const auto& found : surface.mended)
    result["mended"].push_back({{"what", found.what}, {"count", found.count}, {"first_m", vector_json(found.first_m)}});
}

}  // namespace

nlohmann::json geometry_summary(const setup::Part& part) {
  const setup::ImportedPart& imported = *part.imported;
  nlohmann::json result = {
      {"file", setup::main_file(part).filename().string()}, {"unit", setup::file_unit(part)}, {"read", imported.said}};
  result["size_m"] = imported.box.isEmpty() ? nlohmann::json(nullptr) : vector_json(imported.box.sizes());
  result["notes"] = imported.notes;
  if (imported.surface) add_surface(result, *imported.surface);
  if (imported.mesh) result["least_jacobian"] = imported.mesh->solid.least_jacobian;
  return result;
}

}  // namespace thinwall::report
