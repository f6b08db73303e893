#pragma once
// Forces as polynomials between nodes, and what they do to a mode, integrated exactly.

#include <Eigen/Core>
#include <complex>
#include <vector>

namespace thinwall::milling {

/// The values ℓ_j(at) of the Lagrange polynomials of `node`.
[[nodiscard]] Eigen::VectorXd lagrange_polynomials(const Eigen::VectorXd& node, double at);

/// The slopes ℓ_j'(node_i) of these polynomials at one of the nodes.
[[nodiscard]] Eigen::VectorXd lagrange_slopes(const Eigen::VectorXd& node, Eigen::Index i);

/// The motion of modes under polynomial forces of an element of unit length, u_k' = z_k u_k + ℓ_j(s), u_k(0) = 0:
///
///     inside[i](k, j) = ∫₀^{c_i} e^{z_k (c_i − s)} ℓ_j(s) ds,      end(k, j) = ∫₀¹ e^{z_k (1 − s)} ℓ_j(s) ds
struct ModeMoments {
  std::vector<Eigen::MatrixXcd> inside;  ///< of each node, modes × nodes
  Eigen::MatrixXcd end;                  ///< modes × nodes
};

/// Product integration at n nodes c_i, Gauss's unless others are given: the exponential of each mode is integrated
/// against the polynomials as it is, so that stiff modes need no more nodes than their share of the force asks for: a
/// rule of quadrature on the nodes would have to resolve e^{z s}, although the force that it carries is smooth. The
/// integrals themselves are Gauss sums with as many points as |z| needs; their integrands are entire, so that they
/// converge to round-off. From node to node they are carried on: I(c_i) = e^{z (c_i − c_{i−1})} I(c_{i−1}) + ∫ between
/// the two.
class ProductRule {
 public:
  /// The rule of `nodes` ≥ 1 Gauss nodes, which serves |z| ≤ `largest_exponent`.
  ProductRule(int nodes, double largest_exponent);
  /// The rule of given nodes, ascending within [0, 1] and symmetric about ½.
  ProductRule(const Eigen::VectorXd& nodes, double largest_exponent);

  /// The nodes c_i.
  [[nodiscard]] const Eigen::VectorXd& node() const { return node_; }

  /// The moments of modes with Re z ≤ 0, |z| within what the rule serves. Cost O(modes nodes² points), in products of
  /// matrices.
  [[nodiscard]] ModeMoments moments(const Eigen::VectorXcd& z) const;

  /// ModeMoments::end of one mode alone. Cost O(nodes points).
  [[nodiscard]] Eigen::RowVectorXcd end(std::complex<double> z) const;

 private:
  Eigen::VectorXd node_;
  Eigen::ArrayXd distance_;                 ///< 1 − x of the points of the whole, decreasing
  Eigen::MatrixXd whole_;                   ///< weight_q ℓ_j(x_q), points × nodes
  Eigen::VectorXd gap_;                     ///< from 0 to the first node, between nodes, from the last to 1
  Eigen::ArrayXd gap_distance_;             ///< 1 − x of the points of a gap
  std::vector<Eigen::MatrixXd> gap_table_;  ///< as whole_, for each gap
};

/// A rule that serves the exponent, which is rounded up to a power of √2, at least 4: made once a thread, and kept for
/// its life.
[[nodiscard]] const ProductRule& shared_product_rule(int nodes, double exponent);

}  // namespace thinwall::milling
