#include "app/imported_part.hpp"

#include <algorithm>
#include <array>

#include "core/error.hpp"
#include "core/units.hpp"
#include "io/surface_file.hpp"

namespace thinwall::app {

namespace {

constexpr std::array surface_endings{".stl", ".off", ".obj", ".ply"};

std::string ending(const std::filesystem::path& file) {
  std::string text = file.extension().string();
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c; });
  return text;
}

/// A place of the file in the digits that part.origin takes.
std::string as_origin(const Eigen::Vector3d& x) {
  std::string list;
  for (int i = 0; i < 3; ++i) list += (i == 0 ? "[" : ", ") + core::readable_text(x[i], core::kind::length);
  return list + "]";
}

ImportedPart read_surface_part(const PartFile& file) {
  mesh::TriangleSoup soup = io::read_surface(file.path, file.unit);
  for (auto& x : soup.points) x -= file.origin;
  ImportedPart part;
  part.surface = mesh::repaired_surface(soup, file.repair);
  if (part.surface->moved_by != Eigen::Vector3d::Zero()) {
    throw core::InputError("the part lies far from the origin for its size of " + mesh::size_text(soup) +
                           "; set part.origin to a place on it, such as " +
                           as_origin(file.origin - part.surface->moved_by));
  }
  for (const auto& x : part.surface->surface.vertices) part.box.extend(x);
  part.said = mesh::size_text(soup) + ", " + std::to_string(part.surface->surface.triangles.size()) +
              " triangles; mended: " + mesh::text(*part.surface);
  return part;
}

}  // namespace

std::string shape_of_file(const std::filesystem::path& file) {
  return std::ranges::find(surface_endings, ending(file)) != surface_endings.end() ? "surface" : "";
}

bool from_file(const Part& part) {
  return part.shape == "surface";
}

std::shared_ptr<const ImportedPart> read_part_file(const Part& part) {
  try {
    return std::make_shared<ImportedPart>(read_surface_part(part.file));
  } catch (const core::InputError& error) {
    throw core::InputError("part.file " + part.file.path.string() + ": " + error.what());
  }
}

nlohmann::json geometry_summary(const Part& part) {
  const ImportedPart& imported = *part.imported;
  const Eigen::Vector3d size = imported.box.sizes();
  nlohmann::json result = {{"file", part.file.path.filename().string()},
                           {"unit", part.file.unit},
                           {"size_m", {size.x(), size.y(), size.z()}},
                           {"read", imported.said}};
  const mesh::SurfaceRepair& surface = *imported.surface;
  result["triangles"] = surface.surface.triangles.size();
  result["volume_m3"] = surface.volume_m3;
  result["largest_movement_m"] = surface.largest_movement_m;
  result["mended"] = nlohmann::json::array();
  for (const auto& found : surface.mended) {
    const Eigen::Vector3d& x = found.first_m;
    result["mended"].push_back({{"what", found.what}, {"count", found.count}, {"first_m", {x.x(), x.y(), x.z()}}});
  }
  return result;
}

}  // namespace thinwall::app
