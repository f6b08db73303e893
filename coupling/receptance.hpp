#pragma once
// The receptance route (RCSA): the coupled response from the responses of the components alone.

#include <string>
#include <vector>

#include "coupling/joints.hpp"
#include "coupling/kernel.hpp"
#include "dynamics/response_model.hpp"

namespace thinwall::coupling {

/// Quality of the worst line's solution.
enum class KernelStatus {
  well_conditioned,
  ill_conditioned,  ///< condition above 1e8 at some line: more than half of the digits are lost
  regularised,      ///< singular values were dropped at some line: see `dropped` and `compatibility_residual`
};

/// Options of couple().
struct CouplingOptions {
  double length = default_length;                        ///< m/rad, > 0: scale of rotations in the kernel
  Regularisation regularisation = Regularisation::none;  ///< treatment of the kernel's small singular values
  double threshold = 1e-10;                              ///< relative bound of singular values, in (0, 1)
  double component_error = 0.0;       ///< relative error of all components' receptances, ≥ 0; 0 for no error bound
  std::vector<std::string> points{};  ///< points whose rows and columns are wanted; empty for all
};

/// The coupled response with the quality of its solution; vectors have one value for each frequency line.
struct [[nodiscard]] CoupledResponse {
  dynamics::ResponseModel response;  ///< rows: responses of the components in their order; columns: forces likewise
  Eigen::VectorXd kernel_condition;
  KernelStatus status = KernelStatus::well_conditioned;
  Eigen::VectorXi dropped;                 ///< singular values left out (by Tikhonov's rule: more than halved)
  Eigen::VectorXd compatibility_residual;  ///< largest relative gap left at rigid joints; 0 without regularisation
  std::vector<Eigen::MatrixXd> error;      ///< bound of each entry's error; empty without component_error
};

/// The response of any number of components joined at the contacts. With Y = blkdiag(H_1, H_2, …) and one column of B
/// for each joined direction, +n at point a and −n at point b (rotations times L),
///
///     G = Y − Y B S⁻¹ Bᵀ Y,     S = Bᵀ Y B + Z⁻¹,     Z = K (1 + iη) + iωC,  Z⁻¹ = 0 for a rigid direction
///
/// (the dual, Lagrange-multiplier form of de Klerk, Rixen & Voormeeren 2008, with joints; docs/theory/coupling.md, Eq.
/// 4-8), or any symmetric Z over a contact's directions. For two components P and R its part-part block is G_ab = H_ab
/// − H_aP B [Bᵀ (H_PP + H_RR) B + Z⁻¹]⁻¹ Bᵀ H_Pb for any a and b of the part (Barrios 2019, Eq. 6 and 12-14,
/// generalised). No component's receptance is inverted, so that each may have any rank. All inputs are in m/N (rad/N,
/// …) on equal axes; a component may have other points as responses than as forces, but must have its contact points as
/// both.
///
/// The condition reported is Skeel's (coupling/kernel.hpp) over the components' terms |B_cᵀ H_c B_c| and |Z⁻¹|. If the
/// error of every H_c,ij is at most ε |H_c,ij|, then to first order
///
///     |δG| ≤ ε |I − Y B S⁻¹ Bᵀ| |Y| |I − B S⁻¹ Bᵀ Y|      entry by entry, |·| too
///
/// which is `error` for ε = component_error (it covers what a regularisation keeps, not what it drops).
///
/// Throws InputError for unequal axes (with their overlap), points of one name in two components, unknown points, a
/// value that is not finite, a faulty contact or option; NumericalError, with the frequency, if the kernel is singular
/// (condition above 1e14). Cost lines · (n² m + m³) for n wanted DOFs and m directions.
CoupledResponse couple(const std::vector<dynamics::ResponseModel>& components, const std::vector<Contact>& contacts,
                       const CouplingOptions& options = {});

/// The response of a part and a robot joined at the contacts.
CoupledResponse couple(const dynamics::ResponseModel& part, const dynamics::ResponseModel& robot,
                       const std::vector<Contact>& contacts, const CouplingOptions& options = {});

/// The bound `error` of the entry (response, force), both given by DOF name, relative to its modulus, one value for
/// each line. Throws InputError if either name is absent or no component_error was given.
[[nodiscard]] Eigen::VectorXd relative_error(const CoupledResponse& coupled, const std::string& response,
                                             const std::string& force);

/// Throws InputError that lists every violation: a length that is not positive, a threshold outside (0, 1), a negative
/// component_error.
void require_valid(const CouplingOptions& options);

}  // namespace thinwall::coupling
