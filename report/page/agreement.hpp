#pragma once
// Agreement of a fitted receptance with the measured one.

#include <Eigen/Core>
#include <optional>

namespace thinwall::report {

/// Two figures over the lines that both have.
struct Agreement {
  double frac = 0.0;   ///< |Σ H̄ G|²/(Σ|H|² Σ|G|²) (Heylen & Lammens 1996)
  double error = 0.0;  ///< (Σ|G − H|²/Σ|H|²)^½
};

/// The agreement of a fit G with a measured H, lines where G is NaN left out; none where one of the two is zero on all
/// lines.
[[nodiscard]] std::optional<Agreement> agreement_of(const Eigen::VectorXcd& H, const Eigen::VectorXcd& G);

}  // namespace thinwall::report
