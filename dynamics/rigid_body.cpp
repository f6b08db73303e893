#include "dynamics/rigid_body.hpp"

#include <sstream>

#include "core/dense_eigenvalues.hpp"

namespace thinwall::dynamics {

namespace {

/// The condition that an inertia tensor violates, as the end of a sentence; empty if a body can have it.
std::string fault_of_inertia(const Eigen::Matrix3d& inertia) {
  const double scale = inertia.cwiseAbs().maxCoeff();
  if (!((inertia - inertia.transpose()).cwiseAbs().maxCoeff() <= 1e-9 * scale)) return "is not symmetric";
  const Eigen::Vector3d moments = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia).eigenvalues();
  std::ostringstream text;
  if (moments(0) < -1e-9 * scale) {
    text << "has the principal moment " << moments(0) << " kg m^2, which cannot be negative";
  } else if (moments(2) > (moments(0) + moments(1)) * (1.0 + 1e-9)) {
    text << "has the principal moment " << moments(2) << " kg m^2, more than the sum of the other two, "
         << moments(0) + moments(1) << " kg m^2: no body has that";
  }
  return text.str();
}

/// The matrix [r]ₓ with [r]ₓ v = r × v.
Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& r) {
  return Eigen::Matrix3d{{0.0, -r.z(), r.y()}, {r.z(), 0.0, -r.x()}, {-r.y(), r.x(), 0.0}};
}

}  // namespace

Matrix6 transport(const Eigen::Vector3d& r) {
  Matrix6 X = Matrix6::Identity();
  X.topRightCorner<3, 3>() = -cross_matrix(r);
  return X;
}

Matrix6 turned(const Eigen::Matrix3d& R) {
  Matrix6 six = Matrix6::Zero();
  six.topLeftCorner<3, 3>() = R;
  six.bottomRightCorner<3, 3>() = R;
  return six;
}

Matrix6 mass_matrix(const RigidBody& body) {
  Matrix6 at_centre = Matrix6::Zero();
  at_centre.topLeftCorner<3, 3>() = body.mass_kg * Eigen::Matrix3d::Identity();
  at_centre.bottomRightCorner<3, 3>() = body.inertia_kg_m2;
  const Matrix6 X = transport(body.centre_m);
  return X.transpose() * at_centre * X;
}

void check(const RigidBody& body, const std::string& where, core::Faults& faults) {
  const bool numbers = body.centre_m.allFinite() && body.inertia_kg_m2.allFinite();
  faults.require(numbers, where, "has a centre or inertia that is not a number");
  faults.require_number(body.mass_kg, body.mass_kg >= 0.0, where, "mass (kg)", "not be negative");
  if (!body.inertia_kg_m2.allFinite()) return;
  const std::string fault = fault_of_inertia(body.inertia_kg_m2);
  faults.require(fault.empty(), where, "has an inertia tensor that " + fault);
}

bool is_frame(const Eigen::Isometry3d& frame) {
  const Eigen::Matrix3d R = frame.linear();
  return frame.matrix().allFinite() && R.determinant() > 0.0 &&
         (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= 1e-9;
}

}  // namespace thinwall::dynamics
