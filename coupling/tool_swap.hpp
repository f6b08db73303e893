#pragma once
// Another tool in a measured machine: the holder's receptance from one tool, then the tip of another.

#include <string>
#include <vector>

#include "coupling/receptance.hpp"

namespace thinwall::coupling {

/// A tool as it is outside of the machine, and how its root is held.
struct HeldTool {
  dynamics::ResponseModel free;  ///< receptance of the tool that nothing holds: beam, solid, measured; of its root and
                                 ///< of the points that were measured or are wanted, overhang only
  Contact joint;                 ///< point_a: the root. Its directions are those in which spindle and tool act on each
                                 ///< other, usually x, y, rx, ry; rigid where the joint is part of the base
};

/// What is left of a machine when its tool is taken out.
struct [[nodiscard]] HolderReceptance {
  dynamics::ResponseModel
      receptance;             ///< T^B at `joint.point_b`, over the joint's directions; NaN where `rank_deficient`
  Eigen::VectorXd condition;  ///< of T^A_11 − T^C_11, one a line (Skeel's, coupling/kernel.hpp); infinite where
                              ///< it cannot be solved
  std::vector<Eigen::MatrixXcd> left, right;  ///< dT^B = left dT^C_11 right, first order, one pair a line
  int rank_deficient_lines = 0;               ///< condition above 1e14

  /// Whether the machine is unknown at some line.
  [[nodiscard]] bool rank_deficient() const { return rank_deficient_lines > 0; }
};

/// The machine without the tool it was measured with (inverse RCSA; Lei 2022, Eq. 4, the part of the reference tool):
///
///     T^B = T^A_21 (T^A_11 − T^C_11)⁻¹ T^A_12 − T^A_22 − Z⁻¹
///
/// 1: the DOFs that were measured on the tool in the machine (C), 2: the root's, A: the tool alone; Z the joint, Z⁻¹ =
/// 0 if rigid, as K is where only its difference between two tools matters. 1 need not be the tip with its rotations:
/// any DOFs of the tool, as many as the joint has directions, so that the 16 displacement FRFs of two points serve as
/// they are, without differences (docs/theory/tool-swap.md). The inverse is solved with rotations times `length`.
///
/// Low frequencies cost digits twice: T^A_11 − T^C_11 hides T^C_11 behind the tool's rigid motion, and T^B remains from
/// the difference of two large terms.
///
/// `measured`: rows and columns the same DOFs, each of them one of `tool.free`. Throws InputError with every violation
/// at once: axes that are unequal, DOFs that are not the tool's or not as many as the joint's directions, a root that
/// was itself measured (no overhang), values that are not finite, a response that is the free tool's own at every line;
/// as require_valid() of contacts. Cost lines · m³.
HolderReceptance holder_receptance(const dynamics::ResponseModel& measured, const HeldTool& tool,
                                   double length = default_length);

/// What came of a swap.
enum class SwapStatus {
  done,
  ill_conditioned,  ///< a kernel lost more than half of its digits (condition above 1e8) at some line
  rank_deficient,   ///< the holder is not known at some line: nothing was coupled
};

/// The tip with the wanted tool, and the machine that it was found with.
struct [[nodiscard]] SwappedTool {
  SwapStatus status = SwapStatus::done;
  HolderReceptance holder;
  CoupledResponse coupled;  ///< of the second tool in the machine, all its DOFs; empty if rank_deficient
  std::vector<Eigen::MatrixXcd> left, right;  ///< dT^C_2 = left dT^C_1 right, first order, one pair a line
};

/// Tool 2 in the machine that was measured with tool 1 (Lei 2022, Eq. 4; Schmitz & Donaldson 2000):
///
///     T^C_2,11 = T^A_2,11 − T^A_2,12 [ T^A_2,22 + T^B + Z_2⁻¹ ]⁻¹ T^A_2,21
///
/// which with T^B of tool 1 holds Z_2⁻¹ − Z_1⁻¹, Lei's ΔK⁻¹: both rigid where tools are held alike. Coupled by
/// couple(), which reports its kernel's condition. With tool 2 = tool 1 it returns what was measured. Both joints have
/// the same directions and point_b. Errors as holder_receptance() and couple(), and InputError for joints that differ
/// in their directions or a second tool without overhang. Cost lines · (n² m + m³).
SwappedTool tool_swap(const dynamics::ResponseModel& measured, const HeldTool& tool_1, const HeldTool& tool_2,
                      double length = default_length);

/// What a swapped response is off by, one matrix a line, from two swaps: by T^C_1 as it is, and by the best that is
/// known of it (by `corrected` rotations, or by displacements alone), whose entries are off by up to `left_over` e:
///
///     |T^C_2 − T^C_2,best| + |left| e |right|      moduli, entry by entry; left and right of the best
///
/// The first term is no expansion: where T^A_11 − T^C_11 is nearly singular a few percent of P turn the tip over. The
/// second is first order. Throws InputError unless both swaps are complete, of the same DOFs, and e fits.
[[nodiscard]] std::vector<Eigen::MatrixXd> swap_error_bound(const SwappedTool& swapped, const SwappedTool& best,
                                                            const std::vector<Eigen::MatrixXd>& left_over);

/// The four directions of Lei 2022, Eq. 3, for a tool along z: x, y and turns about both, of one set of springs. Rigid
/// unless given; C in N s/m and N m s/rad.
struct RadialJoint {
  double stiffness = std::numeric_limits<double>::infinity();             ///< along x and y, N/m
  double damping = 0.0;                                                   ///< N s/m
  double rotational_stiffness = std::numeric_limits<double>::infinity();  ///< about x and y, N m/rad
  double rotational_damping = 0.0;                                        ///< N m s/rad
};
/// The joint as a contact between a point of the tool and one of the holder.
[[nodiscard]] Contact radial_contact(const std::string& root, const std::string& holder, const RadialJoint& joint = {});

}  // namespace thinwall::coupling
