#pragma once
// Rigid-body motions of the nodes, and the mass properties that follow from them and the mass matrix.

#include <Eigen/Core>

#include "linalg/sparse.hpp"
#include "mesh/lagrange_nodes.hpp"

namespace thinwall::fem {

/// The six rigid-body motions about the origin as columns (three translations in m, three rotations in rad): 3·nodes
/// × 6.
[[nodiscard]] Eigen::MatrixXd rigid_body_motions(const mesh::LagrangeNodes& nodes);

/// Mass (kg), centre (m) and inertia about the centre (kg m², moments and products with the sign of the tensor).
struct MassProperties {
  double mass_kg = 0.0;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia_kg_m2 = Eigen::Matrix3d::Zero();
};

/// The mass properties from the mass matrix alone: with P = [1 x y z] at the nodes, Pᵀ M P contains mass, first and
/// second moments. node_mass: ∫ ρ N_a N_b dV over all nodes, unconstrained.
[[nodiscard]] MassProperties mass_properties(const linalg::SparseMatrix& node_mass, const mesh::LagrangeNodes& nodes);

/// The mass properties of a homogeneous block from 0 to `size` (m), in closed form.
[[nodiscard]] MassProperties box_mass_properties(const Eigen::Vector3d& size, double density_kg_m3);

/// The largest relative difference of mass, centre (over the distance of b's centre from the origin) and inertia (over
/// its trace).
[[nodiscard]] double relative_difference(const MassProperties& a, const MassProperties& b);

}  // namespace thinwall::fem
