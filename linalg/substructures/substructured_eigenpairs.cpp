#include "linalg/substructures/substructured_eigenpairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/dense_eigenvalues.hpp"
#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "core/memory.hpp"
#include "core/parallel.hpp"
#include "linalg/inverse_iteration.hpp"
#include "linalg/substructures/condensed_factor.hpp"
#include "linalg/substructures/domains.hpp"
#include "linalg/tall.hpp"

namespace thinwall::linalg {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index dense_up_to = 600;  // rows, up to which dense algebra finds many modes sooner than Lanczos
// The cut-offs of the domains' modes over the last frequency wanted, and of the interface's modes over these. Interface
// modes cost less than others of a domain, and their static shapes fit less well at higher frequencies.
constexpr double domain_cut_off = 2.0, interface_cut_off = 2.0;

/// A domain with its border, in local rows, and what its reduction gives.
struct Domain {
  std::vector<int> rows;          // of the whole matrix, ascending: inner ones and border
  std::vector<int> inner;         // local
  std::vector<int> border;        // local
  std::vector<int> in_interface;  // the number of each row of the border in the interface
  std::vector<int> node_of_row;
  SparseMatrix coupling;  // local × border: K_ib
  std::unique_ptr<CondensedFactor> factor;
  MatrixXd condensed;   // border × border: −K_bi K_ii⁻¹ K_ib
  Eigenpairs modes;     // local, zero at the border; κ in place of λ
  MatrixXd constraint;  // local × interface modes
};

/// The place of every entry of `wanted` in `all`; both ascend.
std::vector<int> places(const std::vector<int>& wanted, const std::vector<int>& all) {
  std::vector<int> result;
  for (const int row : wanted) result.push_back(static_cast<int>(std::ranges::lower_bound(all, row) - all.begin()));
  return result;
}

Domain domain_of(const Domains& domains, std::size_t d) {
  Domain domain;
  std::ranges::set_union(domains.inner[d], domains.border[d], std::back_inserter(domain.rows));
  domain.inner = places(domains.inner[d], domain.rows);
  domain.border = places(domains.border[d], domain.rows);
  domain.in_interface = places(domains.border[d], domains.interface);
  for (const int row : domain.rows) domain.node_of_row.push_back(domains.node_of_row[static_cast<std::size_t>(row)]);
  return domain;
}

/// The columns `border` of A without their rows there.
SparseMatrix coupling_of(const SparseMatrix& A, const std::vector<int>& border) {
  std::vector<char> in_border(static_cast<std::size_t>(A.rows()), 0);
  for (const int row : border) in_border[static_cast<std::size_t>(row)] = 1;
  SparseMatrix result(A.rows(), static_cast<Index>(border.size()));
  for (Index j = 0; j < result.cols(); ++j) {
    result.startVec(j);
    for (SparseMatrix::InnerIterator it(A, border[static_cast<std::size_t>(j)]); it; ++it)
      if (in_border[static_cast<std::size_t>(it.row())] == 0) result.insertBack(it.row(), j) = it.value();
  }
  result.finalize();
  return result;
}

/// The whole problem K_σ = K − σM, divided.
struct Substructures {
  const SparseMatrix& K;
  const SparseMatrix& M;
  double sigma;
  Domains division;
  std::vector<Domain> domains{};
  Eigen::LLT<MatrixXd> interface_factor{};
  MatrixXd interface_modes{};  // interface × kept
  VectorXd interface_kappa{};  // the Rayleigh quotients ψᵀSψ, with the ψ as they are normalised

