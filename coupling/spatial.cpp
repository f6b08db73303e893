#include "coupling/spatial.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "core/error.hpp"

namespace thinwall::coupling {

namespace {

using dynamics::Dof;
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
  return {block_diagonal(part.M, robot.M),
          block_diagonal(part.C, robot.C),
          block_diagonal(part.K, robot.K),
          block_diagonal(structural_damping(part), structural_damping(robot)),
          dofs,
          block_diagonal(displacements(part), displacements(robot))};
}

/// A spring between the components: bᵀy is its opening.
struct Joint {
  Eigen::VectorXd b;
  ContactSpring spring;
};

std::vector<Joint> joints(const SpatialModel& part, const SpatialModel& robot, const std::vector<Contact>& contacts) {
  std::vector<Joint> all;
  for (const Contact& contact : contacts) {
    for (const ContactSpring& spring : contact.springs) {
      Eigen::VectorXd b(part.size() + robot.size());
      b << coordinate_row(part, contact.part_point, spring.direction),
          -coordinate_row(robot, contact.robot_point, spring.direction);
      all.push_back({b, spring});
    }
  }
  return all;
}

/// True if k in the sum K_ii + k b_i² would push out digits of K_ii.
bool outweighs(const Joint& joint, const Eigen::MatrixXd& K) {
  const Eigen::ArrayXd added = joint.spring.stiffness * joint.b.array().square();
  return (joint.b.array() != 0.0 && added > K.diagonal().array().abs()).any();
}

/// Which springs become coordinates, the rigid ones first, and which coordinate each replaces.
struct Elimination {
  std::vector<std::size_t> joints;
  std::vector<Eigen::Index> replaced;
};

/// The largest entry of the rows `candidates` of the reduced Bᵀ (columns of `rows`); of equal ones in a row the last,
/// which is the robot's.
struct Pivot {
  std::size_t joint = 0;
  Eigen::Index coordinate = 0;
  double size = 0.0;
};
Pivot largest_pivot(const Eigen::MatrixXd& rows, const std::vector<std::size_t>& candidates) {
  Pivot largest;
  for (const std::size_t j : candidates) {
    Eigen::Index from_end = 0;
    const double size = rows.col(static_cast<Eigen::Index>(j)).cwiseAbs().reverse().maxCoeff(&from_end);
    if (size > largest.size) largest = {j, rows.rows() - 1 - from_end, size};
  }
  return largest;
}

/// Gaussian elimination with full pivoting of the candidates' rows bᵀ, as far as they are independent; `rows` holds all
/// rows, reduced by what was eliminated before, and is reduced further; what is no larger than `dependent` is
/// round-off.
void eliminate(std::vector<std::size_t> candidates, double dependent, Eigen::MatrixXd& rows, Elimination& elimination) {
  while (!candidates.empty()) {
    const Pivot pivot = largest_pivot(rows, candidates);
    if (!(pivot.size > dependent)) return;
    const Eigen::VectorXd row = rows.col(static_cast<Eigen::Index>(pivot.joint));
    rows -= row * (rows.row(pivot.coordinate) / row(pivot.coordinate));
    elimination.joints.push_back(pivot.joint);
    elimination.replaced.push_back(pivot.coordinate);
    candidates.erase(std::find(candidates.begin(), candidates.end(), pivot.joint));
  }
}

/// Rigid springs first, since they must all be eliminated; then those that would outweigh the components' entries. The
/// others do no harm where they are.
Elimination eliminate(const std::vector<Joint>& joints, const Eigen::MatrixXd& K) {
  std::vector<std::size_t> rigid, stiff;
  Eigen::MatrixXd rows(K.rows(), static_cast<Eigen::Index>(joints.size()));
  for (std::size_t j = 0; j < joints.size(); ++j) {
    rows.col(static_cast<Eigen::Index>(j)) = joints[j].b;
    if (joints[j].spring.rigid()) {
      rigid.push_back(j);
    } else if (outweighs(joints[j], K)) {
      stiff.push_back(j);
    }
  }
  const double dependent = 1e-10 * rows.cwiseAbs().maxCoeff();  // coordinates may have any unit
  Elimination elimination;
  eliminate(rigid, dependent, rows, elimination);
  if (elimination.joints.size() < rigid.size()) {
    throw core::InputError("of " + std::to_string(rigid.size()) + " rigid contact directions only " +
                           std::to_string(elimination.joints.size()) +
                           " are independent: leave out those that follow from the others or that nothing moves along");
  }
  eliminate(stiff, dependent, rows, elimination);
  return elimination;
}

std::vector<Eigen::Index> others(Eigen::Index n, const std::vector<Eigen::Index>& replaced) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (std::find(replaced.begin(), replaced.end(), i) == replaced.end()) kept.push_back(i);
  }
  return kept;
}

