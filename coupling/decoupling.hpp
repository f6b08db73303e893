#pragma once
// Decoupling: removal of a known component from an assembly, which leaves the unknown component.

#include <string>
#include <vector>

#include "coupling/receptance.hpp"

namespace thinwall::coupling {

/// The response of what remains of `assembly` without `known`, by dual decoupling (D'Ambrogio & Fregolent 2010;
/// Voormeeren & Rixen 2012; docs/theory/coupling.md, Eq. 13-14): the known component is coupled once more, with the
/// negative of its receptance, which removes its forces. With Y = blkdiag(G, −H) and B over `interface`
///
///     H_rest = Y − Y B (BᵀY B)⁺ Bᵀ Y,     BᵀY B = G_ii − H_ii
///
/// `interface`: points that both tables have, each with all of the known component's DOFs there; further DOFs of the
/// assembly are not used. In *standard* decoupling these are the points where the known component touches the rest. In
/// *extended* decoupling there are further points of the known component: for exact data BᵀYB then has at most the rank
/// of the true interface and must be truncated, which is why truncation is the default here. The rows and columns of
/// the result are those of the assembly, then those points of `known` that the assembly has not. An interface that was
/// not measured is thus found from the known component's model of it: inverse RCSA (Park, Altintas & Movahhedy 2003;
/// Lei 2022, Eq. 4) takes the measured tip of an assembled tool and removes the tool's model, which gives the
/// receptance at the tool's root,
///
///     H_rest,22 = H_21 (H_11 − G_11)⁻¹ H_12 − H_22     1: tip, 2: root
///
/// which is that of the base with the joint's compliance, H_B + Z⁻¹. Rows and columns of points of the known component
/// that do not touch the rest are meaningless, because nothing remains there.
///
/// Directions that the data do not determine are dropped and reported: if the known component cannot move somewhere,
/// the rest's motion has left no trace in the assembly there. The result is then the rest held at that place, `dropped`
/// counts the directions, and the status is `regularised`. G_ii − H_ii is small if the known component is heavy beside
/// the rest: judge a result by its condition and by the bound from component_error.
///
/// Throws as couple() does, and InputError if a point of the interface is missing in either table, or if the assembly
/// lacks a DOF that the known component has there.
CoupledResponse decouple(const dynamics::ResponseModel& assembly, const dynamics::ResponseModel& known,
                         const std::vector<std::string>& interface,
                         const CouplingOptions& options = {.regularisation = Regularisation::truncated});

/// Removes a point mass (kg) from a point, such as that of an accelerometer from a measurement, by decoupling a body
/// with receptance −1/(ω²m) along every translation of `point` in the tables, which must be orthogonal. For one
/// direction
///
///     H_pq = G_pq / (1 + ω² m G_pp),     A_pp = A_m / (1 − m A_m)  as accelerances A = −ω² H
///
/// (Ewins 2000, chapter 3, mass cancellation; docs/theory/coupling.md, Eq. 15). A negative mass is added. G_pp must be
/// given: the point must be excited as well as measured. Nothing changes at 0 Hz. Throws InputError for a mass that is
/// zero or not finite, a point without a translation as response or as force, or directions that are not orthogonal.
/// Cost: that of couple().
CoupledResponse remove_point_mass(const dynamics::ResponseModel& assembly, const std::string& point, double mass_kg);

}  // namespace thinwall::coupling
