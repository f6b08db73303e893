#include "coupling/spatial.hpp"

#include <algorithm>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"

namespace thinwall::coupling {

namespace {

using dynamics::DofTable;
using dynamics::SpatialModel;

Eigen::MatrixXd block_diagonal(const std::vector<Eigen::MatrixXd>& blocks) {
  Eigen::Index rows = 0, columns = 0;
  for (const Eigen::MatrixXd& block : blocks) {
    rows += block.rows();
    columns += block.cols();
  }
  Eigen::MatrixXd joined = Eigen::MatrixXd::Zero(rows, columns);
  rows = columns = 0;
  for (const Eigen::MatrixXd& block : blocks) {
    joined.block(rows, columns, block.rows(), block.cols()) = block;
    rows += block.rows();
    columns += block.cols();
  }
  return joined;
}

Eigen::MatrixXd structural_damping(const SpatialModel& model) {
  return model.has_structural_damping() ? model.D : Eigen::MatrixXd::Zero(model.size(), model.size());
}

SpatialModel side_by_side(const std::vector<SpatialModel>& components) {
  const auto joined = [&](const auto& matrix_of) {
    std::vector<Eigen::MatrixXd> blocks;
    blocks.reserve(components.size());
    for (const SpatialModel& component : components) blocks.push_back(matrix_of(component));
    return block_diagonal(blocks);
  };
  DofTable dofs;
  for (const SpatialModel& component : components) {
    dofs.insert(dofs.end(), component.dofs.begin(), component.dofs.end());
  }
  return {joined([](const SpatialModel& model) { return model.M; }),
          joined([](const SpatialModel& model) { return model.C; }),
          joined([](const SpatialModel& model) { return model.K; }),
          joined(structural_damping),
          dofs,
          joined(dynamics::displacements)};
}

void require_joinable(const std::vector<SpatialModel>& components) {
  if (components.empty()) throw core::InputError("a coupling without a component");
  std::vector<const DofTable*> tables;
  for (const SpatialModel& component : components) {
    require_consistent(component);
    tables.push_back(&component.dofs);
  }
  require_different_points(tables);
}

/// The matrix B over the coordinates of all components: the opening of direction j is B.col(j)·y.
Eigen::MatrixXd openings(const SpatialModel& all, const Joints& joints) {
  Eigen::MatrixXd B(all.size(), joints.size());
  for (Eigen::Index j = 0; j < joints.size(); ++j) {
    const JoinedDirection& joined = joints.directions[static_cast<std::size_t>(j)];
    B.col(j) = joined.scale * (coordinate_row(all, joined.point_a, joined.direction, joined.kind) -
                               coordinate_row(all, joined.point_b, joined.direction, joined.kind));
  }
  return B;
}

/// True if some sum K_ii + k b_i² would lose digits of K_ii, because the added term is the larger one.
bool outweighs(double k, const Eigen::VectorXd& b, const Eigen::MatrixXd& K) {
  const Eigen::ArrayXd added = k * b.array().square();
  return (b.array() != 0.0 && added > K.diagonal().array().abs()).any();
}

/// The directions whose opening becomes a coordinate, rigid ones first, and the coordinate that each replaces.
struct Elimination {
  std::vector<Eigen::Index> directions;
  std::vector<Eigen::Index> replaced;
};

/// The largest entry among the columns `candidates` of the reduced B. Of equal entries in a column the last one is
/// taken, which belongs to the last component.
struct Pivot {
  Eigen::Index direction = 0;
  Eigen::Index coordinate = 0;
  double size = 0.0;
};
Pivot largest_pivot(const Eigen::MatrixXd& B, const std::vector<Eigen::Index>& candidates) {
  Pivot largest;
  for (const Eigen::Index j : candidates) {
    Eigen::Index from_end = 0;
    const double size = B.col(j).cwiseAbs().reverse().maxCoeff(&from_end);
    if (size > largest.size) largest = {j, B.rows() - 1 - from_end, size};
  }
  return largest;
}

/// Makes Gaussian elimination with full pivoting of the candidates' rows of Bᵀ, as far as they are independent. `B`
/// holds all columns, reduced by what was eliminated before, and is reduced further; entries up to `dependent` count as
/// round-off.
void eliminate(std::vector<Eigen::Index> candidates, double dependent, Eigen::MatrixXd& B, Elimination& elimination) {
  while (!candidates.empty()) {
    const Pivot pivot = largest_pivot(B, candidates);
    if (!(pivot.size > dependent)) return;
    const Eigen::VectorXd b = B.col(pivot.direction);
    B -= b * (B.row(pivot.coordinate) / b(pivot.coordinate));
    elimination.directions.push_back(pivot.direction);
    elimination.replaced.push_back(pivot.coordinate);
    candidates.erase(std::find(candidates.begin(), candidates.end(), pivot.direction));
  }
}

/// The elimination of a coupling. Rigid directions come first, because all of them must be eliminated; then those whose
/// stiffness would outweigh the components' entries. The others lose no digits when added to the entries.
Elimination eliminate(const Joints& joints, Eigen::MatrixXd B, const Eigen::MatrixXd& K) {
  std::vector<Eigen::Index> rigid, stiff;
  for (Eigen::Index j = 0; j < joints.size(); ++j) {
    if (joints.directions[static_cast<std::size_t>(j)].rigid) {
      rigid.push_back(j);
    } else if (outweighs(joints.K(j, j), B.col(j), K)) {
      stiff.push_back(j);
    }
  }
  const double dependent = 1e-10 * B.cwiseAbs().maxCoeff();  // coordinates may have any unit
  Elimination elimination;
  eliminate(rigid, dependent, B, elimination);
  if (elimination.directions.size() < rigid.size()) {
    throw core::InputError("of " + std::to_string(rigid.size()) + " rigid contact directions only " +
                           std::to_string(elimination.directions.size()) +
                           " are independent: leave out those that follow from the others or that nothing moves along");
  }
  eliminate(stiff, dependent, B, elimination);
  return elimination;
}

std::vector<Eigen::Index> others(Eigen::Index n, const std::vector<Eigen::Index>& replaced) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (std::find(replaced.begin(), replaced.end(), i) == replaced.end()) kept.push_back(i);
  }
  return kept;
}

