#include "io/surface_file.hpp"

#include "core/error.hpp"
#include "io/obj.hpp"
#include "io/off.hpp"
#include "io/ply.hpp"
#include "io/stl.hpp"
#include "io/surface_text.hpp"
#include "io/surface_unit.hpp"

namespace thinwall::io {

mesh::TriangleSoup read_surface(const std::filesystem::path& path, const std::string& unit) {
  const double metres = metres_per_unit(unit, path.string());
  const std::string extension = lower_case(path.extension().string());
  if (extension == ".stl") return read_stl(path, metres);
  if (extension == ".off") return read_off(path, metres);
  if (extension == ".obj") return read_obj(path, metres);
  if (extension == ".ply") return read_ply(path, metres);
  throw core::InputError("\"" + path.string() + "\" is no surface that is read; give .stl, .off, .obj or .ply");
}

}  // namespace thinwall::io
