#include "fem/harmonic_extension.hpp"

#include <Eigen/LU>

#include "fem/reference_element.hpp"

namespace thinwall::fem {

namespace {

/// The matrix ∫ ∇N_a · ∇N_b dV of a straight element, V Σ_kl (g_k · g_l) D̂^{kl}_ab with g_k = ∇ξ_k.
Eigen::MatrixXd element_matrix(const mesh::LagrangeNodes& nodes, Eigen::Index element) {
  const ReferenceElement& reference = reference_element(nodes.order);
  Eigen::Matrix3d edges;
  for (Eigen::Index k = 0; k < 3; ++k)
    edges.col(k) =
        (nodes.positions.row(nodes.elements(element, k + 1)) - nodes.positions.row(nodes.elements(element, 0)))
            .transpose();
  const Eigen::Matrix3d gradients = edges.inverse().transpose();  // g_k as columns
  const Eigen::Matrix3d inner = edges.determinant() / 6.0 * gradients.transpose() * gradients;
  const Eigen::RowVectorXd sum = Eigen::Map<const Eigen::RowVectorXd>(inner.data(), 9) * reference.stiffness;
  return Eigen::Map<const Eigen::MatrixXd>(sum.data(), reference.nodes, reference.nodes);
}

}  // namespace

HarmonicExtension::HarmonicExtension(const mesh::LagrangeNodes& nodes, const std::vector<bool>& given) {
  std::vector<int> row(given.size(), -1);
  for (std::size_t node = 0; node < given.size(); ++node) {
    if (given[node]) continue;
    row[node] = static_cast<int>(free_.size());
    free_.push_back(static_cast<int>(node));
  }
  std::vector<Eigen::Triplet<double>> free_entries, coupling_entries;
  for (Eigen::Index e = 0; e < nodes.elements.rows(); ++e) {
    const Eigen::MatrixXd A = element_matrix(nodes, e);
    for (Eigen::Index b = 0; b < A.cols(); ++b) {
      const int column = nodes.elements(e, b);
      for (Eigen::Index a = 0; a < A.rows(); ++a) {
        const int at = row[static_cast<std::size_t>(nodes.elements(e, a))];
        if (at < 0) continue;
        const int free_column = row[static_cast<std::size_t>(column)];
        if (free_column >= 0) free_entries.emplace_back(at, free_column, A(a, b));
        else coupling_entries.emplace_back(at, column, A(a, b));
      }
    }
  }
  const auto size = static_cast<Eigen::Index>(free_.size());
  coupling_.resize(size, static_cast<Eigen::Index>(given.size()));
  coupling_.setFromTriplets(coupling_entries.begin(), coupling_entries.end());
  if (free_.empty()) return;
  linalg::SparseMatrix A(size, size);
  A.setFromTriplets(free_entries.begin(), free_entries.end());
  factor_.emplace(A, free_);
}

Eigen::MatrixXd HarmonicExtension::extended(const Eigen::MatrixXd& values) const {
  Eigen::MatrixXd result = values;
  if (!factor_) return result;
  const Eigen::MatrixXd found = factor_->solve(-(coupling_ * values));
  for (std::size_t i = 0; i < free_.size(); ++i) result.row(free_[i]) = found.row(static_cast<Eigen::Index>(i));
  return result;
}

}  // namespace thinwall::fem
