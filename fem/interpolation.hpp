#pragma once
// Interpolation of displacements from one order of elements to another on the same mesh.

#include "fem/model.hpp"

namespace thinwall::fem {

/// The values N_b(α_a / p) of the shape functions of order `from` at the nodes of order `to`, n_to × n_from.
[[nodiscard]] Eigen::MatrixXd values_at_nodes(int from, int to);

/// The displacements Phi of the model `from`, interpolated to the free DOFs of the model `to`: u(x_a) = Σ_b N_b(λ_a)
/// u_b at each node a of `to`, with N and u those of `from` and λ_a = α_a / p the place of the node in its element.
/// Both models must have the same mesh and supports; their orders may differ. Phi: free rows of `from` × m; result:
/// free rows of `to` × m. Displacements that `to` can represent are carried over exactly. Cost 6 m n_from n_to flops an
/// element with n nodes.
[[nodiscard]] Eigen::MatrixXd interpolated(const Model& from, const Eigen::MatrixXd& Phi, const Model& to);

}  // namespace thinwall::fem
