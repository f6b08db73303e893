#pragma once
// Accuracy of a reduced model: its frequencies and interface receptances against those of the full model.

#include <Eigen/Core>
#include <vector>

#include "dynamics/spatial_model.hpp"
#include "linalg/sparse.hpp"
#include "reduction/interface.hpp"
#include "reduction/methods/craig_bampton.hpp"

namespace thinwall::reduction {

/// The largest relative error of the reduced model's frequencies over the given full-model frequencies (Hz, ascending,
/// without rigid-body modes). The reduced model is a Ritz model and has all of them, approximated from above. Its first
/// `rigid` modes are skipped.
[[nodiscard]] double max_relative_frequency_error(const dynamics::SpatialModel& reduced, const Eigen::VectorXd& full_hz,
                                                  int rigid);

/// The largest relative frequency error of a Craig-Bampton model cut to its first `modes` fixed-interface modes.
struct ErrorBySize {
  int modes = 0;
  double max_relative_frequency_error = 0.0;
};

/// The frequency errors for about eight numbers of modes, up to all of them; numbers too small for as many frequencies
/// as `full_hz` has are left out. Cost: a dense eigen-solution for each.
[[nodiscard]] std::vector<ErrorBySize> frequency_error_by_size(const CraigBampton& reduced,
                                                               const Eigen::VectorXd& full_hz, int rigid);

/// A receptance of the full model at the interface, at one frequency.
struct [[nodiscard]] FullReceptance {
  double frequency_hz = 0.0;
  Eigen::MatrixXd H;               ///< interface × interface, undamped, m/N
  double relative_residual = 0.0;  ///< residual of the sparse solve
  /// The error of the receptances to first order, max|XᵀR| / max|H| with the round-off of XᵀR. The residual itself
  /// bounds no error: it may be far larger or, with displacements that are large against those of the loads, smaller.
  double relative_error = 0.0;
};

/// The receptances Wᵀ (K − ω²M)⁻¹ W of the undamped full model, by a sparse L D Lᵀ factorisation at each frequency,
/// without modes and without reduction. Cost: a simplicial factorisation at each frequency, one after another, which is
/// slow.
[[nodiscard]] std::vector<FullReceptance> full_receptances(const linalg::SparseMatrix& K, const linalg::SparseMatrix& M,
                                                           const std::vector<int>& node_of_row,
                                                           const Interface& interface,
                                                           const std::vector<double>& frequencies_hz);

/// Frequencies in [from, to] Hz at which undamped receptances can be compared: the middles of the widest `count` gaps
/// (on a logarithmic scale) between the natural frequencies and the ends of the band. They keep away from resonances,
/// where the undamped receptance is infinite.
[[nodiscard]] std::vector<double> frequencies_between(const Eigen::VectorXd& natural_hz, double from_hz, double to_hz,
                                                      int count);

/// The largest difference of an entry of the undamped receptances, relative to the largest entry at that frequency; NaN
/// if one is.
[[nodiscard]] double max_relative_receptance_error(const dynamics::SpatialModel& reduced,
                                                   const std::vector<FullReceptance>& full);

}  // namespace thinwall::reduction
