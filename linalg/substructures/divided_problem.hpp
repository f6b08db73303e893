#pragma once
// A matrix divided into domains, and what every domain finds by itself.

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "core/dense_factorisations.hpp"
#include "core/parallel.hpp"
#include "linalg/substructures/condensed_factor.hpp"
#include "linalg/substructures/domains.hpp"
#include "linalg/substructures/substructured_eigenpairs.hpp"

namespace thinwall::linalg {

/// Rows up to which dense algebra finds many modes sooner than Lanczos.
inline constexpr Eigen::Index dense_up_to = 600;

/// A domain with its border, in local rows, and what its reduction gives.
struct Domain {
  std::vector<int> rows;          ///< of the whole matrix, ascending: inner ones and border
  std::vector<int> inner;         ///< local
  std::vector<int> border;        ///< local
  std::vector<int> in_interface;  ///< the number of each row of the border in the interface
  std::vector<int> node_of_row;
  SparseMatrix coupling;  ///< local × border: K_ib
  std::unique_ptr<CondensedFactor> factor;
  Eigen::MatrixXd condensed;   ///< border × border: −K_bi K_ii⁻¹ K_ib
  Eigenpairs modes;            ///< local, zero at the border; κ in place of λ
  Eigen::MatrixXd constraint;  ///< local × interface modes
};

/// The whole problem K_σ = K − σM, divided.
struct Substructures {
  const SparseMatrix& K;
  const SparseMatrix& M;
  double sigma;
  Domains division;
  std::vector<Domain> domains{};
  std::optional<Eigen::LLT<Eigen::MatrixXd>> interface_factor{};  ///< of S, while it is to solve
  Eigen::MatrixXd interface_modes{};                              ///< interface × kept
  Eigen::VectorXd interface_kappa{};  ///< the Rayleigh quotients ψᵀSψ, with the ψ as they are normalised

  /// K − (σ + shift) M on some rows.
  [[nodiscard]] SparseMatrix stiffness(const std::vector<int>& rows, double shift = 0.0) const {
    SparseMatrix A = restrict_to(K, rows);
    return sigma + shift == 0.0 ? A : combine(1.0, A, -sigma - shift, restrict_to(M, rows));
  }
  /// Does body(domain) for all domains side by side.
  template <class Body>
  void over_domains(const Body& body) {
    core::parallel_for(domains.size(), [&](std::size_t d) { body(domains[d]); });
  }
};

/// The domain d of a division, with no factor and no modes.
[[nodiscard]] Domain domain_of(const Domains& domains, std::size_t d);

/// −A_bi A_ii⁻¹ A_ib of a domain's matrix A and its factor, once. Cost O(border²).
[[nodiscard]] Eigen::MatrixXd condensed_inside(CondensedFactor& factor, const SparseMatrix& A, const Domain& domain);

/// Gives a domain its factor and what it adds to the condensed interface. Throws as CondensedFactor does.
void condense(const Substructures& whole, Domain& domain);

/// Finds the modes of all domains, which are condensed, up to one cut-off κ; it is returned and lies four times above
/// all wanted. Throws NumericalError if those of a domain do not converge.
double find_domain_modes(const SubstructureOptions& options, Substructures& whole);

}  // namespace thinwall::linalg