  /// K − (σ + shift) M on some rows.
  [[nodiscard]] SparseMatrix stiffness(const std::vector<int>& rows, double shift = 0.0) const {
    SparseMatrix A = restrict_to(K, rows);
    return sigma + shift == 0.0 ? A : combine(1.0, A, -sigma - shift, restrict_to(M, rows));
  }
  template <class Body>
  void over_domains(const Body& body) {
    core::parallel_for(domains.size(), [&](std::size_t d) { body(domains[d]); });
  }
};

/// −A_bi A_ii⁻¹ A_ib.
MatrixXd condensed_inside(CondensedFactor& factor, const SparseMatrix& A, const Domain& domain) {
  MatrixXd result = factor.take_condensed();
  result -= MatrixXd(restrict_to(A, domain.border));
  return result;
}

/// The first `kept` of some modes.
Eigenpairs leading(const Eigenpairs& modes, Index kept) {
  return {modes.lambda.head(kept), modes.Phi.leftCols(kept), modes.inverse_residual.head(kept), modes.status};
}

/// All fixed-interface modes of a domain, by dense algebra.
Eigenpairs all_fixed_modes(const SparseMatrix& A, const SparseMatrix& M, const Domain& domain) {
  MatrixXd W = MatrixXd::Zero(A.rows(), static_cast<Index>(domain.border.size()));
  for (Index j = 0; j < W.cols(); ++j) W(domain.border[static_cast<std::size_t>(j)], j) = 1.0;
  return dense_eigenpairs(A, M, W);
}

ShiftedInverse inverse_inside(const Domain& domain) {
  return {[&](const Eigen::Ref<const MatrixXd>& B) -> MatrixXd { return domain.factor->solve(B); }, 0.0};
}

void require_converged(const Domain& domain) {
  if (domain.modes.status == EigenStatus::converged) return;
  throw core::NumericalError("the modes of a domain of " + std::to_string(domain.rows.size()) +
                             " rows did not converge: take fewer domains, or find the modes without substructures");
}

/// Finds at least `count` of the fixed-interface modes, or all where there are fewer.
void find_lowest(const Substructures& whole, Index count, Domain& domain) {
  const SparseMatrix A = whole.stiffness(domain.rows), M = restrict_to(whole.M, domain.rows);
  if (A.rows() <= dense_up_to || 2 * count >= static_cast<Index>(domain.inner.size())) {
    domain.modes = all_fixed_modes(A, M, domain);
  } else {
    domain.modes = lowest_eigenpairs(A, M, inverse_inside(domain), static_cast<int>(count), 1e-6);
  }
  require_converged(domain);
}

/// Finds all fixed-interface modes up to κ.
void find_up_to(const Substructures& whole, double kappa, Domain& domain) {
  const SparseMatrix A = whole.stiffness(domain.rows), M = restrict_to(whole.M, domain.rows);
  if (A.rows() <= dense_up_to) {
    const Eigenpairs all = all_fixed_modes(A, M, domain);
    domain.modes = leading(all, (all.lambda.array() <= kappa).count());
  } else {
    domain.modes = eigenpairs_up_to(A, M, inverse_inside(domain), kappa);
  }
  require_converged(domain);
}

/// Whether a domain may have modes up to κ that are not found.
bool ends_below(const Domain& domain, double kappa) {
  const VectorXd& found = domain.modes.lambda;
  return found.size() < static_cast<Index>(domain.inner.size()) && found(found.size() - 1) < kappa;
}

/// The count-th smallest κ that is found in all domains together.
double kappa_found(const Substructures& whole, int count) {
  std::vector<double> all;
  for (const Domain& domain : whole.domains)
    all.insert(all.end(), domain.modes.lambda.begin(), domain.modes.lambda.end());
  const auto last = all.begin() + (std::min<std::ptrdiff_t>(count, std::ssize(all)) - 1);
  std::ranges::nth_element(all, last);
  return *last;
}

/// The count-th smallest κ of all domains together. It lies above that of the whole, because holding the interface only
/// raises κ. More modes are found in domains softer than others until none can have one below.
double kappa_of_domains(Substructures& whole, int count) {
  double bound = kappa_found(whole, count);
  while (std::ranges::any_of(whole.domains, [&](const Domain& domain) { return ends_below(domain, bound); })) {
    whole.over_domains([&](Domain& domain) {
      if (ends_below(domain, bound)) find_lowest(whole, 2 * domain.modes.lambda.size(), domain);
    });
    bound = kappa_found(whole, count);
  }
  return bound;
}

/// Finds the modes of all domains up to one cut-off κ, which is returned and lies above all wanted.
double find_domain_modes(const SubstructureOptions& options, Substructures& whole) {
  constexpr double above = domain_cut_off * domain_cut_off;
  if (options.lambda_max > 0.0) {
    const double cut_off = above * (options.lambda_max - whole.sigma);
    whole.over_domains([&](Domain& domain) { find_up_to(whole, cut_off, domain); });
    return cut_off;
  }
  const double rows = static_cast<double>(whole.K.rows() - std::ssize(whole.division.interface));
  whole.over_domains([&](Domain& domain) {
    const double share = domain_cut_off * options.count * static_cast<double>(domain.inner.size()) / rows;
    find_lowest(whole, std::min(static_cast<Index>(share) + 4, std::ssize(domain.inner)), domain);
  });
  const double cut_off = above * kappa_of_domains(whole, options.count);
  whole.over_domains([&](Domain& domain) {
    const Eigenpairs& modes = domain.modes;
    if (ends_below(domain, cut_off)) find_up_to(whole, cut_off, domain);
    domain.modes = leading(modes, (modes.lambda.array() <= cut_off).count());
  });
  return cut_off;
}

/// The factor of a domain and what it adds to the condensed interface.
void condense(const Substructures& whole, Domain& domain) {
  const SparseMatrix A = whole.stiffness(domain.rows);
  domain.factor = std::make_unique<CondensedFactor>(A, domain.border, domain.node_of_row);
  domain.condensed = condensed_inside(*domain.factor, A, domain);
  domain.coupling = coupling_of(A, domain.border);
}

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
  whole.interface_factor.compute(S);
  const double h = 0.1 * cut_off;
  whole.over_domains([&](Domain& domain) {
    const SparseMatrix A = whole.stiffness(domain.rows, -h);
    CondensedFactor factor(A, domain.border, domain.node_of_row);
    domain.condensed = condensed_inside(factor, A, domain);
  });
  // With S_h = S + h M_b the eigenvalue is μ = κ / (κ + h).
  const MatrixXd S_h = interface_matrix(whole, -h);
  const double bound = interface_cut_off * interface_cut_off * cut_off;
  Eigenpairs pairs = interface_pairs(S, S_h, whole.interface_factor, bound / (bound + h));
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
  domain.constraint = -domain.factor->solve(domain.coupling * U);
  SparseMatrix M = restrict_to(whole.M, domain.rows);
  // The mass of the interface alone is not this domain's, so that its rows come in by what lies inside only.
  const MatrixXd of_border = restrict_to(M, domain.border) * U;
  domain.constraint(domain.border, Eigen::all) = U;
  MatrixXd MX = symmetric_product(M, domain.constraint);
  MX(domain.border, Eigen::all) -= of_border;
  return {tall_gram(domain.constraint, MX), tall_gram(MX, domain.modes.Phi)};
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
  const MatrixXd X_b = whole.interface_factor.solve(F_b);
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

/// What an inverse iteration took from each λ, and the iteration before it; infinite where there was none.
struct Drops {
  Eigen::ArrayXd last, before;
};

/// The estimated errors of the frequencies, infinite from the pair `beyond` on. `noise`: the round-off of a λ.
VectorXd estimated_errors(const Drops& drops, const VectorXd& lambda, double sigma, Index beyond, double noise) {
  const Eigen::ArrayXd kappa = lambda.array() - sigma;
  const Eigen::ArrayXd foreseen = (kappa / kappa(beyond)).square();
  const Eigen::ArrayXd seen = drops.last / drops.before;
  const Eigen::ArrayXd rate = foreseen.max(seen);
  const Eigen::ArrayXd remaining = (rate < 1.0).select(drops.last * rate / (1.0 - rate), HUGE_VAL);
  const Eigen::ArrayXd above_noise = (drops.last > noise).select(remaining, 0.0);
  return 0.5 * (above_noise + noise) / lambda.array().max(std::max(-sigma, noise));
}

/// The number of pairs that are wanted of these, and of those to carry along, which keep the errors of the last ones
/// from being large.
Index wanted_of(const VectorXd& lambda, const SubstructureOptions& options) {
  return options.lambda_max > 0.0 ? (lambda.array() <= options.lambda_max).count()
                                  : std::min<Index>(options.count, lambda.size());
}

/// Inverse iterations until all wanted errors are within the tolerance.
void improve(const Substructures& whole, const ShiftedInverse& inverse, const SubstructureOptions& options,
             SubstructuredPairs& result) {
  constexpr int most_steps = 20;
  Eigenpairs& pairs = result.pairs;
  const double noise = std::numeric_limits<double>::epsilon() * whole.K.diagonal().sum() / whole.M.diagonal().sum();
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
    result.error = estimated_errors(drops, pairs.lambda, whole.sigma, beyond, noise);
    drops.before = drops.last;
    if ((result.error.head(wanted).array() <= options.tolerance).all()) pairs.status = EigenStatus::converged;
  }
  if (wanted < options.count && options.lambda_max <= 0.0) pairs.status = EigenStatus::not_converged;
  pairs.lambda.conservativeResize(wanted);
  pairs.Phi.conservativeResize(Eigen::NoChange, wanted);
  pairs.inverse_residual.conservativeResize(wanted);
  result.error.conservativeResize(wanted);
}

