#include "reduction/report_parts.hpp"

#include <set>

#include "core/error.hpp"

namespace thinwall::reduction {

using Eigen::Vector3d;

ReducedModelReport counted(const dynamics::DofTable& dofs) {
  ReducedModelReport result;
  for (const dynamics::Dof& dof : dofs) {
    if (dof.kind == dynamics::DofKind::translation) ++result.translations;
    if (dof.kind == dynamics::DofKind::rotation) ++result.rotations;
    if (dof.kind == dynamics::DofKind::modal) ++result.amplitudes;
  }
  if (result.translations + result.rotations == 0)
    throw core::InputError("the DOF table names amplitudes only: a report needs a displacement of a point");
  return result;
}

Vector3d mean_point(const dynamics::DofTable& dofs, const Positions& positions) {
  Vector3d sum = Vector3d::Zero();
  double count = 0.0;
  std::set<std::string> named;
  for (const dynamics::Dof& dof : dofs) named.insert(dof.point);
  for (const auto& [point, position] : positions) {
    if (!named.contains(point)) continue;
    sum += position;
    count += 1.0;
  }
  return count > 0.0 ? Vector3d(sum / count) : sum;
}

dynamics::RigidBody body_of(const dynamics::Matrix6& mass, const Vector3d& reference) {
  dynamics::RigidBody body;
  body.mass_kg = mass.topLeftCorner<3, 3>().trace() / 3.0;
  const Eigen::Matrix3d moment = mass.bottomLeftCorner<3, 3>() / body.mass_kg;  // [c]ₓ
  const Vector3d c =
      0.5 * Vector3d(moment(2, 1) - moment(1, 2), moment(0, 2) - moment(2, 0), moment(1, 0) - moment(0, 1));
  body.centre_m = reference + c;
  const Eigen::Matrix3d about_reference = mass.bottomRightCorner<3, 3>();
  body.inertia_kg_m2 =
      about_reference - body.mass_kg * (c.squaredNorm() * Eigen::Matrix3d::Identity() - c * c.transpose());
  return body;
}

void find_in_matrices(const ReportOptions& options, ReducedModelReport& report) {
  for (const MatrixState& matrix : report.matrices) {
    const std::string place = matrix.place.empty() ? "" : "; see " + matrix.place;
    report.findings.push_back(
        {"symmetry of " + matrix.name, matrix.asymmetry, options.symmetry, matrix.asymmetry <= options.symmetry,
         "both triangles must be there and equal: export the full matrix, or mirror the one given" + place});
    const bool definite = matrix.negative == 0;
    const char* advice = matrix.name == "M"   ? "a negative mass: a sign or a wrong row of the DOF table"
                         : matrix.name == "K" ? "negative stiffness; dual Craig-Bampton's has it by construction"
                                              : "it gives energy: a part alone cannot";
    report.findings.push_back(
        {"least eigenvalue of " + matrix.name, matrix.least, -options.definiteness, definite, advice + place});
  }
}

}  // namespace thinwall::reduction
