#pragma once
// Taking a known component out of an assembly: what is left is the component that was not known.

#include <string>
#include <vector>

#include "coupling/receptance.hpp"

namespace thinwall::coupling {

/// The response of what remains of `assembly` without `known`, by dual decoupling (D'Ambrogio & Fregolent 2010;
/// Voormeeren & Rixen 2012; docs/theory/coupling.md, Eq. 13-14): the known component is coupled once more, with the
/// negative of its receptance, which takes its forces out. With Y = blkdiag(G, −H) and B over `interface`
///
///     H_rest = Y − Y B (BᵀY B)⁺ Bᵀ Y,     BᵀY B = G_ii − H_ii
///
/// `interface`: points that both tables have, each with all of the known component's DOFs there (of the assembly those
/// that it has beyond are not used). *Standard*: the points where the known component touches the rest. *Extended*:
/// further points of the known component; BᵀYB then has the rank of the true interface at most, for exact data, and
/// must be truncated, which is why that is the default here. Rows and columns: the assembly's, then those points of
/// `known` that the assembly has not. So an interface that was not measured comes out where the known component's model
/// has it: inverse RCSA (Park, Altintas & Movahhedy 2003; Lei 2022, Eq. 4) is the measured tip of an assembled tool,
/// less the tool's model, at the tool's root:
///
///     H_rest,22 = H_21 (H_11 − G_11)⁻¹ H_12 − H_22     1: tip, 2: root
///
/// which is the base with the joint's compliance, H_B + Z⁻¹. Rows and columns of the known component's points that do
/// not touch the rest mean nothing: nothing is left there.
///
/// What cannot be known is dropped, and said: where the known component does not move, the rest's motion left no trace
/// in the assembly; the result is then the rest held there, `dropped` counts the directions and the status is
/// `regularised`. G_ii − H_ii is small where the known component is heavy beside the rest: read the condition, and give
/// component_error, before believing a result.
///
/// Errors as couple(); InputError if a point of the interface is missing in either, or a DOF of the known component
/// there in the assembly.
CoupledResponse decouple(const dynamics::ResponseModel& assembly, const dynamics::ResponseModel& known,
                         const std::vector<std::string>& interface,
                         const CouplingOptions& options = {.regularisation = Regularisation::truncated});

/// Takes a point mass (kg) off a point, as an accelerometer's off a measurement: decoupling of a body with receptance
/// −1/(ω²m) along every translation of `point` in the tables, orthogonal ones. For one direction
///
///     H_pq = G_pq / (1 + ω² m G_pp),     A_pp = A_m / (1 − m A_m)  as accelerances A = −ω² H
///
/// (Ewins 2000, chapter 3, mass cancellation; docs/theory/coupling.md, Eq. 15). A negative mass is put on. G_pp must be
/// there: the point excited as well as measured. Nothing changes at 0 Hz. Throws InputError for a mass that is zero or
/// not finite, a point without a translation as response or as force, or directions that are not orthogonal. Cost as
/// couple().
CoupledResponse remove_point_mass(const dynamics::ResponseModel& assembly, const std::string& point, double mass_kg);

}  // namespace thinwall::coupling
