#include "fem/interpolation.hpp"

#include "fem/reference_element.hpp"

namespace thinwall::fem {

Eigen::MatrixXd values_at_nodes(int from, int to) {
  const auto alphas = mesh::lattice(to);
  Eigen::MatrixXd N(static_cast<Eigen::Index>(alphas.size()), (from + 1) * (from + 2) * (from + 3) / 6);
  for (std::size_t a = 0; a < alphas.size(); ++a) {
    const Eigen::Vector4i alpha(alphas[a].data());
    N.row(static_cast<Eigen::Index>(a)) = shape_functions(from, alpha.cast<double>() / to).transpose();
  }
  return N;
}

Eigen::MatrixXd interpolated(const Model& from, const Eigen::MatrixXd& Phi, const Model& to) {
  const Eigen::MatrixXd N = values_at_nodes(from.nodes.order, to.nodes.order);
  Eigen::MatrixXd result(static_cast<Eigen::Index>(to.free_rows.size()), Phi.cols());
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> at_nodes(to.nodes.positions.rows(), 3);
  for (Eigen::Index mode = 0; mode < Phi.cols(); ++mode) {
    const auto u = displacements(from, Phi.col(mode));
    for (Eigen::Index e = 0; e < to.nodes.elements.rows(); ++e) {
      const Eigen::MatrixX3d of_element = u(from.nodes.elements.row(e), Eigen::all);
      at_nodes(to.nodes.elements.row(e), Eigen::all) = N * of_element;
    }
    result.col(mode) = on_rows(to, at_nodes);
  }
  return result;
}

}  // namespace thinwall::fem
