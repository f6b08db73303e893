#pragma once
// The functions of frequency that modes and terms are made of, compressed to few rows for each entry.

#include <Eigen/Core>
#include <vector>

#include "identification/modal_fit.hpp"

namespace thinwall::identification {

/// Real columns, the real parts at all lines above the imaginary ones: four of each pole λ,
///
///     1/(s−λ) + 1/(s−λ*),   i/(s−λ) − i/(s−λ*),   1/(s−λ)² + 1/(s−λ*)²,   i/(s−λ)² − i/(s−λ*)²,
///
/// then the terms, scaled to the order of 1: (s_1/s)² where there is inertia, and the powers of s/s_last. `s` is iω.
[[nodiscard]] Eigen::MatrixXd line_functions(const Eigen::VectorXcd& s, const Eigen::VectorXcd& poles,
                                             const ResidualTerms& terms);

/// Values and weights of entries, a column each: real above imaginary parts, and one weight a line for both.
struct WeightedEntries {
  Eigen::MatrixXd values, weights;
};

/// The way to a triangle: by the squares, which takes a tenth of the time and half of the digits, or not.
enum class Digits { half, all };

/// The upper triangle T with TᵀT = [F y]ᵀ W² [F y] of the functions F and each entry's values y and weights: its
/// columns have the lengths and angles of the weighted ones, so that least squares of some of them by others are those
/// over all lines, in columns + 1 rows. By orthogonal reflections, or, of half the digits, as the factor of the matrix
/// of products with columns of length 1 (Cholesky), unless that is not positive. Cost O(lines columns² entries).
[[nodiscard]] std::vector<Eigen::MatrixXd> compressed(const Eigen::MatrixXd& functions, const WeightedEntries& entries,
                                                      Digits digits);

}  // namespace thinwall::identification
