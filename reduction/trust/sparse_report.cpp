#include "reduction/trust/sparse_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"
#include "core/pieces.hpp"
#include "dynamics/motion_words.hpp"
#include "linalg/eigenpairs.hpp"
#include "linalg/sparse_cholesky.hpp"
#include "linalg/sparse_indefinite.hpp"
#include "reduction/rigid_count.hpp"
#include "reduction/trust/imported_model.hpp"
#include "reduction/trust/report_parts.hpp"

namespace thinwall::reduction {

namespace {

using dynamics::SparseModel;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Matrix = Eigen::SparseMatrix<double>;

std::string row_name(const SparseModel& model, Index row) {
  return name(dynamics::named(model, model.dofs[static_cast<std::size_t>(row)]));
}

linalg::SparseMatrix identity(Index n) {
  linalg::SparseMatrix I(n, n);
  I.setIdentity();
  return I;
}

/// The number of eigenvalues of S below −shift. If a pivot vanishes, another shift near by is tried; empty if one
/// vanishes at each of four shifts.
std::optional<int> below(const linalg::SparseMatrix& S, double shift, const std::vector<int>& nodes) {
  for (const double factor : {1.0, 1.0137, 0.9811, 1.0519}) {
    const auto count = linalg::count_eigenvalues_below(S, identity(S.rows()), -factor * shift, nodes);
    if (count) return count;
  }
  return std::nullopt;
}

/// The least eigenvalue of S and the index of the largest entry of its vector, by inverse iteration from a shift just
/// below it.
std::pair<double, Index> least_pair(const linalg::SparseMatrix& S, double bound, const std::vector<int>& nodes) {
  double shift = 10.0 * bound;
  while (shift < 1e20 && below(S, shift, nodes).value_or(1) > 0) shift *= 10.0;
  const linalg::SparseCholesky factor(S, 1.0519 * shift, identity(S.rows()), nodes);
  VectorXd x = VectorXd::LinSpaced(S.rows(), 1.0, 2.0);
  for (int pass = 0; pass < 60; ++pass) x = factor.solve(x).col(0).normalized();
  Index row = 0;
  x.cwiseAbs().maxCoeff(&row);
  return {x.dot(S * x), row};
}

/// The state of a sparse matrix, as state_of() of the dense report gives it, by factorisations.
MatrixState state_of(const SparseModel& model, const char* letter, const Matrix& A, const VectorXd& floor,
                     const ReportOptions& options) {
  MatrixState state;
  state.name = letter;
  const dynamics::Asymmetry worst = dynamics::asymmetry(A);
  state.asymmetry = worst.relative;
  if (worst.relative > options.symmetry)
    state.place = row_name(model, worst.row) + ", " + row_name(model, worst.column);
  const double largest = A.nonZeros() > 0 ? A.coeffs().abs().maxCoeff() : 0.0;
  if (largest == 0.0) {
    state.zero = static_cast<int>(A.rows());
    return state;
  }
  const VectorXd own = A.diagonal().cwiseAbs().cwiseMax(floor.cwiseAbs()).cwiseMax(1e-14 * largest);
  const VectorXd scale = own.cwiseSqrt().cwiseInverse();
  const Matrix At = A.transpose();
  linalg::SparseMatrix S;
  S = (0.5 * (A + At)).eval();
  S = (scale.asDiagonal() * S * scale.asDiagonal()).eval();
  const std::vector<int> nodes = node_of_row(model);
  const auto negative = below(S, options.definiteness, nodes), not_positive = below(S, -options.definiteness, nodes);
  state.told = negative.has_value() && not_positive.has_value();
  if (!state.told) return state;
  state.negative = *negative;
  state.zero = *not_positive - *negative;
  if (state.negative == 0) return state;
  const auto [least, row] = least_pair(S, options.definiteness, nodes);
  state.least = least;
  if (state.place.empty()) state.place = row_name(model, row);
  return state;
}

struct Frequencies {
  ModesWithoutEnergy without_energy;
  std::string missing{};  ///< reason if there are none
  std::vector<double> hz;
};

/// The lowest frequencies of K φ = λ M φ, with the shift −α, α = 1e-8 tr K / tr M; if they cannot be found, the reason.
Frequencies lowest_frequencies(const SparseModel& model) {
  linalg::SparseMatrix K, M;
  K = model.K;
  M = model.M;
  const double size = K.diagonal().sum() / M.diagonal().sum();
  const Index with_mass = (VectorXd(M.diagonal()).array() != 0.0).count();  // an upper bound of the number of modes
  const int count = static_cast<int>(std::min<Index>(32, std::min(with_mass, model.size() - 1)));
  if (!(size > 0.0 && std::isfinite(size)) || count < 1) return {{}, "K or M is zero", {}};
  linalg::Eigenpairs pairs;
  try {
    const linalg::SparseCholesky factor(K, 1e-8 * size, M, node_of_row(model));
    pairs = linalg::lowest_eigenpairs(
        K, M, {[&](const Eigen::Ref<const MatrixXd>& B) { return factor.solve(B); }, -1e-8 * size}, count);
  } catch (const core::NumericalError&) {
    return {{}, "K + αM is not positive definite: see the eigenvalues of M and K", {}};
  }
  if (pairs.status != linalg::EigenStatus::converged) return {{}, "the search for them did not converge", {}};
  Frequencies result;
  const double round_off = 10.0 * std::numeric_limits<double>::epsilon() * size;
  result.without_energy = without_energy(pairs.lambda, round_off);
  for (Index k = result.without_energy.count; k < pairs.lambda.size() && result.hz.size() < 20; ++k)
    result.hz.push_back(std::sqrt(std::max(pairs.lambda(k), 0.0)) / (2.0 * std::numbers::pi));
  return result;
}

/// For each row, the lowest row of its piece; rows of one node and rows that share an entry of K or M are connected.
std::vector<int> piece_of_row(const SparseModel& model) {
  std::vector<std::vector<int>> cells;
  std::map<int, std::vector<int>> nodes;
  for (int row = 0; row < std::ssize(model.dofs); ++row)
    nodes[model.dofs[static_cast<std::size_t>(row)].node].push_back(row);
  cells.reserve(nodes.size());
  for (const auto& [node, rows] : nodes) cells.push_back(rows);
  for (const Matrix* A : {&model.K, &model.M}) {
    for (Index column = 0; column < A->outerSize(); ++column) {
      std::vector<int> cell{static_cast<int>(column)};
      for (Matrix::InnerIterator entry(*A, column); entry; ++entry)
        if (entry.row() < column) cell.push_back(static_cast<int>(entry.row()));
      if (cell.size() > 1) cells.push_back(std::move(cell));
    }
  }
  return core::pieces(static_cast<int>(model.size()), cells);
}

/// The data from which rigid motions follow.
struct Geometry {
  dynamics::DofTable dofs;
  std::vector<int> rows;
  Positions positions;
};

/// The rigid motions of all rows, with amplitudes at rest.
MatrixXd motions(const Geometry& geometry, const Vector3d& reference) {
  MatrixXd Y = MatrixXd::Zero(std::ssize(geometry.dofs), 6);
  Y(geometry.rows, Eigen::all) = rigid_motions_of(geometry.dofs, geometry.rows, geometry.positions, reference);
  return Y;
}

/// The motions of one piece, about its centre, whose stiffness is at most round-off or the bound.
dynamics::RigidKernel kernel(const SparseModel& model, const Geometry& geometry, const std::vector<int>& piece,
                             int root, double lambda_bound) {
  dynamics::RigidKernel k;
  std::vector<Vector3d> points;
  for (const int row : geometry.rows)
    if (piece[static_cast<std::size_t>(row)] == root)
      points.push_back(geometry.positions.at(geometry.dofs[static_cast<std::size_t>(row)].point));
  if (points.empty()) return k;
  for (const Vector3d& x : points) k.centre += x / static_cast<double>(points.size());
  for (const Vector3d& x : points) k.size = std::max(k.size, (x - k.centre).norm());
  if (k.size == 0.0) k.size = 1.0;
  MatrixXd Y = motions(geometry, k.centre);
  Y.leftCols(3) *= k.size;
  for (Index row = 0; row < Y.rows(); ++row)
    if (piece[static_cast<std::size_t>(row)] != root) Y.row(row).setZero();
  const VectorXd stiffness = model.K.cwiseAbs() * VectorXd::Ones(model.size());
  k.motions = free_motions(Y, model.K * Y, model.M * Y, stiffness, lambda_bound);
  return k;
}

void find_free_motions(const SparseModel& model, const Geometry& geometry, const std::vector<int>& piece,
                       double lambda_bound, RigidBodyState& state) {
  std::vector<int> roots;
  for (const int row : geometry.rows) roots.push_back(piece[static_cast<std::size_t>(row)]);
  std::sort(roots.begin(), roots.end());
  roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
  constexpr std::size_t told = 20;  // pieces listed at most; a table of loose rows shows in the number of pieces
  for (std::size_t i = 0; i < std::min(roots.size(), told); ++i) {
    const dynamics::RigidKernel k = kernel(model, geometry, piece, roots[i], lambda_bound);
    state.free_motions += static_cast<int>(k.motions.cols());
    for (const std::string& word : dynamics::in_words(k))
      state.in_words.push_back(roots.size() == 1 ? word : word + " of the piece with " + row_name(model, roots[i]));
  }
}

RigidBodyState rigid_body_state(const SparseModel& model, const Geometry& geometry, const std::vector<int>& piece,
                                const ReportOptions& options, const Frequencies& frequencies) {
  RigidBodyState state;
  state.reference = options.reference ? *options.reference : mean_point(geometry.dofs, geometry.positions);
  const MatrixXd Y = motions(geometry, state.reference);
  double length = 0.0;
  for (const int row : geometry.rows) {
    const std::string& point = geometry.dofs[static_cast<std::size_t>(row)].point;
    length = std::max(length, (geometry.positions.at(point) - state.reference).norm());
  }
  if (length > 0.0) state.sets.length_m = length;
  dynamics::Matrix6 gram = Y.transpose() * Y;
  const VectorXd scale = gram.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  gram = (scale.asDiagonal() * gram * scale.asDiagonal()).eval();
  const VectorXd spread = Eigen::SelfAdjointEigenSolver<dynamics::Matrix6>(gram).eigenvalues();
  state.sets.seen = static_cast<int>((spread.array() > 1e-12).count());
  state.sets.without_energy = frequencies.without_energy.count;
  state.sets.geometry = Y;
  const double lowest = frequencies.hz.empty() ? 0.0 : frequencies.hz.front();
  const double bound = options.grounding * std::pow(2.0 * std::numbers::pi * lowest, 2);
  find_free_motions(model, geometry, piece, bound, state);
  if (state.sets.seen < 6) return state;
  state.grounding_stiffness = (Y.transpose() * (model.K * Y)).diagonal();
  state.mass = Y.transpose() * (model.M * Y);
  const VectorXd lambda = state.grounding_stiffness.cwiseQuotient(state.mass.diagonal());
  state.grounding_hz = lambda.cwiseAbs().cwiseSqrt() / (2.0 * std::numbers::pi);
  state.body = body_of(state.mass, state.reference);
  state.mass_disagreement = (state.mass.diagonal().head(3).array() / state.body.mass_kg - 1.0).abs().maxCoeff();
  return state;
}

/// The positions by name, from the options or from the model; none unless every point has one.
Geometry geometry_of(const SparseModel& model, const ReportOptions& options) {
  Geometry geometry{dynamics::dof_table(model), {}, options.positions};
  geometry.rows = physical_rows(geometry.dofs);
  if (!geometry.positions.empty()) return geometry;
  for (const int row : geometry.rows) {
    const auto found = model.positions.find(model.dofs[static_cast<std::size_t>(row)].node);
    if (found == model.positions.end()) {
      geometry.positions.clear();
      return geometry;
    }
    geometry.positions.emplace(geometry.dofs[static_cast<std::size_t>(row)].point, found->second);
  }
  return geometry;
}

void find_in_free_motions(const ReportOptions& options, ReducedModelReport& report) {
  const RigidBodyState& rigid = *report.rigid;
  const auto add = [&](const std::string& name, double value, double bound, bool ok, const std::string& advice) {
    report.findings.push_back({name, value, bound, ok, advice});
  };
  std::string words;
  for (const std::string& word : rigid.in_words) words += (words.empty() ? "free: " : ", ") + word;
  if (words.empty()) words = "all are held";
  if (options.rigid_motions)
    add("free rigid motions", rigid.free_motions, *options.rigid_motions, rigid.free_motions == *options.rigid_motions,
        words);
  if (rigid.sets.seen < 6) {
    if (options.rigid_motions.value_or(0) == 0) return;
    add("rigid motions that the DOFs can show", rigid.sets.seen, 6, false,
        "whether they are free needs three points that do not lie on one line, or rotations");
    return;
  }
  if (rigid.free_motions == 6)
    add("mass along the axes", rigid.mass_disagreement, options.rigid_motion,
        rigid.mass_disagreement <= options.rigid_motion, "mass is missing in some direction, or units differ");
}

/// The names of rows without mass and without stiffness.
std::vector<std::string> bare_rows(const SparseModel& model) {
  const VectorXd ones = VectorXd::Ones(model.size());
  VectorXd size = VectorXd::Zero(model.size());
  for (const Matrix* A : {&model.K, &model.M}) {
    const Matrix sizes = A->cwiseAbs();
    size += sizes * ones + sizes.transpose() * ones;
  }
  std::vector<std::string> names;
  for (Index row = 0; row < size.size(); ++row)
    if (size(row) == 0.0) names.push_back(row_name(model, row));
  return names;
}

void find_pieces(const SparseModel& model, const std::vector<int>& piece, ReducedModelReport& report) {
  std::vector<int> roots = piece;
  std::sort(roots.begin(), roots.end());
  roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
  std::string where;
  for (std::size_t i = 0; i < std::min<std::size_t>(roots.size(), 5); ++i)
    where += (i == 0 ? "" : ", ") + row_name(model, roots[i]);
  report.findings.push_back({"pieces that share no entry", static_cast<double>(roots.size()), 1.0, roots.size() == 1,
                             "they hold " + where + (roots.size() > 5 ? " ..." : "") +
                                 ": a joint is missing, or rows of another part are there"});
}

}  // namespace

ReducedModelReport sparse_report(const SparseModel& model, const ReportOptions& options) {
  dynamics::require_consistent(model);
  const Geometry geometry = geometry_of(model, options);
  ReducedModelReport result = counted(geometry.dofs);
  result.coordinates = static_cast<int>(model.size());
  const Frequencies frequencies = lowest_frequencies(model);
  result.without_energy = frequencies.without_energy;
  result.frequencies_hz = frequencies.hz;
  const double lowest = frequencies.hz.empty() ? 0.0 : frequencies.hz.front();
  const VectorXd none = VectorXd::Zero(model.size());
  const VectorXd inertial = std::pow(2.0 * std::numbers::pi * lowest, 2) * model.M.diagonal();
  result.matrices.push_back(state_of(model, "M", model.M, none, options));
  if (model.has_damping()) result.matrices.push_back(state_of(model, "C", model.C, none, options));
  result.matrices.push_back(state_of(model, "K", model.K, inertial, options));
  const std::vector<int> piece = piece_of_row(model);
  if (!geometry.positions.empty()) result.rigid = rigid_body_state(model, geometry, piece, options, frequencies);
  find_bare(bare_rows(model), result);
  find_frequencies(model.size() > 1 && model.K.norm() > 0.0, frequencies.missing, result);
  find_in_matrices(options, result);
  find_pieces(model, piece, result);
  if (result.rigid) find_in_free_motions(options, result);
  find_free_modes(options, result);
  return result;
}

}  // namespace thinwall::reduction
