#pragma once
// Is a reduced model good enough? Its frequencies and interface receptances against the full model's.

#include <Eigen/Core>
#include <vector>

#include "dynamics/spatial_model.hpp"
#include "linalg/sparse.hpp"
#include "reduction/interface.hpp"
#include "reduction/methods/craig_bampton.hpp"

namespace thinwall::reduction {

/// Largest relative error of the reduced model's frequencies over the given full-model frequencies (Hz, ascending, no
/// rigid-body modes): the reduced model, a Ritz model, has them all and from above. `rigid` modes are skipped first.
[[nodiscard]] double max_relative_frequency_error(const dynamics::SpatialModel& reduced, const Eigen::VectorXd& full_hz,
                                                  int rigid);

/// The same error of a Craig-Bampton model with its first fixed-interface modes only.
struct ErrorBySize {
  int modes = 0;
  double max_relative_frequency_error = 0.0;
};

/// For some eight numbers of modes up to all of them; those too few for as many frequencies as `full_hz` holds are left
/// out. Cost: a dense eigen-solution each.
[[nodiscard]] std::vector<ErrorBySize> frequency_error_by_size(const CraigBampton& reduced,
                                                               const Eigen::VectorXd& full_hz, int rigid);

/// One full-model receptance at the interface.
struct [[nodiscard]] FullReceptance {
  double frequency_hz = 0.0;
  Eigen::MatrixXd H;               ///< interface × interface, undamped, m/N
  double relative_residual = 0.0;  ///< of the sparse solve
};

/// Wᵀ (K − ω²M)⁻¹ W of the undamped full model by a sparse L D Lᵀ factorisation a frequency: no modes, no reduction.
/// Cost: a simplicial factorisation a frequency (the slow kind), one after another.
[[nodiscard]] std::vector<FullReceptance> full_receptances(const linalg::SparseMatrix& K, const linalg::SparseMatrix& M,
                                                           const std::vector<int>& node_of_row,
                                                           const Interface& interface,
                                                           const std::vector<double>& frequencies_hz);

/// Frequencies in [from, to] Hz at which an undamped receptance can be compared: the middles of the widest `count` gaps
/// (on a logarithmic scale) between the natural frequencies and the ends of the band. At a resonance the undamped
/// receptance is infinite.
[[nodiscard]] std::vector<double> frequencies_between(const Eigen::VectorXd& natural_hz, double from_hz, double to_hz,
                                                      int count);

/// Largest entry-wise difference of the undamped receptances over the largest entry of that frequency.
[[nodiscard]] double max_relative_receptance_error(const dynamics::SpatialModel& reduced,
                                                   const std::vector<FullReceptance>& full);

}  // namespace thinwall::reduction
