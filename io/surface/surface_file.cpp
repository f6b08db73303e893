#include "io/surface/surface_file.hpp"

#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "io/surface/gltf.hpp"
#include "io/surface/obj.hpp"
#include "io/surface/off.hpp"
#include "io/surface/ply.hpp"
#include "io/surface/step.hpp"
#include "io/surface/stl.hpp"
#include "io/surface/three_mf.hpp"
#include "io/surface_text.hpp"
#include "io/surface_unit.hpp"

namespace thinwall::io {

namespace {

/// The triangles of a file that states its unit, with which the caller's must agree.
template <class Surface>
mesh::TriangleSoup in_its_unit(Surface (*read)(const std::filesystem::path&), const std::filesystem::path& path,
                               const std::string& unit) {
  const double metres = unit.empty() ? 0.0 : metres_per_unit(unit, path.string());
  Surface found = read(path);
  if (metres > 0.0 && !(std::abs(metres / found.metres_per_unit - 1.0) <= 1e-9)) {
    throw core::InputError("the unit of \"" + path.string() + "\" is given as \"" + unit + "\", but the file is in " +
                           found.unit + "; leave the unit out, or export the part again");
  }
  return std::move(found.soup);
}

}  // namespace

mesh::TriangleSoup read_surface(const std::filesystem::path& path, const std::string& unit) {
  const std::string extension = lower_case(path.extension().string());
  if (extension == ".step" || extension == ".stp")
    return in_its_unit<StepSurface>([](const std::filesystem::path& file) { return read_step(file); }, path, unit);
  if (extension == ".3mf") return in_its_unit<ThreeMfSurface>(read_three_mf, path, unit);
  if (extension == ".glb" || extension == ".gltf") return in_its_unit<GltfSurface>(read_gltf, path, unit);
  const double metres = metres_per_unit(unit, path.string());
  if (extension == ".stl") return read_stl(path, metres);
  if (extension == ".off") return read_off(path, metres);
  if (extension == ".obj") return read_obj(path, metres);
  if (extension == ".ply") return read_ply(path, metres);
  throw core::InputError("\"" + path.string() +
                         "\" is no surface that is read; give .stl, .off, .obj, .ply, .3mf, .glb, .gltf or .step");
}

}  // namespace thinwall::io
