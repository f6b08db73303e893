#include "coupling/spatial.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <numeric>

#include "core/error.hpp"

namespace thinwall::coupling {

namespace {

using dynamics::Dof;
using dynamics::DofKind;
using dynamics::DofTable;
using dynamics::SpatialModel;

Eigen::MatrixXd block_diagonal(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd joined = Eigen::MatrixXd::Zero(a.rows() + b.rows(), a.cols() + b.cols());
  joined.topLeftCorner(a.rows(), a.cols()) = a;
  joined.bottomRightCorner(b.rows(), b.cols()) = b;
  return joined;
}

Eigen::MatrixXd structural_damping(const SpatialModel& model) {
  return model.has_structural_damping() ? model.D : Eigen::MatrixXd::Zero(model.size(), model.size());
}

SpatialModel side_by_side(const SpatialModel& part, const SpatialModel& robot) {
  for (const Dof& a : part.dofs) {
    for (const Dof& b : robot.dofs) {
      if (a.point == b.point) {
        throw core::InputError("part and robot both have \"" + a.point + "\" in their tables: rename one of them");
      }
    }
  }
  DofTable dofs = part.dofs;
  dofs.insert(dofs.end(), robot.dofs.begin(), robot.dofs.end());
  return {block_diagonal(part.M, robot.M), block_diagonal(part.C, robot.C), block_diagonal(part.K, robot.K),
          block_diagonal(structural_damping(part), structural_damping(robot)), dofs};
}

/// bᵀx is the opening of a spring: part minus robot, along its direction.
Eigen::VectorXd opening(const SpatialModel& part, const SpatialModel& robot, const Contact& contact,
                        const ContactSpring& spring) {
  Eigen::VectorXd b(part.size() + robot.size());
  b << dynamics::displacement_row(part.dofs, contact.part_point, spring.direction),
      -dynamics::displacement_row(robot.dofs, contact.robot_point, spring.direction);
  return b;
}

/// Basis of { x : Bᵀx = 0 } in which each coordinate is one DOF (the pivots' DOFs follow from the others), and those
/// DOFs.
struct NullSpace {
  Eigen::MatrixXd T;
  std::vector<Eigen::Index> coordinates;
};

/// Gaussian elimination with full pivoting of Bᵀ. The robot's DOFs stand first, so that of two equal pivots the robot's
/// is the one that is eliminated.
NullSpace null_space(const Eigen::MatrixXd& B) {
  const Eigen::Index n = B.rows();
  if (B.cols() == 0) {
    NullSpace all{Eigen::MatrixXd::Identity(n, n), std::vector<Eigen::Index>(static_cast<std::size_t>(n))};
    std::iota(all.coordinates.begin(), all.coordinates.end(), Eigen::Index{0});
    return all;
  }
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(B.transpose().rowwise().reverse());
  if (lu.rank() < B.cols()) {
    throw core::InputError("of " + std::to_string(B.cols()) + " rigid contact directions only " +
                           std::to_string(lu.rank()) + " are independent: leave out those that follow from the others");
  }
  const Eigen::MatrixXd kernel = lu.kernel().colwise().reverse();
  std::vector<Eigen::Index> order(static_cast<std::size_t>(kernel.cols()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  const auto dof = [&](Eigen::Index column) { return n - 1 - lu.permutationQ().indices()(lu.rank() + column); };
  std::sort(order.begin(), order.end(), [&](Eigen::Index i, Eigen::Index j) { return dof(i) < dof(j); });
  NullSpace space{kernel(Eigen::all, order), {}};
  for (const Eigen::Index column : order) space.coordinates.push_back(dof(column));
  return space;
}

DofTable coordinate_table(const DofTable& dofs, const std::vector<Eigen::Index>& coordinates) {
  std::vector<bool> kept(dofs.size(), false);
  for (const Eigen::Index i : coordinates) kept[static_cast<std::size_t>(i)] = true;
  const auto incomplete = [&](const std::string& point) {
    for (std::size_t i = 0; i < dofs.size(); ++i) {
      if (!kept[i] && dofs[i].point == point) return true;
    }
    return false;
  };
  DofTable table;
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    if (!kept[i]) continue;
    table.push_back(incomplete(dofs[i].point) ? Dof{dynamics::name(dofs[i]), Eigen::Vector3d::Zero(), DofKind::modal}
                                              : dofs[i]);
  }
  return table;
}

}  // namespace

CoupledModel couple(const SpatialModel& part, const SpatialModel& robot, const std::vector<Contact>& contacts) {
  require_valid(contacts);
  require_consistent(part);
  require_consistent(robot);
  SpatialModel all = side_by_side(part, robot);
  Eigen::MatrixXd rigid(all.size(), 0);
  for (const Contact& contact : contacts) {
    for (const ContactSpring& spring : contact.springs) {
      const Eigen::VectorXd b = opening(part, robot, contact, spring);
      if (spring.rigid()) {
        rigid.conservativeResize(Eigen::NoChange, rigid.cols() + 1);
        rigid.rightCols(1) = b;
        continue;
      }
      const Eigen::MatrixXd unit = b * b.transpose();
      all.K += spring.stiffness * unit;
      all.C += spring.damping * unit;
      all.D += spring.loss_factor * spring.stiffness * unit;
    }
  }
  const auto [T, coordinates] = null_space(rigid);
  CoupledModel coupled{{}, T, all.dofs};
  coupled.independent = {T.transpose() * all.M * T, T.transpose() * all.C * T, T.transpose() * all.K * T,
                         T.transpose() * all.D * T, coordinate_table(all.dofs, coordinates)};
  if (coupled.independent.D.isZero(0.0)) coupled.independent.D.resize(0, 0);
  return coupled;
}

dynamics::ModalModel to_modal(const CoupledModel& model) {
  dynamics::ModalModel modal = dynamics::to_modal(model.independent);
  modal.right = model.T * modal.right;
  modal.left = model.T * modal.left;
  modal.dofs = model.dofs;
  return modal;
}

dynamics::ResponseModel direct_response(const CoupledModel& model, const dynamics::FrequencyAxis& axis) {
  return dynamics::direct_response(model.independent, model.T, model.dofs, axis);
}

}  // namespace thinwall::coupling
