#pragma once
// Correlations of a smooth random function between two places.

#include <Eigen/Core>
#include <array>
#include <string_view>

#include "core/words.hpp"

namespace thinwall::regression {

/// The family of the correlation κ over the scaled distance r.
enum class Kernel {
  squared_exponential,  ///< e^{−r²/2}: functions with all derivatives
  matern_3_2,           ///< (1 + √3 r) e^{−√3 r}: functions with one derivative
  matern_5_2,           ///< (1 + √5 r + 5r²/3) e^{−√5 r}: functions with two
};

/// The correlations κ(r), r² = Σ_d ((x_d − x'_d)/ℓ_d)², of the rows of X (n × d) with those of X' (m × d): n × m
/// (Rasmussen & Williams 2006, Eq. 4.9, 4.17). `length` are the ℓ_d, one a column, > 0. Cost O(n m d).
[[nodiscard]] Eigen::MatrixXd correlation(Kernel kernel, const Eigen::MatrixXd& X, const Eigen::MatrixXd& other,
                                          const Eigen::VectorXd& length);

/// κ at the r² of each pair, elementwise. Cost O(pairs).
[[nodiscard]] Eigen::ArrayXXd correlation(Kernel kernel, const Eigen::ArrayXXd& r2);

/// ∂κ/∂ ln ℓ_d of the rows of X with each other, n × n. Cost O(n² d).
[[nodiscard]] Eigen::MatrixXd correlation_change(Kernel kernel, const Eigen::MatrixXd& X, const Eigen::VectorXd& length,
                                                 Eigen::Index d);

}  // namespace thinwall::regression

namespace thinwall::core {

template <>
inline constexpr std::array<std::string_view, 3> words<regression::Kernel>{"squared_exponential", "matern_3_2",
                                                                           "matern_5_2"};

}  // namespace thinwall::core
