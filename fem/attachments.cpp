#include "fem/attachments.hpp"

#include <algorithm>
#include <cmath>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"
#include "core/nearest_name.hpp"
#include "core/units.hpp"

namespace thinwall::fem {

namespace {

using Violations = std::vector<std::string>;

void require_stiffness(double value, const std::string& what, Violations& found) {
  if (!(value >= 0.0 && std::isfinite(value)))
    found.push_back(what + " is " + core::number_text(value) + "; it must be finite and not negative");
}

/// Notes a matrix that is not symmetric, not finite, or has a negative eigenvalue, beyond round-off.
void require_semidefinite(const Eigen::Matrix3d& A, const std::string& what, Violations& found) {
  if (!A.allFinite()) {
    found.push_back(what + " has an entry that is not a number");
    return;
  }
  const double size = A.cwiseAbs().maxCoeff();
  if ((A - A.transpose()).cwiseAbs().maxCoeff() > 1e-9 * size) {
    found.push_back(what + " is not symmetric");
    return;
  }
  const Eigen::Vector3d values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(A).eigenvalues();
  if (values(0) < -1e-9 * size)
    found.push_back(what + " has the negative eigenvalue " + core::number_text(values(0)) + "; none may be negative");
}

void require_body(const PointMass& mass, const std::string& what, Violations& found) {
  if (!(mass.mass_kg >= 0.0 && std::isfinite(mass.mass_kg)))
    found.push_back(what + " is " + core::number_text(mass.mass_kg) + " kg; it must be finite and not negative");
  const std::size_t before = found.size();
  require_semidefinite(mass.inertia_kg_m2, "the inertia of " + what, found);
  if (found.size() > before) return;
  const Eigen::Vector3d I = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(mass.inertia_kg_m2).eigenvalues();
  if (I(2) > (1.0 + 1e-9) * (I(0) + I(1)))
    found.push_back("the inertia of " + what +
                    " is that of no body: one principal moment exceeds the sum of the others");
}

void require_place(const Eigen::Vector3d& offset, const std::string& what, Violations& found) {
  if (!offset.allFinite()) found.push_back("the offset of " + what + " is not finite");
}

}  // namespace

void validate(const Attachments& attachments) {
  Violations found;
  std::vector<std::string> names;
  for (const ConnectedPoint& point : attachments.points) {
    if (std::find(names.begin(), names.end(), point.name) != names.end())
      found.push_back("two connected points are called \"" + point.name + "\"");
    names.push_back(point.name);
  }
  const auto require_known = [&](const std::string& point, const std::string& what) {
    if (std::find(names.begin(), names.end(), point) == names.end())
      found.push_back(what + " hangs on no connected point" + core::did_you_mean(point, names));
  };
  for (const ElasticClamp& clamp : attachments.clamps) {
    require_stiffness(clamp.normal_N_m3, "the normal stiffness of clamp \"" + clamp.name + "\", N/m^3,", found);
    require_stiffness(clamp.tangential_N_m3, "the tangential stiffness of clamp \"" + clamp.name + "\", N/m^3,", found);
  }
  for (const PointMass& mass : attachments.masses) {
    const std::string what = "the mass at \"" + mass.point + "\"";
    require_known(mass.point, what);
    require_body(mass, what, found);
    require_place(mass.offset_m, what, found);
  }
  for (const GroundSpring& spring : attachments.springs) {
    const std::string what = "the spring at \"" + spring.point + "\"";
    require_known(spring.point, what);
    require_semidefinite(spring.translation_N_m, "the translational stiffness of " + what, found);
    require_semidefinite(spring.rotation_N_m, "the rotational stiffness of " + what, found);
    require_place(spring.offset_m, what, found);
  }
  if (found.empty()) return;
  std::string text;
  for (const std::string& violation : found) text += (text.empty() ? "" : "; ") + violation;
  throw core::InputError(text);
}

Eigen::Matrix<double, 6, 6> matrix_at_point(const PointMass& mass) {
  const Eigen::Matrix3d o = cross_matrix(mass.offset_m);
  Eigen::Matrix<double, 6, 6> M;
  M << mass.mass_kg * Eigen::Matrix3d::Identity(), -mass.mass_kg * o, mass.mass_kg * o,
      mass.inertia_kg_m2 - mass.mass_kg * o * o;
  return M;
}

Eigen::Matrix<double, 6, 6> matrix_at_point(const GroundSpring& spring) {
  Eigen::Matrix<double, 6, 6> X = Eigen::Matrix<double, 6, 6>::Identity();
  X.topRightCorner<3, 3>() = -cross_matrix(spring.offset_m);
  Eigen::Matrix<double, 6, 6> K = Eigen::Matrix<double, 6, 6>::Zero();
  K.topLeftCorner<3, 3>() = spring.translation_N_m;
  K.bottomRightCorner<3, 3>() = spring.rotation_N_m;
  return X.transpose() * K * X;
}

}  // namespace thinwall::fem
