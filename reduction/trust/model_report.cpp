#include "reduction/trust/model_report.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"
#include "dynamics/motion_words.hpp"
#include "reduction/trust/band.hpp"
#include "reduction/trust/comparison.hpp"
#include "reduction/trust/report_parts.hpp"

namespace thinwall::reduction {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// The name of the DOF of a row, or the row's number if the coordinates differ from the DOFs.
std::string coordinate_name(const dynamics::SpatialModel& model, Index row) {
  return model.has_own_coordinates() ? "coordinate " + std::to_string(row + 1)
                                     : name(model.dofs[static_cast<std::size_t>(row)]);
}

/// The pair of coordinates in which S differs most from its transpose.
std::string asymmetric_place(const dynamics::SpatialModel& model, const MatrixXd& S) {
  Index row = 0, column = 0;
  (S - S.transpose()).cwiseAbs().maxCoeff(&row, &column);
  return coordinate_name(model, std::min(row, column)) + ", " + coordinate_name(model, std::max(row, column));
}

/// The coordinate that moves most in the eigenvector of the least eigenvalue of a symmetric matrix.
std::string indefinite_place(const dynamics::SpatialModel& model, const MatrixXd& S) {
  const MatrixXd vectors = Eigen::SelfAdjointEigenSolver<MatrixXd>(S).eigenvectors();
  Index row = 0;
  vectors.col(0).cwiseAbs().maxCoeff(&row);
  return coordinate_name(model, row);
}

MatrixState state_of(const dynamics::SpatialModel& model, const std::string& letter, const MatrixXd& A,
                     const VectorXd& floor, const ReportOptions& options) {
  MatrixState state;
  state.name = letter;
  const double largest = A.cwiseAbs().maxCoeff();
  if (largest == 0.0) {
    state.zero = static_cast<int>(A.rows());
    return state;
  }
  const VectorXd own = A.diagonal().cwiseAbs().cwiseMax(floor.cwiseAbs()).cwiseMax(1e-14 * largest);
  const VectorXd scale = own.cwiseSqrt().cwiseInverse();
  const MatrixXd S = scale.asDiagonal() * A * scale.asDiagonal();
  state.asymmetry = (S - S.transpose()).cwiseAbs().maxCoeff() / S.cwiseAbs().maxCoeff();
  const MatrixXd symmetric = 0.5 * (S + S.transpose());
  const VectorXd values = Eigen::SelfAdjointEigenSolver<MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
  state.least = values.minCoeff();
  state.negative = static_cast<int>((values.array() < -options.definiteness).count());
  state.zero = static_cast<int>((values.array().abs() <= options.definiteness).count());
  if (state.asymmetry > options.symmetry) state.place = asymmetric_place(model, S);
  if (state.place.empty() && state.negative > 0) state.place = indefinite_place(model, symmetric);
  return state;
}

double mass_disagreement(const MatrixXd& M, const RigidSets& sets, double mass) {
  double worst = 0.0;
  for (const MatrixXd* set : {&sets.geometry, &sets.stiffness, &sets.eigen}) {
    if (set->cols() != 6) continue;
    const VectorXd each = (set->transpose() * M * *set).diagonal().head(3);
    worst = std::max(worst, (each.array() / mass - 1.0).abs().maxCoeff());
  }
  return worst;
}

/// Finds the combinations of the six rigid motions that store no elastic energy.
void find_free_motions(const dynamics::SpatialModel& model, double lambda_bound, RigidBodyState& state) {
  dynamics::RigidKernel k{state.reference, state.sets.length_m, {}};
  MatrixXd Y = state.sets.geometry;
  Y.leftCols(3) *= k.size;
  k.motions = free_motions(Y, model.K * Y, model.M * Y, model.K.cwiseAbs().rowwise().sum(), lambda_bound);
  state.free_motions = static_cast<int>(k.motions.cols());
  state.in_words = dynamics::in_words(k);
}

RigidBodyState rigid_body_state(const dynamics::SpatialModel& model, const ReportOptions& options, double lowest_hz) {
  RigidBodyState state;
  state.reference = options.reference ? *options.reference : mean_point(model.dofs, options.positions);
  state.sets = rigid_sets(model, options.positions, state.reference);
  if (state.sets.seen < 6) return state;
  const MatrixXd& Y = state.sets.geometry;
  state.grounding_stiffness = (Y.transpose() * model.K * Y).diagonal();
  state.mass = Y.transpose() * model.M * Y;
  const VectorXd lambda = state.grounding_stiffness.cwiseQuotient(state.mass.diagonal());
  state.grounding_hz = lambda.cwiseAbs().cwiseSqrt() / (2.0 * std::numbers::pi);
  find_free_motions(model, options.grounding * std::pow(2.0 * std::numbers::pi * lowest_hz, 2), state);
  state.body = body_of(state.mass, state.reference);
  const std::vector<int> rows = physical_rows(model.dofs);
  state.effective = effective_mass(model.K, model.M, dynamics::displacements(model)(rows, Eigen::all), Y);
  // In a held part, the sets by stiffness and by modes are deformed; only the set by geometry is rigid.
  RigidSets comparable = state.sets;
  if (state.sets.without_energy != 6) comparable.stiffness = comparable.eigen = MatrixXd();
  state.mass_disagreement = mass_disagreement(model.M, comparable, state.body.mass_kg);
  return state;
}

/// Checks receptances of the matrices as they are, symmetric or not, at frequencies between the natural ones, with a
/// loss factor that makes passive matrices dissipate.
void check_receptances(const dynamics::SpatialModel& model, ReducedModelReport& report) {
  const auto& hz = report.frequencies_hz;
  if (hz.empty()) return;
  report.reciprocity = report.least_power = 0.0;
  dynamics::SpatialModel seen = model;
  const std::vector<int> rows = physical_rows(model.dofs);
  seen.T = dynamics::displacements(model)(rows, Eigen::all);
  seen.dofs.clear();
  for (const int row : rows) seen.dofs.push_back(model.dofs[static_cast<std::size_t>(row)]);
  const Band band{0.3 * hz.front(), 1.1 * hz.back(), 5, 0.02};
  std::vector<Eigen::MatrixXcd> lines;
  for (const auto z : squares(band, {}))
    lines.push_back(receptance_at(seen, std::ssize(rows), z) / std::complex<double>(1.0, band.loss_factor));
  const VectorXd units = common_units(seen.dofs, lines);
  for (const Eigen::MatrixXcd& line : lines) {
    const Eigen::MatrixXcd H = units.asDiagonal() * line * units.asDiagonal();
    const double size = H.cwiseAbs().maxCoeff();
    report.reciprocity = std::max(report.reciprocity, (H - H.transpose()).cwiseAbs().maxCoeff() / size);
    const Eigen::MatrixXcd lost = std::complex<double>(0.0, 0.5) * (H - H.adjoint());  // −(H − Hᴴ)/2i
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> power(lost, Eigen::EigenvaluesOnly);
    report.least_power = std::min(report.least_power, power.eigenvalues().minCoeff() / size);
  }
}

std::vector<double> lowest_frequencies(const dynamics::SpatialModel& model, int rigid) {
  const double middle = model.K.diagonal().cwiseAbs().sum() / model.M.diagonal().cwiseAbs().sum();
  if (!(middle > 0.0 && std::isfinite(middle))) return {};
  VectorXd hz = natural_frequencies_hz(model, rigid, 0.01 * std::sqrt(middle) / (2.0 * std::numbers::pi));
  // The second pass is about the lowest frequency found, which makes that one accurate.
  if (hz.size() > 0) hz = natural_frequencies_hz(model, rigid, hz(0));
  return {hz.begin(), hz.begin() + std::min<Index>(20, hz.size())};
}

/// The names of coordinates without mass and without stiffness.
std::vector<std::string> bare_coordinates(const dynamics::SpatialModel& model) {
  std::vector<std::string> names;
  const auto empty = [](const MatrixXd& A, Index i) { return A.row(i).isZero(0.0) && A.col(i).isZero(0.0); };
  for (Index i = 0; i < model.size(); ++i) {
    if (!empty(model.K, i) || !empty(model.M, i)) continue;
    names.push_back(coordinate_name(model, i));
  }
  return names;
}

/// Coordinates, other than the bare ones, that move together without mass and without stiffness: the null space that K
/// and M share, in which no equation of motion holds anything.
struct SharedNullSpace {
  int motions = 0;
  std::string place;  ///< a coordinate of them
};

SharedNullSpace shared_null_space(const dynamics::SpatialModel& model, double bound) {
  const double K_size = model.K.norm(), M_size = model.M.norm();
  SharedNullSpace found;
  if (!(K_size > 0.0 && M_size > 0.0)) return found;
  const Index n = model.size();
  MatrixXd both(2 * n, n);
  both << model.K / K_size, model.M / M_size;
  const VectorXd own = both.cwiseAbs().colwise().maxCoeff();
  const VectorXd scale = own.unaryExpr([](double size) { return size > 0.0 ? 1.0 / std::sqrt(size) : 0.0; });
  both.topRows(n) = (scale.asDiagonal() * both.topRows(n) * scale.asDiagonal()).eval();
  both.bottomRows(n) = (scale.asDiagonal() * both.bottomRows(n) * scale.asDiagonal()).eval();
  Eigen::ColPivHouseholderQR<MatrixXd> qr(both);
  qr.setThreshold(bound);
  for (Index k = qr.rank(); k < n; ++k) {
    const Index coordinate = qr.colsPermutation().indices()(k);
    if (own(coordinate) == 0.0) continue;  // it is told by find_bare()
    if (found.motions++ == 0) found.place = coordinate_name(model, coordinate);
  }
  return found;
}

void find_shared_null_space(const SharedNullSpace& shared, ReducedModelReport& report) {
  if (shared.motions == 0) return;
  report.findings.push_back({"motions without mass and stiffness", static_cast<double>(shared.motions), 0.0, false,
                             "K and M share a null space, in which " + shared.place +
                                 " moves with others: coordinates depend on each other; leave out as many, or export "
                                 "the model on independent ones"});
}

void find_in_rigid_body(const ReportOptions& options, ReducedModelReport& report) {
  if (!report.rigid) return;
  const RigidBodyState& rigid = *report.rigid;
  const auto add = [&](const std::string& name, double value, double bound, bool ok, const std::string& advice) {
    report.findings.push_back({name, value, bound, ok, advice});
  };
  if (rigid.sets.seen < 6) {
    if (options.rigid_motions.value_or(0) > 0)
      add("rigid motions that the DOFs can show", rigid.sets.seen, 6, false,
          "whether they are free needs three points that do not lie on one line, or rotations");
    return;
  }
  if (options.rigid_motions)
    add("free rigid motions", rigid.free_motions, *options.rigid_motions, rigid.free_motions == *options.rigid_motions,
        "a support that is not meant or is missing, or a position or direction that is wrong");
  add("rigid motions by geometry", rigid.sets.geometry_misfit, options.rigid_motion,
      rigid.sets.geometry_misfit <= options.rigid_motion, "the model's coordinates cannot move its points so");
  if (rigid.free_motions == 6)
    add("modes without energy", rigid.sets.without_energy, 6, rigid.sets.without_energy == 6,
        "more: a mechanism, or M is not of this K");
  if (rigid.sets.without_energy == 6) {
    add("rigid motions by stiffness", rigid.sets.stiffness_disagreement, options.rigid_motion,
        rigid.sets.stiffness_disagreement <= options.rigid_motion,
        "a position, a direction or a row is not what K knows");
    add("rigid motions by modes", rigid.sets.eigen_disagreement, options.rigid_motion,
        rigid.sets.eigen_disagreement <= options.rigid_motion, "M and K do not belong together");
    add("mass along the axes and by the sets", rigid.mass_disagreement, options.rigid_motion,
        rigid.mass_disagreement <= options.rigid_motion, "mass is missing in some direction, or units differ");
  }
  if (rigid.effective.available)
    add("sum of effective masses", rigid.effective.closure, options.effective_mass,
        rigid.effective.closure <= options.effective_mass, "M is ill-conditioned at the interface");
}

}  // namespace

