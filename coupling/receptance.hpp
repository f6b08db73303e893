#pragma once
// The receptance route (RCSA): the coupled response from the responses of the components alone.

#include <string>
#include <vector>

#include "coupling/joints.hpp"
#include "coupling/kernel.hpp"
#include "dynamics/response_model.hpp"

namespace thinwall::coupling {

/// How well the worst line could be solved.
enum class KernelStatus {
  well_conditioned,
  ill_conditioned,  ///< more than half of the digits are lost at some line (condition above 1e8)
  regularised,      ///< at some line singular values were dropped; `dropped` and `compatibility_residual` say how many
};

/// Of couple().
struct CouplingOptions {
  double length = default_length;                        ///< m a radian, > 0: scales rotations in the kernel
  Regularisation regularisation = Regularisation::none;  ///< what becomes of the kernel's small singular values
  double threshold = 1e-10;                              ///< of the largest singular value, in (0, 1)
  double component_error = 0.0;       ///< relative error of every receptance of the components, ≥ 0; 0: not asked
  std::vector<std::string> points{};  ///< whose rows and columns are wanted; empty: all
};

/// The coupled response and how well its kernel could be solved. One value a line throughout.
struct [[nodiscard]] CoupledResponse {
  dynamics::ResponseModel response;  ///< rows: the responses of the components in their order; columns: forces alike
  Eigen::VectorXd kernel_condition;
  KernelStatus status = KernelStatus::well_conditioned;
  Eigen::VectorXi dropped;                 ///< singular values left out (Tikhonov: more than halved)
  Eigen::VectorXd compatibility_residual;  ///< largest relative gap left open at rigid joints; 0 without regularisation
  std::vector<Eigen::MatrixXd> error;      ///< bound of each entry's error; empty unless component_error was given
};

/// Joins any number of components at the contacts. With Y = blkdiag(H_1, H_2, …) and B one column a joined direction,
/// +n at point a and −n at point b (rotations times L),
///
///     G = Y − Y B S⁻¹ Bᵀ Y,     S = Bᵀ Y B + Z⁻¹,     Z = K (1 + iη) + iωC,  Z⁻¹ = 0 for a rigid direction
///
/// (the dual, Lagrange-multiplier form of de Klerk, Rixen & Voormeeren 2008, with joints; docs/theory/coupling.md, Eq.
/// 4-8), or any symmetric Z over a contact's directions. For two components P and R its part-part block is G_ab = H_ab
/// − H_aP B [Bᵀ (H_PP + H_RR) B + Z⁻¹]⁻¹ Bᵀ H_Pb for any a and b of the part (Barrios 2019, Eq. 6 and 12-14,
/// generalised). No component's receptance is inverted, so each may be of any rank. All inputs in m/N (rad/N, …) on
/// equal axes; a component may have other points as responses than as forces, but its contact points as both.
///
/// The condition reported is Skeel's (coupling/kernel.hpp) over the components' terms |B_cᵀ H_c B_c| and |Z⁻¹|. Its
/// consequence: if every H_c,ij is off by no more than ε |H_c,ij|, then to first order
///
///     |δG| ≤ ε |I − Y B S⁻¹ Bᵀ| |Y| |I − B S⁻¹ Bᵀ Y|      entry by entry, |·| too
///
/// which is `error` for ε = component_error (of what a regularisation leaves, not of what it drops).
///
/// Errors: InputError for unequal axes (with their overlap), points of one name in two components, unknown points, a
/// value that is not finite, a faulty contact or option; NumericalError with the frequency where the kernel is singular
/// (condition above 1e14). Cost lines · (n² m + m³) for n wanted DOFs and m directions.
CoupledResponse couple(const std::vector<dynamics::ResponseModel>& components, const std::vector<Contact>& contacts,
                       const CouplingOptions& options = {});

/// The same for two.
CoupledResponse couple(const dynamics::ResponseModel& part, const dynamics::ResponseModel& robot,
                       const std::vector<Contact>& contacts, const CouplingOptions& options = {});

/// `error` beside the entry (response, force), both by DOF name: one value a line. Throws InputError if either is
/// absent or no component_error was given.
[[nodiscard]] Eigen::VectorXd relative_error(const CoupledResponse& coupled, const std::string& response,
                                             const std::string& force);

/// Throws InputError with every violation at once: a length that is not positive, a threshold outside (0, 1), a
/// negative component_error.
void require_valid(const CouplingOptions& options);

}  // namespace thinwall::coupling
