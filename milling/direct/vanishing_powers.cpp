#include "milling/direct/vanishing_powers.hpp"

#include <cmath>

#include "core/interrupt.hpp"

namespace thinwall::milling {

namespace {

using Eigen::Index;

void balance(Eigen::MatrixXd& M) {
  for (int pass = 0; pass < 2; ++pass) {
    for (Index i = 0; i < M.rows(); ++i) {
      const double own = M(i, i) * M(i, i);
      const double row = M.row(i).squaredNorm() - own;
      const double column = M.col(i).squaredNorm() - own;
      if (!(row > 0.0) || !(column > 0.0)) continue;
      const double scale = std::sqrt(std::sqrt(column / row));
      M.row(i) *= scale;
      M.col(i) /= scale;
    }
  }
}

}  // namespace

bool powers_vanish(Eigen::MatrixXd M) {
  constexpr int most_squarings = 24;
  constexpr double largest = 100.0;  // beyond, round-off of a square, ε ‖M‖², is felt in later ones
  balance(M);
  Eigen::MatrixXd square(M.rows(), M.cols());
  for (int i = 0; i < most_squarings; ++i) {
    core::check_interrupt();
    const double norm = M.norm();
    if (norm < 0.9) return true;
    if (!(norm <= largest)) return false;
    square.noalias() = M * M;
    M.swap(square);
  }
  return false;
}

}  // namespace thinwall::milling
