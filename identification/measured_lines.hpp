#pragma once
// Lines of a measured receptance matrix, and how far each may be off.

#include <Eigen/Core>
#include <vector>

namespace thinwall::identification {

/// Responses × references at each line.
struct MeasuredLines {
  Eigen::VectorXd hz;                     ///< ascending, > 0
  std::vector<Eigen::MatrixXcd> H;        ///< m/N
  std::vector<Eigen::MatrixXd> variance;  ///< of |error|², half of it in the real and half in the imaginary part; > 0

  /// The number of lines.
  [[nodiscard]] Eigen::Index lines() const { return hz.size(); }
  /// The number of responses.
  [[nodiscard]] Eigen::Index responses() const { return H.front().rows(); }
  /// The number of references.
  [[nodiscard]] Eigen::Index references() const { return H.front().cols(); }
};

/// A figure of each entry, responses × references, or one for all (1 × 1); empty where it is not known.
using OfEntries = Eigen::MatrixXd;

/// The figures as responses × references. Throws InputError, with `what`, for another shape.
[[nodiscard]] Eigen::ArrayXXd spread_over(const OfEntries& figures, Eigen::Index responses, Eigen::Index references,
                                          const char* what);

/// Throws InputError unless all is of one shape, finite, the lines ascending and above 0, and the variances positive.
void require_usable(const MeasuredLines& measured);

/// The variance of each line from the coherence γ² of each entry and the number of averages n (Bendat & Piersol 2010,
/// Eq. 9.90): (1 − γ²)/(γ² n) |H|². `H` may be a fit of what was measured: a measured value that happens to be small
/// would weigh too much. Coherences are held between 1e-6 and 1 − 1e-12. Throws InputError for other shapes, or n < 1.
[[nodiscard]] std::vector<Eigen::MatrixXd> variance_of(const std::vector<Eigen::MatrixXcd>& H,
                                                       const std::vector<Eigen::MatrixXd>& coherence,
                                                       const OfEntries& averages);

/// The variance of each line as far as it differs from its neighbours: with H_k predicted by the cubic through the two
/// lines on each side, of weights w_j,
///
///     δ_k² = |H_k − Σ w_j H_j|² / (1 + Σ w_j²),      variance = |S_k|^2p median (δ² / |S|^2p) / ln 2   over 41 lines
///
/// because |δ| is Rayleigh distributed, with the size S of the entry itself from `sizes`. p is 0, ½ or 1, noise that
/// does not depend on the size or is a share of it, whichever makes the differences of an entry likeliest. Resonances
/// that few lines cover count as scatter: what is left of a fit, in place of `H`, has none of them. The variance is at
/// least (`least_share` |S|)². Throws InputError for fewer than six lines, or other shapes. Cost O(120 lines entries).
[[nodiscard]] std::vector<Eigen::MatrixXd> variance_from_scatter(const Eigen::VectorXd& hz,
                                                                 const std::vector<Eigen::MatrixXcd>& H,
                                                                 const std::vector<Eigen::MatrixXcd>& sizes,
                                                                 double least_share = 1e-6);

}  // namespace thinwall::identification
