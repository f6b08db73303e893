#pragma once
// Tables of identified modes, one row for each mode.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "dynamics/dof.hpp"

namespace thinwall::dynamics {

/// One oscillating mode. The right vector (response) and the left vector (force) have one entry for each DOF of the
/// table, in √(s/kg).
struct ModalTableRow {
  std::string mode;  ///< name of the mode in messages
  double frequency_hz = 0.0;
  double damping_ratio = 0.0;
  Eigen::VectorXcd right;
  Eigen::VectorXcd left;
  /// The place of each DOF's point when this mode was measured, as a distance up the tool from its tip, m. Two sensors,
  /// one for the low modes and another for the high ones, may sit at different places under one name. NaN if the place
  /// is not known.
  Eigen::VectorXd place_m;
};

/// Identified modes over one table of DOFs.
struct ModalTable {
  DofTable dofs;
  std::vector<ModalTableRow> rows;
};

}  // namespace thinwall::dynamics
