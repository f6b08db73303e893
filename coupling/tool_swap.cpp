#include "coupling/tool_swap.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/error.hpp"
#include "core/faults.hpp"
#include "core/parallel.hpp"
#include "coupling/kernel.hpp"
#include "coupling/sensitivity.hpp"

namespace thinwall::coupling {

namespace {

using dynamics::Dof;
using dynamics::DofKind;
using dynamics::DofTable;
using dynamics::ResponseModel;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

std::vector<std::string> names(const DofTable& dofs) {
  std::vector<std::string> all;
  for (const Dof& dof : dofs) all.push_back(dynamics::name(dof));
  return all;
}

/// The rows and columns of the measured DOFs in the tool's tables, with their scales.
struct MeasuredDofs {
  std::vector<int> rows, columns;
  Eigen::VectorXd scale;  ///< 1 for a translation, `length` for a rotation
};

/// The places of the measured DOFs in the tool's tables; what is wrong with them is noted.
MeasuredDofs measured_dofs(const ResponseModel& measured, const HeldTool& tool, double length, core::Faults& faults) {
  MeasuredDofs found;
  found.scale.resize(static_cast<Index>(measured.responses.size()));
  const std::vector<std::string> responses = names(tool.free.responses), forces = names(tool.free.forces);
  const auto find = [&](const std::vector<std::string>& all, const std::string& name, std::vector<int>& rows) {
    const auto at = std::find(all.begin(), all.end(), name);
    faults.require(at != all.end(), "the measured " + name, "is none of the tool's degrees of freedom");
    rows.push_back(static_cast<int>(at - all.begin()));
  };
  for (std::size_t i = 0; i < measured.responses.size(); ++i) {
    const Dof& dof = measured.responses[i];
    find(responses, dynamics::name(dof), found.rows);
    find(forces, dynamics::name(dof), found.columns);
    faults.require(dof.point != tool.joint.point_a, "the root " + dof.point,
                   "was measured itself: a tool without overhang; couple it instead");
    found.scale(static_cast<Index>(i)) = dof.kind == DofKind::rotation ? length : 1.0;
  }
  faults.require(names(measured.responses) == names(measured.forces), "the measured responses and forces",
                 "are not the same degrees of freedom in one order");
  const std::size_t directions = tool.joint.springs.size();
  faults.require(measured.responses.size() == directions, "the joint",
                 "has " + std::to_string(directions) + " directions, but " + std::to_string(measured.responses.size()) +
                     " degrees of freedom were measured; they must be as many");
  return found;
}

/// The motions of the root along the joint's directions, one column for each, rotations scaled.
MatrixXd root_columns(const DofTable& dofs, const Joints& joints) {
  MatrixXd B(static_cast<Index>(dofs.size()), joints.size());
  for (Index j = 0; j < joints.size(); ++j) {
    const JoinedDirection& along = joints.directions[static_cast<std::size_t>(j)];
    B.col(j) = along.scale * dynamics::displacement_row(dofs, along.point_a, along.direction, along.kind);
  }
  return B;
}

/// The scales of the joined directions.
Eigen::VectorXd scales(const Joints& joints) {
  Eigen::VectorXd scale(joints.size());
  for (Index j = 0; j < scale.size(); ++j) scale(j) = joints.directions[static_cast<std::size_t>(j)].scale;
  return scale;
}

/// The DOFs of the machine at the joint, along its directions.
DofTable holder_dofs(const Contact& joint) {
  DofTable dofs;
  for (const ContactSpring& spring : joint.springs) dofs.push_back({joint.point_b, spring.direction, spring.kind});
  return dofs;
}

/// Throws InputError if the measured response equals that of the free tool at every line.
void require_held(const ResponseModel& measured, const ResponseModel& free, const MeasuredDofs& of) {
  for (std::size_t line = 0; line < measured.H.size(); ++line) {
    const MatrixXcd T_A = free.H[line](of.rows, of.columns);
    if ((T_A - measured.H[line]).norm() > 1e-13 * T_A.norm()) return;
  }
  throw core::InputError(
      "tool swap: the measured response is that of the free tool at every line, T_A - T_C = 0; measure it in the "
      "machine");
}

/// The data of tool and joint that every line needs.
struct Inverse {
  MeasuredDofs at_1;
  Joints joint;
  MatrixXd B_response, B_force;  ///< root_columns()
};

/// Computes T^B of one line and its derivative factors `left` and `right`; returns the condition of what was solved.
double invert_line(const Inverse& of, const MatrixXcd& T_A, const MatrixXcd& T_C, double omega, MatrixXcd& T_B,
                   MatrixXcd& left, MatrixXcd& right) {
  const auto to_length = of.at_1.scale.asDiagonal();
  const Eigen::VectorXd unscale = scales(of.joint).cwiseInverse();
  const auto from_length = unscale.asDiagonal();
  const MatrixXcd T_A11 = to_length * T_A(of.at_1.rows, of.at_1.columns) * to_length;
  const MatrixXcd T_C11 = to_length * T_C * to_length;
  const MatrixXcd T_12 = to_length * (T_A(of.at_1.rows, Eigen::all) * of.B_force);
  const MatrixXcd T_21 = (of.B_response.transpose() * T_A(Eigen::all, of.at_1.columns)) * to_length;
  Kernel kernel(Regularisation::none, 0.5);
  // T^A_11 and T^C_11 are the terms whose difference is solved, so that the condition tells what their errors grow to.
  const KernelLine solved = kernel.solve(T_A11 - T_C11, T_A11.cwiseAbs() + T_C11.cwiseAbs(), T_12);
  MatrixXcd compliance = MatrixXcd::Zero(of.joint.size(), of.joint.size());
  MatrixXd unused = MatrixXd::Zero(of.joint.size(), of.joint.size());
  add_compliance(of.joint, omega, compliance, unused);
  T_B = T_21 * kernel.solution() - of.B_response.transpose() * T_A * of.B_force - compliance;
  T_B = (from_length * T_B * from_length).eval();
  left = from_length * (T_21 * kernel.inverse()) * to_length;
  right = to_length * kernel.solution() * from_length;
  return solved.condition;
}

}  // namespace

HolderReceptance holder_receptance(const ResponseModel& measured, const HeldTool& tool, double length) {
  Inverse of{{}, joints({tool.joint}, length), {}, {}};
  dynamics::require_equal(measured.axis, tool.free.axis);
  dynamics::require_complete(measured);
  dynamics::require_complete(tool.free);
  core::Faults faults;
  of.at_1 = measured_dofs(measured, tool, length, faults);
  faults.raise("tool swap");
  require_held(measured, tool.free, of.at_1);
  of.B_response = root_columns(tool.free.responses, of.joint);
  of.B_force = root_columns(tool.free.forces, of.joint);

  const DofTable dofs = holder_dofs(tool.joint);
  const std::size_t lines = measured.H.size();
  HolderReceptance holder{{measured.axis, dofs, dofs, std::vector<MatrixXcd>(lines)},
                          Eigen::VectorXd(measured.axis.size()),
                          std::vector<MatrixXcd>(lines),
                          std::vector<MatrixXcd>(lines)};
  core::parallel_for(lines, [&](std::size_t i) {
    const auto line = static_cast<Index>(i);
    MatrixXcd& T_B = holder.receptance.H[i];
    holder.condition(line) = invert_line(of, tool.free.H[i], measured.H[i], measured.axis.omega_rad_s(line), T_B,
                                         holder.left[i], holder.right[i]);
    if (!(holder.condition(line) <= singular_above)) T_B.setConstant(std::nan(""));
  });
  holder.rank_deficient_lines = static_cast<int>((!(holder.condition.array() <= singular_above)).count());
  return holder;
}

namespace {

/// Throws InputError unless both tools are held in the same directions and the second one has an overhang.
void require_alike(const HeldTool& tool_1, const HeldTool& tool_2) {
  core::Faults faults;
  faults.require(names(holder_dofs(tool_1.joint)) == names(holder_dofs(tool_2.joint)), "the joints of both tools",
                 "differ in their directions or in the holder's point");
  faults.require(
      std::any_of(tool_2.free.responses.begin(), tool_2.free.responses.end(),
                  [&](const Dof& dof) { return dof.kind != DofKind::modal && dof.point != tool_2.joint.point_a; }),
      "the second tool", "has no point but its root: a tool without overhang");
  faults.raise("tool swap");
}

}  // namespace

SwappedTool tool_swap(const ResponseModel& measured, const HeldTool& tool_1, const HeldTool& tool_2, double length) {
  require_alike(tool_1, tool_2);
  SwappedTool swapped;
  swapped.holder = holder_receptance(measured, tool_1, length);
  if (swapped.holder.rank_deficient()) {
    swapped.status = SwapStatus::rank_deficient;
    return swapped;
  }
  CouplingOptions options;
  options.length = length;
  for (const Dof& dof : tool_2.free.responses) options.points.push_back(dof.point);
  const std::vector<ResponseModel> components{tool_2.free, swapped.holder.receptance};
  swapped.coupled = couple(components, {tool_2.joint}, options);
  const CouplingSensitivity to = coupling_sensitivity(components, {tool_2.joint}, options);
  const auto directions = static_cast<Index>(tool_2.joint.springs.size());
  // dT^C_2 = P dT^B Q of the second coupling with dT^B = left dT^C_1 right of the first, by the chain rule.
  for (std::size_t line = 0; line < measured.H.size(); ++line) {
    swapped.left.emplace_back(to.P[line].rightCols(directions) * swapped.holder.left[line]);
    swapped.right.emplace_back(swapped.holder.right[line] * to.Q[line].bottomRows(directions));
  }
  const bool lost = swapped.coupled.status != KernelStatus::well_conditioned ||
                    swapped.holder.condition.maxCoeff() > ill_conditioned_above;
  swapped.status = lost ? SwapStatus::ill_conditioned : SwapStatus::done;
  return swapped;
}

std::vector<MatrixXd> swap_error_bound(const SwappedTool& swapped, const SwappedTool& best,
                                       const std::vector<MatrixXd>& left_over) {
  const std::size_t lines = best.left.size();
  core::Faults faults;
  faults.require(lines > 0 && !swapped.left.empty(), "a swap", "is not complete");
  faults.require(swapped.left.size() == lines && left_over.size() == lines &&
                     names(swapped.coupled.response.responses) == names(best.coupled.response.responses),
                 "the swaps and the errors", "differ in lines or degrees of freedom");
  for (std::size_t line = 0; line < std::min(lines, left_over.size()); ++line) {
    if (left_over[line].rows() == best.left[line].cols() && left_over[line].cols() == best.right[line].rows()) continue;
    faults.require(false, "an error matrix", "has not the shape of the measured response");
    break;
  }
  faults.raise("error of a tool swap");
  std::vector<MatrixXd> bound;
  for (std::size_t line = 0; line < lines; ++line) {
    bound.emplace_back((swapped.coupled.response.H[line] - best.coupled.response.H[line]).cwiseAbs() +
                       best.left[line].cwiseAbs() * left_over[line] * best.right[line].cwiseAbs());
  }
  return bound;
}

Contact radial_contact(const std::string& root, const std::string& holder, const RadialJoint& joint) {
  Contact contact{root, holder, {}, {}};
  for (Index axis = 0; axis < 2; ++axis) {
    contact.springs.push_back({Eigen::Vector3d::Unit(axis), joint.stiffness, joint.damping, 0.0, DofKind::translation});
  }
  for (Index axis = 0; axis < 2; ++axis) {
    contact.springs.push_back(
        {Eigen::Vector3d::Unit(axis), joint.rotational_stiffness, joint.rotational_damping, 0.0, DofKind::rotation});
  }
  return contact;
}

}  // namespace thinwall::coupling