/// T of y = T (u, d), over all openings, also those of rigid springs (which stand first among the openings).
Eigen::MatrixXd opening_coordinates(const std::vector<Joint>& joints, const Elimination& elimination,
                                    const std::vector<Eigen::Index>& kept) {
  const Eigen::Index n = joints.front().b.size();
  const auto m = static_cast<Eigen::Index>(elimination.joints.size());
  Eigen::MatrixXd B(n, m);
  for (Eigen::Index j = 0; j < m; ++j) B.col(j) = joints[elimination.joints[static_cast<std::size_t>(j)]].b;
  const Eigen::MatrixXd B_s = B(elimination.replaced, Eigen::all).transpose();
  const Eigen::MatrixXd B_u = B(kept, Eigen::all).transpose();
  const Eigen::MatrixXd B_s_inverse = B_s.inverse();
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n - m; ++i) T(kept[static_cast<std::size_t>(i)], i) = 1.0;
  T(elimination.replaced, Eigen::seqN(0, n - m)) = -B_s_inverse * B_u;
  T(elimination.replaced, Eigen::seqN(n - m, m)) = B_s_inverse;
  return T;
}

/// Adds the springs of finite stiffness: those with an opening of their own on its diagonal, the others by Tᵀb.
void add_springs(const std::vector<Joint>& joints, const Elimination& elimination, Eigen::Index first_opening,
                 const Eigen::MatrixXd& T, SpatialModel& model) {
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const ContactSpring& spring = joints[j].spring;
    if (spring.rigid()) continue;
    const auto own = std::find(elimination.joints.begin(), elimination.joints.end(), j);
    Eigen::VectorXd opening = T.transpose() * joints[j].b;
    if (own != elimination.joints.end()) {
      opening = Eigen::VectorXd::Unit(T.cols(), first_opening + (own - elimination.joints.begin()));
    }
    const Eigen::MatrixXd unit = opening * opening.transpose();
    model.K += spring.stiffness * unit;
    model.C += spring.damping * unit;
    model.D += spring.loss_factor * spring.stiffness * unit;
  }
}

}  // namespace

SpatialModel couple(const SpatialModel& part, const SpatialModel& robot, const std::vector<Contact>& contacts) {
  require_valid(contacts);
  require_consistent(part);
  require_consistent(robot);
  const SpatialModel all = side_by_side(part, robot);
  const std::vector<Joint> springs = joints(part, robot, contacts);
  const Elimination elimination = eliminate(springs, all.K);
  const std::vector<Eigen::Index> kept = others(all.size(), elimination.replaced);
  const Eigen::MatrixXd T = opening_coordinates(springs, elimination, kept);
  SpatialModel joined{T.transpose() * all.M * T,
                      T.transpose() * all.C * T,
                      T.transpose() * all.K * T,
                      T.transpose() * all.D * T,
                      all.dofs,
                      all.T * T};
  const auto first_opening = static_cast<Eigen::Index>(kept.size());
  add_springs(springs, elimination, first_opening, T, joined);

  const auto closed = std::count_if(springs.begin(), springs.end(), [](const Joint& j) { return j.spring.rigid(); });
  std::vector<Eigen::Index> open;
  for (Eigen::Index i = 0; i < all.size(); ++i) {
    if (i < first_opening || i >= first_opening + closed) open.push_back(i);
  }
  if (open.empty()) {
    throw core::InputError("the rigid contacts hold every coordinate of part and robot: nothing is left that can move");
  }
  SpatialModel coupled{
      joined.M(open, open),      joined.C(open, open), joined.K(open, open), joined.D(open, open), all.dofs,
      joined.T(Eigen::all, open)};
  if (coupled.D.isZero(0.0)) coupled.D.resize(0, 0);
  return coupled;
}

}  // namespace thinwall::coupling
