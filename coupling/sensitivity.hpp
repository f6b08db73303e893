#pragma once
// How a coupled response follows the responses of its components.

#include <vector>

#include "coupling/receptance.hpp"

namespace thinwall::coupling {

/// dG = P dY Q to first order, one pair a line: Y = blkdiag(H_1, H_2, …) over all DOFs of the components in their
/// order, G over those that are wanted.
struct CouplingSensitivity {
  dynamics::DofTable responses, forces;  ///< of G: those of couple() with the same options
  std::vector<Eigen::MatrixXcd> P;       ///< responses of G × all responses of the components
  std::vector<Eigen::MatrixXcd> Q;       ///< all forces of the components × forces of G
};

/// Of G = Y − Y B S⁻¹ BᵀY, S = BᵀY B + Z⁻¹ (coupling/receptance.hpp). With d(S⁻¹) = −S⁻¹ BᵀdY B S⁻¹
///
///     dG = dY − dY B S⁻¹BᵀY − Y B S⁻¹Bᵀ dY + Y B S⁻¹Bᵀ dY B S⁻¹BᵀY = (I − Y B S⁻¹Bᵀ) dY (I − B S⁻¹BᵀY) = P dY Q
///
/// (the dual form of de Klerk, Rixen & Voormeeren 2008, differentiated). With rigid joints P and Q are projectors: P
/// takes out what the joints would feel, PY = YQ = G. A regularised kernel is refused (InputError); other errors as
/// couple(). Cost lines · (n² m + m³), n: all DOFs, not the wanted ones only.
[[nodiscard]] CouplingSensitivity coupling_sensitivity(const std::vector<dynamics::ResponseModel>& components,
                                                       const std::vector<Contact>& contacts,
                                                       const CouplingOptions& options = {});

}  // namespace thinwall::coupling
