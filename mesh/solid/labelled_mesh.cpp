#include "mesh/solid/labelled_mesh.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace thinwall::mesh {

std::string place_of(const LabelledMesh& mesh, std::int64_t line) {
  if (line <= 0) return mesh.path;
  const auto next =
      std::upper_bound(mesh.origins.begin(), mesh.origins.end(), line,
                       [](std::int64_t wanted, const LineOrigin& origin) { return wanted < origin.first; });
  if (next == mesh.origins.begin()) return mesh.path + ":" + std::to_string(line);
  const LineOrigin& origin = *(next - 1);
  return origin.path + ":" + std::to_string(line - origin.first + origin.line);
}

void fail_at(const LabelledMesh& mesh, std::int64_t line, const std::string& what) {
  throw core::DataError(place_of(mesh, line) + ": " + what);
}

}  // namespace thinwall::mesh
