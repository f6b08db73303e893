#include "fem/points.hpp"

#include <map>
#include <sstream>

#include "core/error.hpp"
#include "fem/reference_element.hpp"
#include "mesh/locate.hpp"

namespace thinwall::fem {

linalg::SparseMatrix point_columns(const Model& model, const NamedPoint& point) {
  std::map<int, double> weight_of_node;
  try {
    for (const mesh::PatchSample& sample :
         mesh::patch_samples(model.mesh, mesh::boundary(model.mesh), point.position_m, point.patch_radius_m)) {
      const Eigen::VectorXd N = shape_functions(model.nodes.order, sample.location.lambda);
      for (Eigen::Index a = 0; a < N.size(); ++a)
        weight_of_node[model.nodes.elements(sample.location.tet, a)] += sample.weight * N(a);
    }
  } catch (const core::InputError& error) {
    throw core::InputError("point \"" + point.name + "\": " + error.what());
  }
  std::vector<int> row_of(3 * static_cast<std::size_t>(model.nodes.positions.rows()), -1);
  for (std::size_t i = 0; i < model.free_rows.size(); ++i)
    row_of[static_cast<std::size_t>(model.free_rows[i])] = static_cast<int>(i);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t d = 0; d < point.directions.size(); ++d) {
    double movable = 0.0;
    for (const auto& [node, weight] : weight_of_node) {
      for (int axis = 0; axis < 3; ++axis) {
        const double value = weight * point.directions[d](axis);
        const int row = row_of[3 * static_cast<std::size_t>(node) + static_cast<std::size_t>(axis)];
        if (row < 0 || std::abs(value) < 1e-15) continue;
        entries.emplace_back(row, static_cast<int>(d), value);
        movable += std::abs(value);
      }
    }
    if (movable < 1e-9) {
      std::ostringstream text;
      text << "point \"" << point.name << "\" cannot move in direction (" << point.directions[d].transpose()
           << "): it lies on a support; move the point or leave the direction out";
      throw core::InputError(text.str());
    }
  }
  linalg::SparseMatrix W(model.K.rows(), static_cast<Eigen::Index>(point.directions.size()));
  W.setFromTriplets(entries.begin(), entries.end());
  return W;
}

}  // namespace thinwall::fem
