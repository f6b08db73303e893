#pragma once
// The receptance route (RCSA): the coupled response from the responses of the components alone.

#include <vector>

#include "coupling/contact.hpp"
#include "dynamics/response_model.hpp"

namespace thinwall::coupling {

enum class KernelStatus {
  well_conditioned,
  ill_conditioned,  ///< more than half of the digits are lost at some line (condition above 1e8)
};

/// The coupled response and how well its kernel could be solved.
struct [[nodiscard]] CoupledResponse {
  dynamics::ResponseModel response;  ///< rows: the part's responses, then the robot's; columns: their forces alike
  Eigen::VectorXd kernel_condition;  ///< one a line
  KernelStatus status = KernelStatus::well_conditioned;
};

/// Joins part and robot at the contacts. With Y = blkdiag(H_P, H_R) and B one column a spring, +n at the part's point
/// and −n at the robot's,
///
///     G = Y − Y B [Bᵀ Y B + Z⁻¹]⁻¹ Bᵀ Y,     Z = K (1 + iη) + iωC,  Z⁻¹ = 0 for a rigid spring
///
/// whose part-part block is G_ab = H_ab − H_aP B [Bᵀ (H_PP + H_RR) B + Z⁻¹]⁻¹ Bᵀ H_Pb for any a and b of the part
/// (Barrios 2019, Eq. 6 and 12-14, generalised; the dual form of de Klerk et al. 2008). No component's receptance is
/// inverted, so a robot may be of any rank. Both inputs in m/N on equal axes; the components' points must bear
/// different names.
///
/// The condition reported is Skeel's, ‖ |S⁻¹| (|BᵀH_P B| + |BᵀH_R B| + |Z⁻¹|) ‖_∞ for the kernel S (Higham 2002,
/// section 7.2): the factor by which a relative error of the receptances may grow, cancellation in S included; it does
/// not depend on the scale of the directions.
///
/// Errors: InputError for unequal axes, unknown points, a faulty contact; NumericalError with the frequency where the
/// kernel is singular (condition above 1e14). Cost lines · (n² m + m³) for n DOFs and m springs.
CoupledResponse couple(const dynamics::ResponseModel& part, const dynamics::ResponseModel& robot,
                       const std::vector<Contact>& contacts);

}  // namespace thinwall::coupling