/// The matrix T of y = T (u, d), with all openings d, also those of rigid directions, which stand first among them.
Eigen::MatrixXd opening_coordinates(const Eigen::MatrixXd& B, const Elimination& elimination,
                                    const std::vector<Eigen::Index>& kept) {
  const Eigen::Index n = B.rows();
  const auto m = static_cast<Eigen::Index>(elimination.directions.size());
  // The eliminated directions give d = B_sᵀ y_s + B_uᵀ u, which is solved for y_s.
  const Eigen::MatrixXd B_s = B(elimination.replaced, elimination.directions).transpose();
  const Eigen::MatrixXd B_u = B(kept, elimination.directions).transpose();
  const Eigen::MatrixXd B_s_inverse = B_s.inverse();
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n - m; ++i) T(kept[static_cast<std::size_t>(i)], i) = 1.0;
  T(elimination.replaced, Eigen::seqN(0, n - m)) = -B_s_inverse * B_u;
  T(elimination.replaced, Eigen::seqN(n - m, m)) = B_s_inverse;
  return T;
}

/// Adds O K_z Oᵀ to K, and likewise for C and D, with O the openings over (u, d): a unit vector for a direction whose
/// opening is a coordinate, Tᵀb for the others. K_z is zero for rigid directions.
void add_joints(const Joints& joints, const Eigen::MatrixXd& B, const Elimination& elimination,
                Eigen::Index first_opening, const Eigen::MatrixXd& T, SpatialModel& model) {
  Eigen::MatrixXd O = T.transpose() * B;
  for (std::size_t i = 0; i < elimination.directions.size(); ++i) {
    O.col(elimination.directions[i]).setZero();
    O(first_opening + static_cast<Eigen::Index>(i), elimination.directions[i]) = 1.0;
  }
  model.K += O * joints.K * O.transpose();
  model.C += O * joints.C * O.transpose();
  model.D += O * joints.D * O.transpose();
}

}  // namespace

SpatialModel couple(const std::vector<SpatialModel>& components, const std::vector<Contact>& contacts, double length) {
  const Joints joints = coupling::joints(contacts, length);
  require_joinable(components);
  const SpatialModel all = side_by_side(components);
  const Eigen::MatrixXd B = openings(all, joints);
  const Elimination elimination = eliminate(joints, B, all.K);
  const std::vector<Eigen::Index> kept = others(all.size(), elimination.replaced);
  const Eigen::MatrixXd T = opening_coordinates(B, elimination, kept);
  SpatialModel joined{T.transpose() * all.M * T,
                      T.transpose() * all.C * T,
                      T.transpose() * all.K * T,
                      T.transpose() * all.D * T,
                      all.dofs,
                      all.T * T};
  const auto first_opening = static_cast<Eigen::Index>(kept.size());
  add_joints(joints, B, elimination, first_opening, T, joined);

  // Rigid directions have d = 0: their rows and columns are left out.
  const auto closed = std::count_if(joints.directions.begin(), joints.directions.end(),
                                    [](const JoinedDirection& joined_rigidly) { return joined_rigidly.rigid; });
  std::vector<Eigen::Index> open;
  for (Eigen::Index i = 0; i < all.size(); ++i) {
    if (i < first_opening || i >= first_opening + closed) open.push_back(i);
  }
  if (open.empty()) {
    throw core::InputError("the rigid contacts hold every coordinate of the components: nothing is left that can move");
  }
  SpatialModel coupled{
      joined.M(open, open),      joined.C(open, open), joined.K(open, open), joined.D(open, open), all.dofs,
      joined.T(Eigen::all, open)};
  if (coupled.D.isZero(0.0)) coupled.D.resize(0, 0);
  return coupled;
}

SpatialModel couple(const SpatialModel& part, const SpatialModel& robot, const std::vector<Contact>& contacts,
                    double length) {
  return couple(std::vector<SpatialModel>{part, robot}, contacts, length);
}

}  // namespace thinwall::coupling
