#pragma once
// Exchange of the tool in a measured machine: the holder's receptance from one tool, then the tip receptance of
// another.

#include <string>
#include <vector>

#include "coupling/receptance.hpp"

namespace thinwall::coupling {

/// A tool outside of the machine, and the joint that holds its root.
struct HeldTool {
  /// Receptance of the tool that nothing holds, from a beam, a solid or a measurement: of its root and of the points
  /// that were measured or are wanted, overhang only.
  dynamics::ResponseModel free;
  /// The joint, with the root as point_a. Its directions are those in which spindle and tool act on each other, usually
  /// x, y, rx, ry; it is rigid if its compliance is counted to the machine.
  Contact joint;
};

/// The receptance of a machine without its tool.
struct [[nodiscard]] HolderReceptance {
  dynamics::ResponseModel receptance;  ///< T^B at `joint.point_b`, over the joint's directions; NaN if `rank_deficient`
  Eigen::VectorXd condition;  ///< Skeel condition of T^A_11 − T^C_11 at each line (coupling/kernel.hpp); infinite if
                              ///< it cannot be solved
  std::vector<Eigen::MatrixXcd> left, right;  ///< dT^B = left dT^C_11 right, first order, one pair for each line
  int rank_deficient_lines = 0;               ///< condition above 1e14

  /// True if the receptance of the machine cannot be determined at some line.
  [[nodiscard]] bool rank_deficient() const { return rank_deficient_lines > 0; }
};

/// The receptance of a machine without the tool with which it was measured (inverse RCSA; Lei 2022, Eq. 4, the part of
/// the reference tool):
///
///     T^B = T^A_21 (T^A_11 − T^C_11)⁻¹ T^A_12 − T^A_22 − Z⁻¹
///
/// Here 1 are the DOFs measured on the tool in the machine (C), 2 those of the root, A is the tool alone, and Z the
/// joint; Z⁻¹ = 0 if it is rigid, which may be assumed if only the difference between two tools matters. 1 need not be
/// the tip with its rotations, but any DOFs of the tool, as many as the joint has directions: the 16 displacement FRFs
/// of two points can be used as they are, without differences (docs/theory/tool-swap.md). The inverse is solved with
/// rotations times `length`.
///
/// At low frequencies digits are lost twice: in T^A_11 − T^C_11 the tool's rigid motion in T^A_11 outweighs T^C_11, and
/// T^B is the difference of two large terms.
///
/// `measured`: rows and columns are the same DOFs, each of them one of `tool.free`. Throws InputError that lists every
/// violation: unequal axes, DOFs that the tool has not or that are not as many as the joint's directions, a root that
/// was itself measured (no overhang), values that are not finite, a response equal to the free tool's at every line;
/// and as require_valid() of contacts does. Cost lines · m³.
HolderReceptance holder_receptance(const dynamics::ResponseModel& measured, const HeldTool& tool,
                                   double length = default_length);

/// Outcome of a swap.
enum class SwapStatus {
  done,
  ill_conditioned,  ///< condition above 1e8 at some line: more than half of the digits are lost
  rank_deficient,   ///< the holder is unknown at some line; nothing was coupled
};

/// The response of the second tool in the machine, and the receptance of the machine by which it was found.
struct [[nodiscard]] SwappedTool {
  SwapStatus status = SwapStatus::done;
  HolderReceptance holder;
  CoupledResponse coupled;                    ///< all DOFs of the second tool in the machine; empty if rank_deficient
  std::vector<Eigen::MatrixXcd> left, right;  ///< dT^C_2 = left dT^C_1 right, first order, one pair for each line
};

/// The response of tool 2 in the machine that was measured with tool 1 (Lei 2022, Eq. 4; Schmitz & Donaldson 2000):
///
///     T^C_2,11 = T^A_2,11 − T^A_2,12 [ T^A_2,22 + T^B + Z_2⁻¹ ]⁻¹ T^A_2,21
///
/// With T^B from tool 1, the bracket contains Z_2⁻¹ − Z_1⁻¹, Lei's ΔK⁻¹; both joints may be taken as rigid if the tools
/// are held alike. The coupling is couple()'s, which reports the condition of its kernel. With tool 2 = tool 1 the
/// result is the measured response. Both joints must have the same directions and point_b. Throws as
/// holder_receptance() and couple() do, and InputError for joints that differ in their directions or a second tool
/// without overhang. Cost lines · (n² m + m³).
SwappedTool tool_swap(const dynamics::ResponseModel& measured, const HeldTool& tool_1, const HeldTool& tool_2,
                      double length = default_length);

/// A bound on the error of a swapped response, one matrix for each line, from two swaps: one with T^C_1 as measured,
/// and one with the best estimate of it (by `corrected` rotations, or by displacements alone), whose entries have
/// errors up to e = `left_over`:
///
///     |T^C_2 − T^C_2,best| + |left| e |right|      moduli, entry by entry; left and right of the best
///
/// The first term is not linearised, because a few percent of P change the result completely where T^A_11 − T^C_11 is
/// nearly singular. The second is of first order. Throws InputError unless both swaps are complete and of the same
/// DOFs, and e has the shape of the measured response.
[[nodiscard]] std::vector<Eigen::MatrixXd> swap_error_bound(const SwappedTool& swapped, const SwappedTool& best,
                                                            const std::vector<Eigen::MatrixXd>& left_over);

/// A joint in the four directions of Lei 2022, Eq. 3, for a tool along z: x, y and the rotations about both, with one
/// set of springs. It is rigid unless stiffnesses are given.
struct RadialJoint {
  double stiffness = std::numeric_limits<double>::infinity();             ///< along x and y, N/m
  double damping = 0.0;                                                   ///< N s/m
  double rotational_stiffness = std::numeric_limits<double>::infinity();  ///< about x and y, N m/rad
  double rotational_damping = 0.0;                                        ///< N m s/rad
};
/// The joint as a contact between a point of the tool and one of the holder.
[[nodiscard]] Contact radial_contact(const std::string& root, const std::string& holder, const RadialJoint& joint = {});

}  // namespace thinwall::coupling
