#include "io/surface/surface_file.hpp"

#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "io/surface/obj.hpp"
#include "io/surface/off.hpp"
#include "io/surface/ply.hpp"
#include "io/surface/step.hpp"
#include "io/surface/stl.hpp"
#include "io/surface_text.hpp"
#include "io/surface_unit.hpp"

namespace thinwall::io {

namespace {

mesh::TriangleSoup read_step_in(const std::filesystem::path& path, const std::string& unit) {
  const double metres = unit.empty() ? 0.0 : metres_per_unit(unit, path.string());
  StepSurface found = read_step(path);
  if (metres > 0.0 && !(std::abs(metres / found.metres_per_unit - 1.0) <= 1e-9)) {
    throw core::InputError("the unit of \"" + path.string() + "\" is given as \"" + unit + "\", but the file is in " +
                           found.unit + "; leave the unit out, or export the part again");
  }
  return std::move(found.soup);
}

}  // namespace

mesh::TriangleSoup read_surface(const std::filesystem::path& path, const std::string& unit) {
  const std::string extension = lower_case(path.extension().string());
  if (extension == ".step" || extension == ".stp") return read_step_in(path, unit);
  const double metres = metres_per_unit(unit, path.string());
  if (extension == ".stl") return read_stl(path, metres);
  if (extension == ".off") return read_off(path, metres);
  if (extension == ".obj") return read_obj(path, metres);
  if (extension == ".ply") return read_ply(path, metres);
  throw core::InputError("\"" + path.string() + "\" is no surface that is read; give .stl, .off, .obj, .ply or .step");
}

}  // namespace thinwall::io
