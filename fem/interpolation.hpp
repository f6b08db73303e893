#pragma once
// Displacements carried from one order of elements to another on the same mesh.

#include "fem/model.hpp"

namespace thinwall::fem {

/// The values of given displacements at the free DOFs of another model: u(x_a) = Σ_b N_b(λ_a) u_b at the nodes a of
/// `to`, N and u those of `from`, λ_a = α_a / p the place of the node in its element. Both models must be of one mesh,
/// with the same supports; orders may differ. Phi: free rows of `from` × m; result: free rows of `to` × m. What `to`
/// can represent is carried over exactly. Cost 6 m n_from n_to flops an element with n nodes.
[[nodiscard]] Eigen::MatrixXd interpolated(const Model& from, const Eigen::MatrixXd& Phi, const Model& to);

}  // namespace thinwall::fem
