#pragma once
// A measured or computed receptance matrix as partial fractions, by vector fitting.

#include <Eigen/Core>
#include <complex>
#include <vector>

namespace thinwall::dynamics {

/// A receptance matrix as a sum over poles,
///
///     H(ω) = D + Σ_k [ R_k/(iω − λ_k) + conjugate of the same at −ω ]            (one term without the conjugate for a
///                                                                                real pole)
///
/// with λ_k in rad/s (Im ≥ 0), one for each conjugate pair or real pole, residues R_k in m/(N s) and the static part D
/// in m/N. All matrices have the same shape, responses × forces. Lines that no passive structure has may ask for poles
/// that grow (Re > 0).
struct PartialFractions {
  Eigen::VectorXcd poles;
  std::vector<Eigen::MatrixXcd> residues;
  Eigen::MatrixXd constant;
};

/// H(ω), responses × forces, m/N. Cost O(poles entries).
[[nodiscard]] Eigen::MatrixXcd value(const PartialFractions& sum, double omega_rad_s);

/// The partial fractions that come near to the lines H (at hz, ascending, at least six; all of one shape, finite, not
/// all zero) by relaxed vector fitting (Gustavsen and Semlyen 1999; Gustavsen 2006, Eq. 6 to 12), started from `poles`
/// (rad/s, Im ≥ 0). With the basis φ_n of the present poles
///
///     (c₀ + Σ c_n φ_n(ω)) H(ω) = d + Σ r_n φ_n(ω)      in least squares over the lines,
///
/// where c is common to all entries and r and d are not; the zeros of the factor on the left are the next poles, at
/// most twenty times, and the best on the way counts. Poles are left out that lie above four times the last line, or
/// whose half width is below a twentieth of the distance between lines, and residues and D follow by linear least
/// squares. Lines are weighed by 1/√‖H‖, so that neither the peaks nor what lies between them count alone. The poles
/// are found from the three linear combinations of the entries (real coefficients) that hold most of the matrix. Where
/// more than 1e-6 and less than a tenth of the lines is left, lines are weighed by the noise about each, twice, and the
/// poles brought to where the squares are least (variable projection, Kaufman 1975): in noise vector fitting ends
/// beside that. Throws InputError unless the lines are as said and more than twice as many as the unknowns of an entry,
/// NumericalError if an eigen-solution fails, as where an undamped pole lies on a line, Interrupted. Cost: a step
/// O(lines pairs²).
[[nodiscard]] PartialFractions vector_fit(const Eigen::VectorXd& hz, const std::vector<Eigen::MatrixXcd>& H,
                                          const Eigen::VectorXcd& poles);

/// vector_fit() with as many poles as the lines call for. From one pair on, up to 40, more are added where the fit
/// leaves most of the lines, as long as one of four attempts lowers the weighed or the plain residual by three tenths,
/// as noise does not, or neighbouring lines have the rest in common (a correlation above 0.3), as of many modes of one
/// size. The lines must be four times as many as the unknowns, so that every second line has the same poles. Where more
/// than 1e-6 of the lines is left, pairs that are sharper than the lines are close are left out again, and others added
/// where neighbouring lines have in common what noise has not, if they explain no less than the noise of twenty lines:
/// of modes that larger ones beside them hide, as long as there are no more than 40. Errors as vector_fit(). Cost: for
/// 6000 lines of four entries 0.1 s with 8 pairs and 1.8 s with 20, and with noise, where each hidden pair takes up to
/// twenty steps over all lines, 0.7 s with 8, 2.6 s with 20 and 7 s with 30.
[[nodiscard]] PartialFractions rational_fit(const Eigen::VectorXd& hz, const std::vector<Eigen::MatrixXcd>& H);

}  // namespace thinwall::dynamics
