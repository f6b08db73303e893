#pragma once
// Receptances between points of a part, compared between two solutions of it.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "fem/modes.hpp"
#include "fem/points.hpp"

namespace thinwall::fem {

/// The data of the receptances between the points; empty without points.
struct Responses {
  Eigen::ArrayXd lambda;        // rad²/s²
  double sigma = 0.0;           // of the factor
  Eigen::MatrixXd amplitudes;   // Wᵀ Φ
  Eigen::MatrixXd flexibility;  // Wᵀ (K − σM)⁻¹ W
};

/// The amplitudes and the flexibility of the points, if there are any. Cost: one solution with the factor a column.
[[nodiscard]] Responses responses_of(const Model& model, const Factored& factored, const Modes& modes,
                                     const std::vector<NamedPoint>& points);

/// The largest change of a receptance between the points: relative to the largest magnitude, and relative to the
/// entry's own, with the entry.
struct ReceptanceChange {
  double of_largest = 0.0, of_own = 0.0;
  Eigen::Index row = 0, column = 0;
};

/// The change between two solutions, relative to the magnitudes of the second one, whose modes are given: those of the
/// receptance that all modes' contributions would add up to if none cancelled.
[[nodiscard]] ReceptanceChange receptance_change(const Responses& a, const Responses& b, const Modes& modes);

/// The name of the receptance of that row and column: "P.x", or "P.x to Q.z".
[[nodiscard]] std::string receptance_name(const std::vector<NamedPoint>& points, Eigen::Index row, Eigen::Index column);

}  // namespace thinwall::fem
