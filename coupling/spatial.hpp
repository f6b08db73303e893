#pragma once
// The spatial route: the coupled matrices are assembled from those of the components, and modes and responses follow
// from them.

#include <vector>

#include "coupling/joints.hpp"
#include "dynamics/conversion.hpp"

namespace thinwall::coupling {

/// The spatial model of any number of components joined at the contacts, over independent coordinates y with x = T y,
/// where x are the DOFs of the components in their order. The matrices are (Barrios 2019, Eq. 16-18, any direction; the
/// primal assembly of de Klerk et al. 2008; docs/theory/coupling.md, Eq. 9-10)
///
///     M = blkdiag(M_1, M_2, …),   K = blkdiag(K_1, K_2, …) + B K_z Bᵀ,   C and D likewise
///
/// over the joined directions; a column of B has +n at point a and −n at point b (rotations times `length`), and K_z is
/// the joints' stiffness, diagonal for springs. A stiffness that outweighs the components is not added to their
/// entries, because k_P + k in one entry keeps k_P to ε k only: the opening d = bᵀy becomes a coordinate in place of
/// another (one of the last component if there is a choice), and k stands alone on the diagonal of d. With u the
/// coordinates that remain and s those replaced, y_s = B_s⁻ᵀ (d − B_uᵀ u), which with the components' own T gives that
/// of the whole, and M ← TᵀMT etc. A rigid direction is treated likewise with d = 0: it is eliminated, not approximated
/// by a penalty.
///
/// Throws InputError for a faulty contact, an unknown point, points of one name in two components, or rigid directions
/// that depend on each other. Cost O(n³).
[[nodiscard]] dynamics::SpatialModel couple(const std::vector<dynamics::SpatialModel>& components,
                                            const std::vector<Contact>& contacts, double length = default_length);

/// The spatial model of a part and a robot joined at the contacts.
[[nodiscard]] dynamics::SpatialModel couple(const dynamics::SpatialModel& part, const dynamics::SpatialModel& robot,
                                            const std::vector<Contact>& contacts, double length = default_length);

/// The response of a part with a spatial model (points a of the contacts) joined to a robot that is known by its
/// receptance only. The joint forces f are kept as unknowns,
///
///     [ P(ω)  B_P ; B_Pᵀ  −W(ω) ] [ x ; f ] = [ F ; 0 ],     W = Z⁻¹ + B_Rᵀ H_R B_R,
///
/// where P(ω) is the part's dynamic stiffness. Eliminating f would give P + B_P W⁻¹ B_Pᵀ, with joint and robot as a
/// dynamic stiffness; the bordered form also holds if W cannot be inverted (a robot of rank one in three rigid
/// directions). The response is between the part's physical DOFs. Throws as couple() does, and InputError if the axes
/// differ.
[[nodiscard]] dynamics::ResponseModel direct_response(const dynamics::SpatialModel& part,
                                                      const dynamics::ResponseModel& robot,
                                                      const std::vector<Contact>& contacts,
                                                      const dynamics::FrequencyAxis& axis);

}  // namespace thinwall::coupling
