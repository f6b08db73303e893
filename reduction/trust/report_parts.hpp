#pragma once
// Parts that the reports on dense and on sparse models share. Internal to reduction/.

#include "dynamics/rigid_body.hpp"
#include "reduction/trust/model_report.hpp"

namespace thinwall::reduction {

/// A report in which only the DOFs are counted by kind. Throws InputError for a table of amplitudes only.
[[nodiscard]] ReducedModelReport counted(const dynamics::DofTable& dofs);

/// The mean of the points of the table that have a position.
[[nodiscard]] Eigen::Vector3d mean_point(const dynamics::DofTable& dofs, const Positions& positions);

/// The mass, centre and inertia that follow from YᵀMY about the reference.
[[nodiscard]] dynamics::RigidBody body_of(const dynamics::Matrix6& mass, const Eigen::Vector3d& reference);

/// A basis of the motions whose stiffness is at most round-off, or `lambda_bound` (rad²/s²) times their inertia,
///
///     yᵀKy ≤ max(lambda_bound tr YᵀMY, 5e-14 Σ y_i² |k|_i),     |k|_i: the sum of row i's absolute values
///
/// about any axes: 6 × number of motions. Y: n × 6, translations times the size of the body, then rotations; KY, MY: K
/// Y and M Y; row_stiffness: |k|, n.
[[nodiscard]] Eigen::Matrix<double, 6, Eigen::Dynamic> free_motions(const Eigen::MatrixXd& Y, const Eigen::MatrixXd& KY,
                                                                    const Eigen::MatrixXd& MY,
                                                                    const Eigen::VectorXd& row_stiffness,
                                                                    double lambda_bound);

/// Adds the finding on DOFs without mass and stiffness, whose names are given.
void find_bare(const std::vector<std::string>& names, ReducedModelReport& report);

/// Adds, if positions do not show six rigid motions, the finding on whether the number of modes without energy is the
/// expected number of free motions.
void find_free_modes(const ReportOptions& options, ReducedModelReport& report);

/// Adds the finding on whether report.frequencies_hz is empty; `expected`: whether there must be frequencies.
void find_frequencies(bool expected, const std::string& advice, ReducedModelReport& report);

/// Adds the findings on symmetry and definiteness of report.matrices.
void find_in_matrices(const ReportOptions& options, ReducedModelReport& report);

}  // namespace thinwall::reduction
