#pragma once
// Forces as polynomials between nodes, and what they do to a mode, integrated exactly.

#include <Eigen/Core>
#include <complex>
#include <vector>

namespace thinwall::milling {

/// Nodes in (0, 1) and weights of sum 1.
struct GaussRule {
  Eigen::VectorXd node;
  Eigen::VectorXd weight;
};

/// Gauss-Legendre on (0, 1): Newton's method on P_n by its recurrence, weights 2/((1 − x²) P_n'²) (Abramowitz & Stegun
/// 25.4.29). `count` ≥ 1. Cost O(count²).
[[nodiscard]] GaussRule gauss_legendre(int count);

/// ℓ_j(at) of the Lagrange polynomials of `node`.
[[nodiscard]] Eigen::VectorXd lagrange_polynomials(const Eigen::VectorXd& node, double at);

/// What polynomial forces of an element of unit length do to a mode u' = z u + ℓ_j(s), u(0) = 0:
///
///     inside(i, j) = ∫₀^{c_i} e^{z (c_i − s)} ℓ_j(s) ds,      end(j) = ∫₀¹ e^{z (1 − s)} ℓ_j(s) ds
struct ModeMoments {
  Eigen::MatrixXcd inside;
  Eigen::RowVectorXcd end;
};

/// Product integration at n Gauss nodes c_i: the exponential of each mode is integrated against the polynomials as it
/// is, so that stiff modes need no more nodes than their share of the force asks for. The integrals themselves are
/// Gauss sums with as many points as |z| needs; their integrands are entire, so that they converge to round-off.
class ProductRule {
 public:
  /// `nodes` ≥ 1; serves |z| ≤ `largest_exponent`.
  ProductRule(int nodes, double largest_exponent);

  [[nodiscard]] const Eigen::VectorXd& node() const { return node_; }

  /// Re z ≤ 0, |z| within what the rule serves. Cost O(nodes² points).
  [[nodiscard]] ModeMoments moments(std::complex<double> z) const;

  /// Its `end` alone. Cost O(nodes points).
  [[nodiscard]] Eigen::RowVectorXcd end(std::complex<double> z) const { return row(node_.size(), z); }

 private:
  [[nodiscard]] Eigen::RowVectorXcd row(Eigen::Index i, std::complex<double> z) const;

  Eigen::VectorXd node_;
  Eigen::VectorXd distance_;            ///< 1 − x of the points, decreasing
  std::vector<Eigen::MatrixXd> table_;  ///< for each c_i, last for 1: c_i weight_q ℓ_j(c_i x_q), points × nodes
};

}  // namespace thinwall::milling
