#pragma once
// The derivative of a coupled response by the responses of its components.

#include <vector>

#include "coupling/receptance.hpp"

namespace thinwall::coupling {

/// The factors of dG = P dY Q, one pair for each frequency line, with Y = blkdiag(H_1, H_2, …) over all DOFs of the
/// components in their order and G over the wanted ones.
struct CouplingSensitivity {
  dynamics::DofTable responses, forces;  ///< DOFs of G, those of couple() with the same options
  std::vector<Eigen::MatrixXcd> P;       ///< responses of G × all responses of the components
  std::vector<Eigen::MatrixXcd> Q;       ///< all forces of the components × forces of G
};

/// The sensitivity of G = Y − Y B S⁻¹ BᵀY, S = BᵀY B + Z⁻¹ (coupling/receptance.hpp; docs/theory/coupling.md, Eq. 21).
/// With d(S⁻¹) = −S⁻¹ BᵀdY B S⁻¹,
///
///     dG = dY − dY B S⁻¹BᵀY − Y B S⁻¹Bᵀ dY + Y B S⁻¹Bᵀ dY B S⁻¹BᵀY = (I − Y B S⁻¹Bᵀ) dY (I − B S⁻¹BᵀY) = P dY Q
///
/// (the dual form of de Klerk, Rixen & Voormeeren 2008, differentiated). With rigid joints P and Q are projectors: P
/// removes the openings of the joints, and PY = YQ = G. Throws InputError for options with a regularisation, and as
/// couple() does. Cost lines · (n² m + m³) with n the number of all DOFs, not only the wanted ones.
[[nodiscard]] CouplingSensitivity coupling_sensitivity(const std::vector<dynamics::ResponseModel>& components,
                                                       const std::vector<Contact>& contacts,
                                                       const CouplingOptions& options = {});

}  // namespace thinwall::coupling
