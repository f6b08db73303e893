#include "mesh/solid/labelled_mesh.hpp"

#include "core/error.hpp"

namespace thinwall::mesh {

void fail_at(const LabelledMesh& mesh, std::int64_t line, const std::string& what) {
  throw core::DataError(mesh.path + ":" + (line > 0 ? std::to_string(line) + ":" : "") + " " + what);
}

}  // namespace thinwall::mesh
