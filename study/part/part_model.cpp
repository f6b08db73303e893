#include "study/part/part_model.hpp"

#include "fem/points.hpp"
#include "mesh/solid/tessellation.hpp"
#include "setup/imported_part.hpp"
#include "setup/part_attachments.hpp"
#include "setup/part_geometry.hpp"
#include "setup/part_materials.hpp"
#include "study/part/matrix_part.hpp"

namespace thinwall::study {

namespace {

/// The mesh of a file with its own nodes, or with those of a higher order; curved where its own are.
fem::Model mesh_model(const setup::PartSetup& source, int order, const fem::Materials& materials) {
  mesh::SolidMesh solid = source.part->imported->mesh->solid;
  if (order >= 2) solid = mesh::with_order(std::move(solid), 2);
  mesh::LagrangeNodes nodes = order <= 2                     ? solid.nodes
                              : solid.midside_offset <= 1e-6 ? mesh::lagrange_nodes(solid.mesh, order)
                                                             : mesh::nodes_of_order(solid.mesh, solid.nodes, order);
  std::vector<int> fixed = fem::fixed_rows(solid.mesh, nodes, setup::supports_of(source));
  for (const int row : setup::rows_held_by_sets(source, solid, nodes)) fixed.push_back(row);
  return fem::build_model(std::move(solid.mesh), std::move(nodes), materials, fixed, setup::attachments_of(source));
}

}  // namespace

fem::Model part_model(const setup::PartSetup& source, mesh::TetMesh mesh, int order) {
  const fem::Materials materials = setup::materials_on(source, mesh);
  if (setup::kind(*source.part) == setup::ShapeKind::mesh) return mesh_model(source, order, materials);
  return fem::supported_model(std::move(mesh), order, materials, setup::supports_of(source),
                              setup::shaping(*source.part), setup::attachments_of(source));
}

reduction::Interface part_interface(const setup::PartSetup& source, const fem::Model& model) {
  if (setup::kind(*source.part) == setup::ShapeKind::matrices) return matrix_interface(source);
  reduction::Interface interface;
  std::vector<Eigen::Triplet<double>> entries;
  for (const std::string& name : source.reduction.interface) {
    const setup::Point& p = setup::point(source, name);
    const linalg::SparseMatrix columns = fem::point_columns(model, setup::named_point(source, name));
    for (Eigen::Index j = 0; j < columns.cols(); ++j) {
      for (linalg::SparseMatrix::InnerIterator it(columns, j); it; ++it) {
        entries.emplace_back(static_cast<int>(it.row()), static_cast<int>(interface.dofs.size()), it.value());
      }
      interface.dofs.push_back({p.name, p.directions[static_cast<std::size_t>(j)], dynamics::DofKind::translation});
    }
  }
  interface.W.resize(model.K.rows(), static_cast<Eigen::Index>(interface.dofs.size()));
  interface.W.setFromTriplets(entries.begin(), entries.end());
  return interface;
}

}  // namespace thinwall::study
