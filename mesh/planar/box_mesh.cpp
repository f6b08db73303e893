#include "mesh/planar/box_mesh.hpp"

#include <utility>

#include "core/faults.hpp"

namespace thinwall::mesh {

TetMesh in_axes(TetMesh mesh, const std::array<int, 3>& axes) {
  const bool odd = (axes[1] - axes[0] + 3) % 3 != 1;
  for (auto& v : mesh.vertices) {
    Eigen::Vector3d x;
    for (int k = 0; k < 3; ++k) x[axes[static_cast<std::size_t>(k)]] = v[k];
    v = x;
  }
  if (odd) {
    for (auto& tet : mesh.tets) std::swap(tet[2], tet[3]);
  }
  return mesh;
}

TetMesh mesh_box(const Box& box, const PrismMeshOptions& options) {
  core::Faults faults;
  for (int k = 0; k < 3; ++k) {
    faults.require_number(box.size[k], box.size[k] > 0.0, "side " + std::string(1, "xyz"[k]), "length", "be positive");
  }
  faults.raise("box");
  int through = 0;
  box.size.minCoeff(&through);
  const std::array<int, 3> axes{through == 0 ? 1 : 0, through == 2 ? 1 : 2, through};
  const double u = box.size[axes[0]], v = box.size[axes[1]];
  const Prism prism{{{0.0, 0.0}, {u, 0.0}, {u, v}, {0.0, v}}, {}, 0.0, box.size[through], {}};
  return in_axes(mesh_prism(prism, options), axes);
}

}  // namespace thinwall::mesh