/// The number of modes of the small problem to carry along, the wanted ones included.
Index carried(const VectorXd& lambda, const SubstructureOptions& options) {
  const Index wanted = wanted_of(lambda, options);
  return std::min<Index>(wanted + std::max<Index>(8, wanted / 4), lambda.size());
}

void require_possible(const SparseMatrix& K, const SubstructureOptions& options) {
  if (options.lambda_max > 0.0 || (options.count >= 1 && 2 * options.count <= K.rows())) return;
  throw core::InputError("asked for " + std::to_string(options.count) + " modes of substructures with " +
                         std::to_string(K.rows()) + " degrees of freedom in all: ask for 1 to " +
                         std::to_string(K.rows() / 2));
}

}  // namespace

SubstructuredPairs substructured_eigenpairs(const SparseMatrix& K, const SparseMatrix& M, const ShiftedInverse& given,
                                            const SubstructureOptions& options) {
  const double sigma = given.sigma;
  require_possible(K, options);
  Substructures whole{K, M, sigma, divide(combine(1.0, K, -sigma, M), options.domains)};
  for (std::size_t d = 0; d < whole.division.inner.size(); ++d) whole.domains.push_back(domain_of(whole.division, d));
  whole.over_domains([&](Domain& domain) { condense(whole, domain); });
  const double cut_off = find_domain_modes(options, whole);
  reduce_interface(cut_off, whole);
  const Reduced reduced = reduced_modes(whole);
  SubstructuredPairs result;
  result.domains = static_cast<int>(whole.domains.size());
  result.interface = static_cast<Index>(whole.division.interface.size());
  result.interface_modes = whole.interface_modes.cols();
  result.inner_modes = reduced.kappa.size() - result.interface_modes;
  result.cut_off = cut_off + sigma;
  const VectorXd lambda = reduced.kappa.array() + sigma;
  const Index kept = carried(lambda, options);
  result.pairs.lambda = lambda.head(kept);
  result.pairs.Phi = expanded(whole, reduced, kept);
  for (Domain& domain : whole.domains) {  // their shapes are in those of the whole
    domain.modes.Phi.resize(0, 0);
    domain.constraint.resize(0, 0);
  }
  const ShiftedInverse by_domains{[&](const Eigen::Ref<const MatrixXd>& F) { return solve_in_strips(whole, F); },
                                  sigma};
  improve(whole, given.apply ? given : by_domains, options, result);
  if (result.pairs.lambda.size() > 0 && result.pairs.lambda.tail(1)(0) > result.cut_off)
    result.pairs.status = EigenStatus::not_converged;
  return result;
}

}  // namespace thinwall::linalg
