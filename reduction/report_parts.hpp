#pragma once
// What the reports on dense and on sparse models share. Internal to reduction/.

#include "dynamics/rigid_body.hpp"
#include "reduction/model_report.hpp"

namespace thinwall::reduction {

/// A report with the DOFs counted by kind. Throws InputError for a table of amplitudes only.
[[nodiscard]] ReducedModelReport counted(const dynamics::DofTable& dofs);

/// The mean of the points of the table that have a position.
[[nodiscard]] Eigen::Vector3d mean_point(const dynamics::DofTable& dofs, const Positions& positions);

/// Mass, centre and inertia from YᵀMY about the reference.
[[nodiscard]] dynamics::RigidBody body_of(const dynamics::Matrix6& mass, const Eigen::Vector3d& reference);

/// Adds what is found in report.matrices: symmetry, definiteness.
void find_in_matrices(const ReportOptions& options, ReducedModelReport& report);

}  // namespace thinwall::reduction
