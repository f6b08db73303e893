#include "fem/rigid_body.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace thinwall::fem {

namespace {

Eigen::Matrix<double, 3, 6> motion_at(const Eigen::Vector3d& x) {
  Eigen::Matrix<double, 3, 6> R = Eigen::Matrix<double, 3, 6>::Zero();
  R.leftCols<3>().setIdentity();
  for (int axis = 0; axis < 3; ++axis) R.col(3 + axis) = Eigen::Vector3d::Unit(axis).cross(x);
  return R;
}

}  // namespace

Eigen::MatrixXd rigid_body_motions(const mesh::LagrangeNodes& nodes) {
  Eigen::MatrixXd R(3 * nodes.positions.rows(), 6);
  for (Eigen::Index node = 0; node < nodes.positions.rows(); ++node) {
    R.middleRows<3>(3 * node) = motion_at(nodes.positions.row(node).transpose());
  }
  return R;
}

MassProperties mass_properties(const linalg::SparseMatrix& node_mass, const mesh::LagrangeNodes& nodes) {
  Eigen::MatrixX4d P(nodes.positions.rows(), 4);
  P << Eigen::VectorXd::Ones(P.rows()), nodes.positions;
  const Eigen::Matrix4d moments = P.transpose() * (node_mass * P);
  MassProperties p;
  p.mass_kg = moments(0, 0);
  p.centre_m = moments.block<3, 1>(1, 0) / p.mass_kg;
  // The inertia tensor is tr(S) I − S with S the second moments about the centre.
  const Eigen::Matrix3d about_centre =
      moments.bottomRightCorner<3, 3>() - p.mass_kg * p.centre_m * p.centre_m.transpose();
  p.inertia_kg_m2 = about_centre.trace() * Eigen::Matrix3d::Identity() - about_centre;
  return p;
}

MassProperties box_mass_properties(const Eigen::Vector3d& size, double density_kg_m3) {
  MassProperties p;
  p.mass_kg = density_kg_m3 * size.prod();
  p.centre_m = 0.5 * size;
  const Eigen::Vector3d squares = size.cwiseAbs2();
  p.inertia_kg_m2 = (p.mass_kg / 12.0 * (squares.sum() - squares.array()).matrix()).asDiagonal();
  return p;
}

double relative_difference(const MassProperties& a, const MassProperties& b) {
  return std::max({std::abs(a.mass_kg - b.mass_kg) / b.mass_kg, (a.centre_m - b.centre_m).norm() / b.centre_m.norm(),
                   (a.inertia_kg_m2 - b.inertia_kg_m2).norm() / b.inertia_kg_m2.trace()});
}

}  // namespace thinwall::fem
