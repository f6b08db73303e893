#pragma once
// Modes as an identification lists them: a row a mode.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "dynamics/dof.hpp"

namespace thinwall::dynamics {

/// One oscillating mode: right vector (response) and left vector (force), √(s/kg), an entry a DOF of the table.
struct ModalTableRow {
  std::string mode;  ///< its name in messages
  double frequency_hz = 0.0;
  double damping_ratio = 0.0;
  Eigen::VectorXcd right;
  Eigen::VectorXcd left;
  /// Where each DOF's point was when this mode was measured: so far up the tool from its tip, m. One sensor for the low
  /// modes and another for the high ones may sit at two places under one name. NaN: not told.
  Eigen::VectorXd place_m;
};

/// Identified modes, a row each, over one table of DOFs.
struct ModalTable {
  DofTable dofs;
  std::vector<ModalTableRow> rows;
};

}  // namespace thinwall::dynamics
