#include "linalg/substructures/divided_problem.hpp"

#include <algorithm>
#include <string>

#include "core/error.hpp"

namespace thinwall::linalg {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// The cut-off of the domains' modes over the last frequency wanted.
constexpr double domain_cut_off = 2.0;

/// The place of every entry of `wanted` in `all`; both ascend.
std::vector<int> places(const std::vector<int>& wanted, const std::vector<int>& all) {
  std::vector<int> result;
  for (const int row : wanted) result.push_back(static_cast<int>(std::ranges::lower_bound(all, row) - all.begin()));
  return result;
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

/// True if a domain may have modes up to κ that are not found.
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

}  // namespace

Domain domain_of(const Domains& domains, std::size_t d) {
  Domain domain;
  std::ranges::set_union(domains.inner[d], domains.border[d], std::back_inserter(domain.rows));
  domain.inner = places(domains.inner[d], domain.rows);
  domain.border = places(domains.border[d], domain.rows);
  domain.in_interface = places(domains.border[d], domains.interface);
  for (const int row : domain.rows) domain.node_of_row.push_back(domains.node_of_row[static_cast<std::size_t>(row)]);
  return domain;
}

MatrixXd condensed_inside(CondensedFactor& factor, const SparseMatrix& A, const Domain& domain) {
  MatrixXd result = factor.take_condensed();
  result -= MatrixXd(restrict_to(A, domain.border));
  return result;
}

void condense(const Substructures& whole, Domain& domain) {
  const SparseMatrix A = whole.stiffness(domain.rows);
  domain.factor = std::make_unique<CondensedFactor>(A, domain.border, domain.node_of_row);
  domain.condensed = condensed_inside(*domain.factor, A, domain);
  domain.coupling = coupling_of(A, domain.border);
}

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

}  // namespace thinwall::linalg
