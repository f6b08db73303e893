#pragma once
// The spatial route: the coupled matrices assembled from the components' matrices, then their own modes and responses.

#include <vector>

#include "coupling/joints.hpp"
#include "dynamics/conversion.hpp"

namespace thinwall::coupling {

/// Any number of components as one structure, over independent coordinates y with x = T y, x the DOFs of the components
/// in their order. Assembles (Barrios 2019, Eq. 16-18, any direction; the primal assembly of de Klerk et al. 2008;
/// docs/theory/coupling.md, Eq. 9-10)
///
///     M = blkdiag(M_1, M_2, …),   K = blkdiag(K_1, K_2, …) + B K_z Bᵀ,   C and D likewise
///
/// over the joined directions, a column of B +n at point a and −n at point b (rotations times `length`), K_z the
/// joints' stiffness, diagonal for springs. A direction that outweighs the components (k_P + k in one entry keeps k_P
/// to ε k only) is not added to their entries: its opening d = bᵀy becomes a coordinate in the place of another (one of
/// the last component's where there is a choice), and k stands alone on the diagonal of d. With u the coordinates that
/// stay and s those replaced, y_s = B_s⁻ᵀ (d − B_uᵀ u), which with the components' own T gives the whole's, and
/// M ← TᵀMT and so on. A rigid direction is the same without its opening, d = 0: an elimination, not a penalty.
///
/// Errors: InputError for a faulty contact, an unknown point, points of one name in two components, or rigid
/// directions that depend on each other. Cost O(n³).
[[nodiscard]] dynamics::SpatialModel couple(const std::vector<dynamics::SpatialModel>& components,
                                            const std::vector<Contact>& contacts, double length = default_length);

/// The same for two.
[[nodiscard]] dynamics::SpatialModel couple(const dynamics::SpatialModel& part, const dynamics::SpatialModel& robot,
                                            const std::vector<Contact>& contacts, double length = default_length);

/// The spatial part (points a of the contacts) against a robot that is known by its receptance only. The joint forces f
/// stay as unknowns,
///
///     [ P(ω)  B_P ; B_Pᵀ  −W(ω) ] [ x ; f ] = [ F ; 0 ],     W = Z⁻¹ + B_Rᵀ H_R B_R,
///
/// which is P + B_P W⁻¹ B_Pᵀ, the joint and the robot as a dynamic stiffness, where W can be inverted, and holds as
/// well where it cannot (a robot of rank one in three rigid directions). Between the part's physical DOFs. Errors as
/// above, and InputError if the axes differ.
[[nodiscard]] dynamics::ResponseModel direct_response(const dynamics::SpatialModel& part,
                                                      const dynamics::ResponseModel& robot,
                                                      const std::vector<Contact>& contacts,
                                                      const dynamics::FrequencyAxis& axis);

}  // namespace thinwall::coupling
