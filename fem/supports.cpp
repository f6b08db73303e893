#include "fem/supports.hpp"

namespace thinwall::fem {

std::vector<int> fixed_rows(const mesh::TetMesh& mesh, const mesh::LagrangeNodes& nodes,
                            const std::vector<Support>& supports) {
  const auto boundary = mesh::boundary(mesh);
  std::vector<int> fixed;
  for (const Support& support : supports) {
    const auto held = mesh::nodes_on(nodes, mesh, mesh::select(mesh, boundary, support.region, support.name));
    const auto rows = rows_of(held, support.axes);
    fixed.insert(fixed.end(), rows.begin(), rows.end());
  }
  return fixed;
}

Model supported_model(mesh::TetMesh mesh, int order, const Materials& materials, const std::vector<Support>& supports,
                      const Shaping& shape, const Attachments& attachments) {
  mesh::LagrangeNodes nodes = mesh::lagrange_nodes(mesh, order);
  const auto fixed = fixed_rows(mesh, nodes, supports);
  if (shape) shape(nodes);
  return build_model(std::move(mesh), std::move(nodes), materials, fixed, attachments);
}

Model supported_model(mesh::TetMesh mesh, int order, const Material& material, const std::vector<Support>& supports,
                      const Shaping& shape, const Attachments& attachments) {
  return supported_model(std::move(mesh), order, Materials{{material}, {}}, supports, shape, attachments);
}

}  // namespace thinwall::fem