bool ReducedModelReport::trustworthy() const {
  return std::all_of(findings.begin(), findings.end(), [](const Finding& finding) { return finding.ok; });
}

ReducedModelReport report(const dynamics::SpatialModel& model, const ReportOptions& options) {
  dynamics::require_consistent(model);
  ReducedModelReport result = counted(model.dofs);
  result.coordinates = static_cast<int>(model.size());
  result.without_energy = modes_without_energy(model);
  const SharedNullSpace shared = shared_null_space(model, options.definiteness);
  if (shared.motions == 0) result.frequencies_hz = lowest_frequencies(model, result.without_energy.count);
  const double lowest = result.frequencies_hz.empty() ? 0.0 : result.frequencies_hz.front();
  const double lambda = std::pow(2.0 * std::numbers::pi * lowest, 2);
  const VectorXd none = VectorXd::Zero(model.size());
  result.matrices.push_back(state_of(model, "M", model.M, none, options));
  result.matrices.push_back(state_of(model, "C", model.C, none, options));
  result.matrices.push_back(state_of(model, "K", model.K, lambda * model.M.diagonal(), options));
  if (model.has_structural_damping())
    result.matrices.push_back(state_of(model, "D", model.D, lambda * model.M.diagonal(), options));
  if (!options.positions.empty()) result.rigid = rigid_body_state(model, options, lowest);
  check_receptances(model, result);
  find_bare(bare_coordinates(model), result);
  find_shared_null_space(shared, result);
  find_frequencies(!model.K.isZero(0.0),
                   shared.motions > 0 ? "none is determined beside motions without mass and stiffness"
                                      : "M or K is missing, zero or singular: nothing was checked against it",
                   result);
  find_in_matrices(options, result);
  find_in_rigid_body(options, result);
  find_free_modes(options, result);
  if (std::isnan(result.reciprocity)) return result;
  result.findings.push_back({"reciprocity", result.reciprocity, options.reciprocity,
                             result.reciprocity <= options.reciprocity, "see the symmetry of the matrices"});
  result.findings.push_back({"least power lost over |H|", result.least_power, -1e-9, result.least_power >= -1e-9,
                             "the model gives energy: see the eigenvalues of the matrices"});
  return result;
}

}  // namespace thinwall::reduction
