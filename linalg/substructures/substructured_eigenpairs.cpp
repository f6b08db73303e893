#include "linalg/substructures/substructured_eigenpairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/dense_eigenvalues.hpp"
#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "core/memory.hpp"
#include "linalg/inverse_iteration.hpp"
#include "linalg/sparse_cholesky.hpp"
#include "linalg/substructures/divided_problem.hpp"
#include "linalg/tall.hpp"

namespace thinwall::linalg {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// The cut-off of the interface's modes over that of the domains. Interface modes cost less than others of a domain, and
// their static shapes fit less well at higher frequencies.
constexpr double interface_cut_off = 2.0;
constexpr Index columns_of_iteration = 6;  // Φ, M Φ, Y, M Y, R and M R of inverse_iteration(), all at once

/// The condensed interface from its own rows and what the domains add.
MatrixXd interface_matrix(const Substructures& whole, double shift) {
  MatrixXd S = whole.stiffness(whole.division.interface, shift);
  for (const Domain& domain : whole.domains) S(domain.in_interface, domain.in_interface) += domain.condensed;
  return S;
}

/// The pairs of S ψ = μ S_h ψ with μ ≤ bound, ψᵀ S_h ψ = 1.
Eigenpairs interface_pairs(const MatrixXd& S, const MatrixXd& S_h, const Eigen::LLT<MatrixXd>& factor, double bound) {
  Eigenpairs pairs;
  if (S.rows() <= dense_up_to) {
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> dense(S, S_h);
    const Index kept = (dense.eigenvalues().array() <= bound).count();
    pairs.lambda = dense.eigenvalues().head(kept);
    pairs.Phi = dense.eigenvectors().leftCols(kept);
    return pairs;
  }
  const ShiftedInverse inverse{[&](const Eigen::Ref<const MatrixXd>& B) -> MatrixXd { return factor.solve(B); }, 0.0};
  return eigenpairs_up_to(SparseMatrix(S.sparseView()), SparseMatrix(S_h.sparseView()), inverse, bound);
}

/// The characteristic constraint modes up to the cut-off κ, from S(σ) and S(σ − h).
void reduce_interface(double cut_off, Substructures& whole) {
  const auto size = static_cast<Index>(whole.division.interface.size());
  core::require_memory(56.0 * static_cast<double>(size) * static_cast<double>(size),
                       "an interface of " + std::to_string(size) + " rows between the domains");
  const MatrixXd S = interface_matrix(whole, 0.0);
  whole.interface_factor.emplace(S);
  const double h = 0.1 * cut_off;
  whole.over_domains([&](Domain& domain) {
    const SparseMatrix A = whole.stiffness(domain.rows, -h);
    CondensedFactor factor(A, domain.border, domain.node_of_row);
    domain.condensed = condensed_inside(factor, A, domain);
  });
  // With S_h = S + h M_b the eigenvalue is μ = κ / (κ + h).
  const MatrixXd S_h = interface_matrix(whole, -h);
  for (Domain& domain : whole.domains) domain.condensed.resize(0, 0);
  const double bound = interface_cut_off * interface_cut_off * cut_off;
  Eigenpairs pairs = interface_pairs(S, S_h, *whole.interface_factor, bound / (bound + h));
  if (pairs.status != EigenStatus::converged) {
    throw core::NumericalError("the modes of an interface of " + std::to_string(size) +
                               " rows did not converge: find the modes without substructures");
  }
  whole.interface_modes = std::move(pairs.Phi);
  whole.interface_kappa = std::move(pairs.lambda);
}

/// The reduced masses of a domain: those of the interface modes, and between these and its own modes.
struct DomainMass {
  MatrixXd interface, coupling;
};

/// Extends the interface modes into a domain.
DomainMass extend(const Substructures& whole, Domain& domain) {
  const MatrixXd U = whole.interface_modes(domain.in_interface, Eigen::all);
  if (U.cols() == 0) {
    domain.constraint.resize(std::ssize(domain.rows), 0);
    return {MatrixXd(0, 0), MatrixXd(0, domain.modes.lambda.size())};
  }
  domain.constraint = -domain.factor->solve(domain.coupling * U);
  SparseMatrix M = restrict_to(whole.M, domain.rows);
  // The mass of the interface alone is not this domain's, so that its rows come in by what lies inside only.
  const MatrixXd of_border = restrict_to(M, domain.border) * U;
  domain.constraint(domain.border, Eigen::all) = U;
  MatrixXd MX = symmetric_product(M, domain.constraint);
  MX(domain.border, Eigen::all) -= of_border;
  return {tall_gram(domain.constraint, MX), tall_gram(MX, domain.modes.Phi)};
}

/// Throws unless there is memory for so many columns of all rows.
void require_columns(const Substructures& whole, Index columns, const std::string& of) {
  core::require_memory(
      8.0 * static_cast<double>(whole.K.rows()) * static_cast<double>(columns),
      std::to_string(columns) + " columns of " + std::to_string(whole.K.rows()) + " rows for the " + of);
}

/// The small problem in the amplitudes of the interface modes, then of the modes of each domain.
struct Reduced {
  VectorXd kappa;
  MatrixXd amplitudes;
};

Reduced reduced_modes(Substructures& whole) {
  const Index shared = whole.interface_modes.cols();
  Index size = shared;
  for (const Domain& domain : whole.domains) size += domain.modes.lambda.size();
  if (size == 0) return {VectorXd(0), MatrixXd(0, 0)};
  require_columns(whole, 2 * shared, "modes of the interface");  // with M times them
  std::vector<DomainMass> masses(whole.domains.size());
  core::parallel_for(masses.size(), [&](std::size_t d) { masses[d] = extend(whole, whole.domains[d]); });
  MatrixXd K = MatrixXd::Zero(size, size), M = MatrixXd::Identity(size, size);
  const SparseMatrix M_bb = restrict_to(whole.M, whole.division.interface);
  M.topLeftCorner(shared, shared) = whole.interface_modes.transpose() * (M_bb * whole.interface_modes);
  K.diagonal().head(shared) = whole.interface_kappa;
  Index at = shared;
  for (std::size_t d = 0; d < masses.size(); ++d) {
    const VectorXd& kappa = whole.domains[d].modes.lambda;
    M.topLeftCorner(shared, shared) += masses[d].interface;
    M.block(0, at, shared, kappa.size()) = masses[d].coupling;
    K.diagonal().segment(at, kappa.size()) = kappa;
    at += kappa.size();
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> small(K, MatrixXd(M.selfadjointView<Eigen::Upper>()));
  if (small.info() != Eigen::Success || !small.eigenvalues().allFinite())
    throw core::NumericalError("the reduced problem of the substructures could not be solved: take fewer domains");
  return {small.eigenvalues(), small.eigenvectors()};
}

/// The shapes of the first `count` modes of the small problem.
MatrixXd expanded(const Substructures& whole, const Reduced& reduced, Index count) {
  const Index shared = whole.interface_modes.cols();
  const auto q = reduced.amplitudes.leftCols(count);
  MatrixXd Phi(whole.K.rows(), count);
  std::vector<Index> first{shared};
  for (const Domain& domain : whole.domains) first.push_back(first.back() + domain.modes.lambda.size());
  core::parallel_for(whole.domains.size(), [&](std::size_t d) {
    const Domain& domain = whole.domains[d];
    MatrixXd X = tall_product(domain.constraint, q.topRows(shared));
    tall_subtract(X, domain.modes.Phi, -q.middleRows(first[d], first[d + 1] - first[d]));
    Phi(whole.division.inner[d], Eigen::all) = X(domain.inner, Eigen::all);
  });
  Phi(whole.division.interface, Eigen::all) = whole.interface_modes * q.topRows(shared);
  return Phi;
}

/// K_σ⁻¹ by the factors of the domains and of the interface: x_b = S⁻¹ (f_b − Σ K_bi K_ii⁻¹ f_i), x_i = K_ii⁻¹ (f_i −
/// K_ib x_b).
MatrixXd solve(const Substructures& whole, const Eigen::Ref<const MatrixXd>& F) {
  const auto& domains = whole.domains;
  std::vector<MatrixXd> at_border(domains.size());
  core::parallel_for(domains.size(), [&](std::size_t d) {
    at_border[d] = domains[d].coupling.transpose() * domains[d].factor->solve(F(domains[d].rows, Eigen::all));
  });
  MatrixXd F_b = F(whole.division.interface, Eigen::all);
  for (std::size_t d = 0; d < domains.size(); ++d) F_b(domains[d].in_interface, Eigen::all) -= at_border[d];
  const MatrixXd X_b = whole.interface_factor->solve(F_b);
  MatrixXd X(F.rows(), F.cols());
  X(whole.division.interface, Eigen::all) = X_b;
  core::parallel_for(domains.size(), [&](std::size_t d) {
    MatrixXd F_i = F(domains[d].rows, Eigen::all);
    F_i -= domains[d].coupling * X_b(domains[d].in_interface, Eigen::all);
    X(whole.division.inner[d], Eigen::all) = domains[d].factor->solve(F_i)(domains[d].inner, Eigen::all);
  });
  return X;
}

/// solve(), by as few columns at a time as the factors need to be quick.
MatrixXd solve_in_strips(const Substructures& whole, const Eigen::Ref<const MatrixXd>& F) {
  constexpr Index strip = 32;
  MatrixXd X(F.rows(), F.cols());
  for (Index at = 0; at < F.cols(); at += strip) {
    const Index columns = std::min(strip, F.cols() - at);
    X.middleCols(at, columns) = solve(whole, F.middleCols(at, columns));
  }
  return X;
}

/// The amount that an inverse iteration took from each λ, and the iteration before it; infinite where there was none.
struct Drops {
  Eigen::ArrayXd last, before;
};

/// The errors of frequencies √λ that belong to errors of their λ.
VectorXd of_frequencies(const Eigen::ArrayXd& errors, const VectorXd& lambda, double sigma, double noise) {
  return 0.5 * errors / lambda.array().max(std::max(-sigma, noise));
}

/// The round-off of an eigenvalue, which no iteration removes.
double round_off(const SparseMatrix& K, const SparseMatrix& M) {
  return std::numeric_limits<double>::epsilon() * K.diagonal().sum() / M.diagonal().sum();
}

/// The estimate of what remains of the errors of λ, infinite from the pair `beyond` on; none where the last drop was
/// round-off, `noise`.
Eigen::ArrayXd remaining_errors(const Drops& drops, const VectorXd& lambda, double sigma, Index beyond, double noise) {
  const Eigen::ArrayXd kappa = lambda.array() - sigma;
  const Eigen::ArrayXd foreseen = (kappa / kappa(beyond)).square();
  const Eigen::ArrayXd seen = drops.last / drops.before;
  const Eigen::ArrayXd rate = foreseen.max(seen);
  const Eigen::ArrayXd remaining = (rate < 1.0).select(drops.last * rate / (1.0 - rate), HUGE_VAL);
  return (drops.last > noise).select(remaining, 0.0);
}

/// The number of pairs that are wanted of these: with a bound all that may lie below it within the tolerance.
Index wanted_of(const VectorXd& lambda, const SubstructureOptions& options) {
  return options.lambda_max > 0.0 ? (lambda.array() <= (1.0 + 2.0 * options.tolerance) * options.lambda_max).count()
                                  : std::min<Index>(options.count, lambda.size());
}

/// Inverse iterations until all wanted errors are within the tolerance.
void improve(const Substructures& whole, const ShiftedInverse& inverse, const SubstructureOptions& options,
             SubstructuredPairs& result) {
  constexpr int most_steps = 20;
  Eigenpairs& pairs = result.pairs;
  const double noise = round_off(whole.K, whole.M);
  const bool up_to = options.lambda_max > 0.0;
  Index wanted = 0;
  pairs.status = EigenStatus::not_converged;
  Drops drops{{}, Eigen::ArrayXd::Constant(pairs.lambda.size(), HUGE_VAL)};
  while (pairs.status != EigenStatus::converged && result.steps < most_steps) {
    const VectorXd before = pairs.lambda;
    if (!inverse_iteration(whole.M, inverse, pairs)) break;
    ++result.steps;
    drops.last = (before - pairs.lambda).cwiseMax(0.0);
    wanted = wanted_of(pairs.lambda, options);
    const Index beyond = (wanted + pairs.lambda.size() - 1) / 2;
    const Eigen::ArrayXd remaining = remaining_errors(drops, pairs.lambda, whole.sigma, beyond, noise);
    result.error = of_frequencies(remaining + noise, pairs.lambda, whole.sigma, noise);
    drops.before = drops.last;
    const VectorXd removable = of_frequencies(remaining, pairs.lambda, whole.sigma, noise);
    // The pair behind may belong below lambda_max, which shows once it is right, too.
    const Index held = up_to ? std::max(wanted, std::min(wanted + 1, beyond)) : wanted;
    if ((removable.head(held).array() <= options.tolerance).all()) pairs.status = EigenStatus::converged;
  }
  if (wanted < options.count && !up_to) pairs.status = EigenStatus::not_converged;
  if (up_to && pairs.status == EigenStatus::converged)
    wanted = ((pairs.lambda.array() * (1.0 - 2.0 * result.error.array())).head(wanted) <= options.lambda_max).count();
  pairs.lambda.conservativeResize(wanted);
  pairs.Phi.conservativeResize(Eigen::NoChange, wanted);
  pairs.inverse_residual.conservativeResize(wanted);
  result.error.conservativeResize(wanted);
}

/// Gives up what the domains have found once their shapes are in those of the whole, with their factors unless these
/// are to solve.
void give_up(bool factors_too, Substructures& whole) {
  for (Domain& domain : whole.domains) {
    domain.modes.Phi.resize(0, 0);
    domain.constraint.resize(0, 0);
    if (!factors_too) continue;
    domain.factor.reset();
    domain.coupling.resize(0, 0);
  }
  if (factors_too) whole.interface_factor.reset();
}

/// The number of modes of the small problem to carry along, the wanted ones included and others, which keep the errors
/// of the last ones from being large.
Index carried(const VectorXd& lambda, const SubstructureOptions& options) {
  const Index wanted = wanted_of(lambda, options);
  return std::min<Index>(wanted + std::max<Index>(8, wanted / 4), lambda.size());
}

/// True if a division leaves anything to be joined, and enough rows inside for the modes wanted.
bool serves(const Domains& division, Index rows, const SubstructureOptions& options) {
  const Index inner = rows - std::ssize(division.interface);
  return division.inner.size() > 1 && inner < rows && (options.lambda_max > 0.0 || options.count <= inner);
}

/// The pairs of the whole matrix by block Lanczos, where it cannot be divided.
SubstructuredPairs undivided(const SparseMatrix& K, const SparseMatrix& M, const ShiftedInverse& given,
                             const std::vector<int>& node_of_row, const SubstructureOptions& options) {
  std::optional<SparseCholesky> factor;
  if (!given.apply) factor.emplace(K, -given.sigma, M, node_of_row);
  const ShiftedInverse by_factor{[&](const Eigen::Ref<const MatrixXd>& F) { return factor->solve(F); }, given.sigma};
  const ShiftedInverse& inverse = given.apply ? given : by_factor;
  SubstructuredPairs result;
  result.pairs = options.lambda_max > 0.0 ? eigenpairs_up_to(K, M, inverse, options.lambda_max)
                                          : lowest_eigenpairs(K, M, inverse, options.count);
  const double noise = round_off(K, M);
  result.error = of_frequencies(Eigen::ArrayXd::Constant(result.pairs.lambda.size(), noise), result.pairs.lambda,
                                given.sigma, noise);
  result.domains = 1;
  result.cut_off = HUGE_VAL;
  return result;
}

void require_possible(const SparseMatrix& K, const SubstructureOptions& options) {
  if (options.lambda_max > 0.0 || (options.count >= 1 && 2 * options.count <= K.rows())) return;
  throw core::InputError("asked for " + std::to_string(options.count) + " modes of substructures with " +
                         std::to_string(K.rows()) + " degrees of freedom in all: ask for 1 to " +
                         std::to_string(K.rows() / 2));
}

/// The numbers of what gave a reduced problem.
SubstructuredPairs size_of(const Substructures& whole, const Reduced& reduced) {
  SubstructuredPairs result;
  result.domains = static_cast<int>(whole.domains.size());
  result.interface = std::ssize(whole.division.interface);
  result.interface_modes = whole.interface_modes.cols();
  result.inner_modes = reduced.kappa.size() - result.interface_modes;
  result.pairs.Phi.resize(whole.K.rows(), 0);
  return result;
}

}  // namespace

SubstructuredPairs substructured_eigenpairs(const SparseMatrix& K, const SparseMatrix& M, const ShiftedInverse& given,
                                            const SubstructureOptions& options) {
  const double sigma = given.sigma;
  require_possible(K, options);
  Substructures whole{K, M, sigma, divide(combine(1.0, K, -sigma, M), options.domains)};
  if (!serves(whole.division, K.rows(), options)) return undivided(K, M, given, whole.division.node_of_row, options);
  for (std::size_t d = 0; d < whole.division.inner.size(); ++d) whole.domains.push_back(domain_of(whole.division, d));
  whole.over_domains([&](Domain& domain) { condense(whole, domain); });
  const double cut_off = find_domain_modes(options, whole);
  reduce_interface(cut_off, whole);
  const Reduced reduced = reduced_modes(whole);
  SubstructuredPairs result = size_of(whole, reduced);
  result.cut_off = cut_off + sigma;
  // Without any mode below the cut-offs all lie above lambda_max: 1/√λ ≤ 1/√κ of a domain + 1/√κ of the interface.
  if (reduced.kappa.size() == 0) return result;
  const VectorXd lambda = reduced.kappa.array() + sigma;
  const Index kept = carried(lambda, options);
  result.pairs.lambda = lambda.head(kept);
  require_columns(whole, columns_of_iteration * kept, "modes and their inverse iteration");
  result.pairs.Phi = expanded(whole, reduced, kept);
  give_up(given.apply != nullptr, whole);
  const ShiftedInverse by_domains{[&](const Eigen::Ref<const MatrixXd>& F) { return solve_in_strips(whole, F); },
                                  sigma};
  improve(whole, given.apply ? given : by_domains, options, result);
  if (result.pairs.lambda.size() > 0 && result.pairs.lambda.tail(1)(0) > result.cut_off)
    result.pairs.status = EigenStatus::not_converged;
  return result;
}

}  // namespace thinwall::linalg
