#include "reduction/trust/report_parts.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/dense_eigenvalues.hpp"
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

Eigen::Matrix<double, 6, Eigen::Dynamic> free_motions(const Eigen::MatrixXd& Y, const Eigen::MatrixXd& KY,
                                                      const Eigen::MatrixXd& MY, const Eigen::VectorXd& row_stiffness,
                                                      double lambda_bound) {
  const dynamics::Matrix6 G = Y.transpose() * KY;
  const double round_off = 5e-14 * (Y.transpose() * row_stiffness.asDiagonal() * Y).trace();
  const double inertia = (Y.transpose() * MY).trace();
  const Eigen::SelfAdjointEigenSolver<dynamics::Matrix6> eigen(dynamics::Matrix6(0.5 * (G + G.transpose())));
  const double bound = std::max(round_off, lambda_bound * std::abs(inertia));
  return eigen.eigenvectors().leftCols((eigen.eigenvalues().array() <= bound).count());
}

void find_bare(const std::vector<std::string>& names, ReducedModelReport& report) {
  constexpr std::size_t told = 5;
  std::string where;
  for (std::size_t i = 0; i < std::min(names.size(), told); ++i) where += (i == 0 ? "" : ", ") + names[i];
  if (names.size() > told) where += " ...";
  report.findings.push_back({"DOFs without mass and stiffness", static_cast<double>(names.size()), 0.0, names.empty(),
                             where + ": nothing holds or moves them; leave them out, or export what is missing"});
}

void find_free_modes(const ReportOptions& options, ReducedModelReport& report) {
  if (!options.rigid_motions || (report.rigid && report.rigid->sets.seen == 6)) return;
  const int free = report.without_energy.count;
  report.findings.push_back({"modes without energy", static_cast<double>(free),
                             static_cast<double>(*options.rigid_motions), free == *options.rigid_motions,
                             "a support that is not meant or is missing; which motions are free shows with positions"});
}

void find_frequencies(bool expected, const std::string& advice, ReducedModelReport& report) {
  const auto count = static_cast<double>(report.frequencies_hz.size());
  report.findings.push_back({"frequencies found", count, expected ? 1.0 : 0.0, !expected || count > 0.0, advice});
}

void find_in_matrices(const ReportOptions& options, ReducedModelReport& report) {
  for (const MatrixState& matrix : report.matrices) {
    const std::string place = matrix.place.empty() ? "" : "; see " + matrix.place;
    report.findings.push_back(
        {"symmetry of " + matrix.name, matrix.asymmetry, options.symmetry, matrix.asymmetry <= options.symmetry,
         "both triangles must be there and equal: export the full matrix, or mirror the one given" + place});
    if (!matrix.told) {
      report.findings.push_back({"definiteness of " + matrix.name + " not told", 0.0, 0.0, false,
                                 "a pivot vanishes at every shift: see DOFs without mass and stiffness, and scales"});
      continue;
    }
    const bool definite = matrix.negative == 0;
    const char* advice = matrix.name == "M"   ? "a negative mass: a sign or a wrong row of the DOF table"
                         : matrix.name == "K" ? "negative stiffness; dual Craig-Bampton's has it by construction"
                                              : "it gives energy: a part alone cannot";
    report.findings.push_back(
        {"least eigenvalue of " + matrix.name, matrix.least, -options.definiteness, definite, advice + place});
  }
}

}  // namespace thinwall::reduction
