#include "report/geometry_summary.hpp"

namespace thinwall::report {

namespace {

void add_surface(GeometrySummary& result, const mesh::SurfaceRepair& surface) {
  result.triangles = std::ssize(surface.surface.triangles);
  result.volume_m3 = surface.volume_m3;
  result.largest_movement_m = surface.largest_movement_m;
  result.mended.emplace();
  for (const auto& found : surface.mended) result.mended->push_back({found.what, found.count, found.first_m});
}

}  // namespace

GeometrySummary geometry_summary(const setup::Part& part) {
  const setup::ImportedPart& imported = *part.imported;
  GeometrySummary result;
  result.file = setup::main_file(part).filename().string();
  result.unit = setup::file_unit(part);
  result.read = imported.summary;
  if (!imported.box.isEmpty()) result.size_m = imported.box.sizes();
  result.notes = imported.notes;
  if (imported.surface) add_surface(result, *imported.surface);
  if (imported.mesh) result.least_jacobian = imported.mesh->solid.least_jacobian;
  return result;
}

}  // namespace thinwall::report
