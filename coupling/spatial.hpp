#pragma once
// The spatial route: the coupled matrices assembled from the components' matrices, then their own modes and responses.

#include <vector>

#include "coupling/contact.hpp"
#include "dynamics/conversion.hpp"

namespace thinwall::coupling {

/// Part and robot as one structure, over independent coordinates y with x = T y, x the part's DOFs, then the robot's.
/// Assembles (Barrios 2019, Eq. 16-18, any direction)
///
///     M = blkdiag(M_P, M_R),   K = blkdiag(K_P, K_R) + Σ k b bᵀ,   C likewise with c,   D likewise with η k
///
/// over the springs, b = +n at the part's point and −n at the robot's. A spring that outweighs the components (k_P + k
/// in one entry keeps k_P to ε k only) is not added to their entries: its opening d = bᵀy becomes a coordinate in the
/// place of another (one of the robot's where there is a choice), and k stands alone on the diagonal of d. With u the
/// coordinates that stay and s those replaced, y_s = B_s⁻ᵀ (d − B_uᵀ u), which with the components' own T gives the
/// whole's, and M ← TᵀMT and so on. A rigid spring is the same without its opening, d = 0: an elimination, not a
/// penalty.
///
/// Errors: InputError for a faulty contact, an unknown point, points of one name in both components, or rigid
/// directions that depend on each other. Cost O(n³).
[[nodiscard]] dynamics::SpatialModel couple(const dynamics::SpatialModel& part, const dynamics::SpatialModel& robot,
                                            const std::vector<Contact>& contacts);

/// The spatial part against a robot that is known by its receptance only. The joint forces f stay as unknowns,
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
