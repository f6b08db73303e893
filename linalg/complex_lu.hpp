#pragma once
// LU factors of a dense complex matrix.

#include <Eigen/Core>
#include <vector>

namespace thinwall::linalg {

/// P A = L U of a square complex matrix with row pivots, by LAPACK's zgetrf on one thread, which takes a third of the
/// time of Eigen's from some forty rows on (Golub & Van Loan 2013, 3.4). Of a singular matrix the solutions are not
/// finite. Cost 8/3 n³, then 8 n² a solution.
class ComplexLu {
 public:
  explicit ComplexLu(Eigen::MatrixXcd A);

  /// x of A x = b.
  [[nodiscard]] Eigen::VectorXcd solve(const Eigen::VectorXcd& b) const { return solved('N', b); }

  /// x of Aᵀ x = b, transposed without conjugation.
  [[nodiscard]] Eigen::VectorXcd solve_transposed(const Eigen::VectorXcd& b) const { return solved('T', b); }

 private:
  [[nodiscard]] Eigen::VectorXcd solved(char transposed, const Eigen::VectorXcd& b) const;

  Eigen::MatrixXcd factors_;
  std::vector<int> pivots_;
};

}  // namespace thinwall::linalg
