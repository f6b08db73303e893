#pragma once
// What the reports on dense and on sparse models share. Internal to reduction/.

#include "dynamics/rigid_body.hpp"
#include "reduction/trust/model_report.hpp"

namespace thinwall::reduction {

/// A report with the DOFs counted by kind. Throws InputError for a table of amplitudes only.
[[nodiscard]] ReducedModelReport counted(const dynamics::DofTable& dofs);

/// The mean of the points of the table that have a position.
[[nodiscard]] Eigen::Vector3d mean_point(const dynamics::DofTable& dofs, const Positions& positions);

/// Mass, centre and inertia from YᵀMY about the reference.
[[nodiscard]] dynamics::RigidBody body_of(const dynamics::Matrix6& mass, const Eigen::Vector3d& reference);

/// A basis of the motions that cost no more than round-off or `lambda_bound` of their inertia (rad²/s²),
///
///     yᵀKy ≤ max(lambda_bound tr YᵀMY, 5e-14 Σ y_i² |k|_i),     |k|_i: the sum of row i's absolute values
///
/// whatever their axes: 6 × as many as there are. Y: n × 6, translations times the size of the body, then rotations;
/// KY, MY: K Y and M Y; row_stiffness: |k|, n.
[[nodiscard]] Eigen::Matrix<double, 6, Eigen::Dynamic> free_motions(const Eigen::MatrixXd& Y, const Eigen::MatrixXd& KY,
                                                                    const Eigen::MatrixXd& MY,
                                                                    const Eigen::VectorXd& row_stiffness,
                                                                    double lambda_bound);

/// Adds whether there are DOFs without mass and stiffness, which are named.
void find_bare(const std::vector<std::string>& names, ReducedModelReport& report);

/// Adds, where places do not show six rigid motions, whether as many modes are without energy as motions are to be
/// free.
void find_free_modes(const ReportOptions& options, ReducedModelReport& report);

/// Adds whether report.frequencies_hz holds any; `expected`: whether it must.
void find_frequencies(bool expected, const std::string& advice, ReducedModelReport& report);

/// Adds what is found in report.matrices: symmetry, definiteness.
void find_in_matrices(const ReportOptions& options, ReducedModelReport& report);

}  // namespace thinwall::reduction
