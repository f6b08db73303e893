#include "robot/virtual_joints.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "core/dense_eigenvalues.hpp"
#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "core/faults.hpp"
#include "robot/arm_kinematics.hpp"

namespace thinwall::robot {

namespace {

using dynamics::Matrix6;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Matrix6X = Eigen::Matrix<double, 6, Eigen::Dynamic>;

constexpr double rank_below = 1e-9;  // relative bound of singular values; compliances of 1e-18 thus count as zero

// ---- checks ------------------------------------------------------------------------------------------------------

void check(const VirtualJoint& joint, const std::string& where, core::Faults& faults) {
  faults.require(std::abs(joint.axis.norm() - 1.0) <= 1e-9, where, "has an axis that is not a unit vector");
  faults.require(std::isfinite(joint.position), where, "has a position that is not a number");
  faults.require(joint.stiffness >= 0.0, where, "has a stiffness that is negative or not a number");
  faults.require_number(joint.damping, joint.damping >= 0.0, where, "damping", "not be negative");
}

void check(const VirtualSpring& spring, const std::string& where, core::Faults& faults) {
  const Matrix6& S = spring.compliance;
  const double scale = S.cwiseAbs().maxCoeff();
  const bool symmetric = S.allFinite() && (S - S.transpose()).cwiseAbs().maxCoeff() <= 1e-9 * scale;
  faults.require(symmetric, where, "has a compliance that is not finite and symmetric");
  if (!symmetric) return;
  const VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Matrix6>(S, Eigen::EigenvaluesOnly).eigenvalues();
  faults.require(eigenvalues(0) >= -1e-9 * scale, where, "has a compliance that is not positive semidefinite");
}

void check(const ChainElement& element, const std::string& where, core::Faults& faults) {
  if (const auto* link = std::get_if<RigidLink>(&element)) {
    faults.require(dynamics::is_frame(link->placement), where,
                   "has a placement that is no frame: axes of unit length, at right angles and right-handed");
  } else if (const auto* joint = std::get_if<VirtualJoint>(&element)) {
    check(*joint, where, faults);
  } else if (const auto* beam = std::get_if<BeamLink>(&element)) {
    dynamics::check(beam->section, where, faults);
    faults.require_number(beam->length, beam->length > 0.0, where, "length (m)", "be positive");
  } else if (const auto* spring = std::get_if<VirtualSpring>(&element)) {
    check(*spring, where, faults);
  } else {
    dynamics::check(std::get<dynamics::RigidBody>(element), where, faults);
  }
}

void require_valid(const std::vector<Chain>& chains) {
  core::Faults faults;
  faults.require(!chains.empty(), "it", "has no chain");
  for (std::size_t c = 0; c < chains.size(); ++c) {
    const std::string where = "chain " + std::to_string(c + 1);
    faults.require(dynamics::is_frame(chains[c].base), where, "has a base that is no frame");
    faults.require(!chains[c].elements.empty(), where, "has no element");
    for (std::size_t i = 0; i < chains[c].elements.size(); ++i)
      check(chains[c].elements[i], where + ", element " + std::to_string(i + 1), faults);
  }
  faults.raise("robot of virtual joints");
}

// ---- products that many places need, compiled once ----------------------------------------------------------------

MatrixXd symmetric(const MatrixXd& A) {
  return 0.5 * (A + A.transpose());
}

MatrixXd product(const MatrixXd& A, const MatrixXd& B) {
  return A * B;
}

/// Tᵀ A T, a form A in the coordinates of the columns of T.
MatrixXd congruent(const MatrixXd& A, const MatrixXd& T) {
  return product(T.transpose(), product(A, T));
}

// ---- chains in their places --------------------------------------------------------------------------------------

/// An element in its place, with the motions that it adds to the frame behind it.
struct Station {
  const ChainElement* element = nullptr;
  Eigen::Isometry3d before, after;
  Matrix6X motions{6, 0};  ///< motions of the frame after, one column for each of its k coordinates, world axes
  MatrixXd root{};         ///< k × k, a root of their compliance C = root rootᵀ
  MatrixXd damping{};      ///< k × k; empty if there is none
  bool passive = false;

  [[nodiscard]] Vector3d step() const { return after.translation() - before.translation(); }
};

/// The root V √Λ of a compliance, scaled to a unit diagonal before, because its entries may differ by many powers of
/// ten.
MatrixXd root_of(const Matrix6& S) {
  const Eigen::Vector<double, 6> scale = S.diagonal().unaryExpr([](double s) { return s > 0.0 ? std::sqrt(s) : 1.0; });
  const Matrix6 scaled = scale.cwiseInverse().asDiagonal() * S * scale.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(Matrix6(0.5 * (scaled + scaled.transpose())));
  const double zero = 1e-14 * eigen.eigenvalues().maxCoeff();
  const VectorXd roots = eigen.eigenvalues().unaryExpr([zero](double l) { return l > zero ? std::sqrt(l) : 0.0; });
  return scale.asDiagonal() * eigen.eigenvectors() * roots.asDiagonal();
}

/// Fills in a joint's motion, compliance and damping.
void place(const VirtualJoint& joint, Station& station) {
  const Vector3d axis = station.before.linear() * joint.axis;
  station.motions = Matrix6X::Zero(6, 1);
  if (joint.motion == VirtualJoint::Motion::rotation) {
    station.after = station.before * Eigen::AngleAxisd(joint.position, joint.axis);
    station.motions.bottomRows<3>() = axis;
  } else {
    station.after = station.before * Eigen::Translation3d(joint.position * joint.axis);
    station.motions.topRows<3>() = axis;
  }
  station.passive = joint.stiffness == 0.0;
  if (!station.passive) station.root = MatrixXd::Constant(1, 1, 1.0 / std::sqrt(joint.stiffness));
  station.damping = MatrixXd::Constant(1, 1, joint.damping);
}

/// The elements of a chain in their places, from its base outwards.
std::vector<Station> placed(const Chain& chain) {
  std::vector<Station> stations;
  stations.reserve(chain.elements.size());
  Eigen::Isometry3d frame = chain.base;
  for (const ChainElement& element : chain.elements) {
    Station station{.element = &element, .before = frame, .after = frame};
    if (const auto* link = std::get_if<RigidLink>(&element)) {
      station.after = frame * link->placement;
    } else if (const auto* joint = std::get_if<VirtualJoint>(&element)) {
      place(*joint, station);
    } else if (const auto* beam = std::get_if<BeamLink>(&element)) {
      station.after = frame * Eigen::Translation3d(beam->length, 0.0, 0.0);
      station.motions = dynamics::turned(frame.linear());
      station.root = root_of(dynamics::tip_compliance(beam->section, beam->length));
    } else if (const auto* spring = std::get_if<VirtualSpring>(&element)) {
      station.motions = dynamics::turned(frame.linear());
      station.root = root_of(spring->compliance);
    }
    frame = station.after;
    stations.push_back(std::move(station));
  }
  return stations;
}

Vector3d tip_of(const std::vector<Station>& stations) {
  return stations.back().after.translation();
}

/// The length by which a rotation is scaled beside a translation: the largest distance of a frame from the tip.
double size_of(const std::vector<std::vector<Station>>& chains) {
  double size = 0.0;
  for (const auto& stations : chains) {
    for (const Station& station : stations)
      size = std::max(size, (tip_of(stations) - station.before.translation()).norm());
  }
  return size > 0.0 ? size : 1.0;
}

// ---- statics of a chain ------------------------------------------------------------------------------------------

/// Motions of the tip by springs, J_θ C_θ^½, and by passive joints, with rotations times the robot's size.
struct Jacobians {
  Matrix6X springs{6, 0};
  Matrix6X passive{6, 0};
};

void append(Matrix6X& columns, const Matrix6X& more) {
  columns.conservativeResize(Eigen::NoChange, columns.cols() + more.cols());
  columns.rightCols(more.cols()) = more;
}

/// The Jacobians of the tip by the coordinates of a chain: motions at a frame are carried to the tip as those of a
/// rigid body.
Jacobians jacobians(const std::vector<Station>& stations, const Matrix6& scale) {
  Jacobians J;
  for (const Station& station : stations) {
    if (station.motions.cols() == 0) continue;
    const Matrix6 to_tip = scale * dynamics::transport(tip_of(stations) - station.after.translation());
    const MatrixXd at_tip = product(to_tip, station.motions);
    if (station.passive) {
      append(J.passive, at_tip);
    } else {
      append(J.springs, product(at_tip, station.root));
    }
  }
  return J;
}

Index rank_of(const VectorXd& singular) {
  if (singular.size() == 0 || singular(0) == 0.0) return 0;
  return (singular.array() > rank_below * singular(0)).count();
}

/// Orthonormal bases of range(A) and of its complement.
struct Split {
  MatrixXd range, complement;
};

Split split(const MatrixXd& A) {
  if (A.cols() == 0) return {MatrixXd(A.rows(), 0), MatrixXd::Identity(A.rows(), A.rows())};
  const Eigen::JacobiSVD<MatrixXd> svd(A, Eigen::ComputeFullU);
  const Index rank = rank_of(svd.singularValues());
  return {svd.matrixU().leftCols(rank), svd.matrixU().rightCols(A.rows() - rank)};
}

/// The statics of a chain, in scaled components: its stiffness, the wrenches that strain nothing and therefore forbid a
/// motion (orthonormal), and the springs' coordinates divided by C_θ^½ as a function of the tip's motion.
struct Statics {
  Jacobians J;
  Matrix6 K = Matrix6::Zero();
  Matrix6X forbidden{6, 0};
  MatrixXd springs_by_tip;
};

/// The statics of a chain. With A = Nᵀ J_θ C_θ^½ = U Σ Vᵀ the stiffness N (A Aᵀ)⁺ Nᵀ is N U Σ⁻² UᵀNᵀ; singular values
/// of A instead of eigenvalues of A Aᵀ keep digits if springs differ by many powers of ten.
Statics statics(Jacobians J) {
  // The columns of passive joints are normalised, because a short slide frees a motion as completely as a rotation
  // does.
  const MatrixXd N =
      split(J.passive.cols() > 0 ? MatrixXd(J.passive.colwise().normalized()) : MatrixXd(6, 0)).complement;
  const MatrixXd A = product(N.transpose(), J.springs);
  Statics chain{.J = std::move(J), .springs_by_tip = MatrixXd::Zero(A.cols(), 6)};
  if (A.cols() == 0 || A.rows() == 0) {
    chain.forbidden = N;
    return chain;
  }
  const Eigen::JacobiSVD<MatrixXd> svd(A, Eigen::ComputeFullU | Eigen::ComputeThinV);
  const Index rank = rank_of(svd.singularValues());
  const MatrixXd wrenches = product(N, svd.matrixU().leftCols(rank));
  const VectorXd inverse = svd.singularValues().head(rank).cwiseInverse();
  // A unit of v_i in the springs' coordinates moves the tip by σ_i along N u_i, so that a unit of motion there strains
  // the springs by v_i / σ_i.
  const MatrixXd stretched = wrenches * inverse.asDiagonal();
  chain.K = product(stretched, stretched.transpose());
  chain.springs_by_tip = product(svd.matrixV().leftCols(rank), stretched.transpose());
  chain.forbidden = product(N, svd.matrixU().rightCols(A.rows() - rank));
  return chain;
}

// ---- reduction ---------------------------------------------------------------------------------------------------

/// The coordinates of all stations, springs and passive joints in the order of the chain, as functions of y. Z is
/// scaled. The passive joints take the least-squares solution of smallest norm of what the springs leave of the motion.
std::vector<MatrixXd> coordinates(const std::vector<Station>& stations, const Statics& chain, const MatrixXd& Z) {
  const MatrixXd springs = product(chain.springs_by_tip, Z);
  MatrixXd passive(0, Z.cols());
  if (chain.J.passive.cols() > 0) {
    const VectorXd length = chain.J.passive.colwise().norm();
    const Eigen::CompleteOrthogonalDecomposition<MatrixXd> least(
        MatrixXd(chain.J.passive * length.cwiseInverse().asDiagonal()));
    const MatrixXd left = Z - product(chain.J.springs, springs);
    passive = length.cwiseInverse().asDiagonal() * MatrixXd(least.solve(left));
  }
  std::vector<MatrixXd> each;
  Index spring = 0, joint = 0;
  for (const Station& station : stations) {
    const Index k = station.motions.cols();
    if (k == 0) {
      each.emplace_back(0, Z.cols());
    } else if (station.passive) {
      each.push_back(passive.middleRows(std::exchange(joint, joint + k), k));
    } else {
      each.push_back(product(station.root, springs.middleRows(std::exchange(spring, spring + k), k)));
    }
  }
  return each;
}

/// The mass matrix that the element between two frames contributes, from the motions of the frames in the world's axes.
MatrixXd mass_of(const Station& station, const Matrix6X& before, const Matrix6X& after) {
  if (const auto* beam = std::get_if<BeamLink>(station.element)) {
    const Matrix6 R = dynamics::turned(station.before.linear().transpose());
    MatrixXd ends(12, before.cols());
    ends << product(R, before), product(R, after);
    return congruent(dynamics::beam_mass(beam->section, beam->length), ends);
  }
  if (const auto* body = std::get_if<dynamics::RigidBody>(station.element)) {
    const MatrixXd local = product(dynamics::turned(station.before.linear().transpose()), before);
    return congruent(dynamics::mass_matrix(*body), local);
  }
  return MatrixXd::Zero(before.cols(), before.cols());
}

/// Adds the masses and dampers of a chain to the model, from its base outwards.
void add_chain(const std::vector<Station>& stations, const std::vector<MatrixXd>& coordinates, ReducedTip& tip) {
  Matrix6X motion = Matrix6X::Zero(6, tip.Z.cols());
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const Station& station = stations[i];
    const Matrix6X after =
        product(dynamics::transport(station.step()), motion) + product(station.motions, coordinates[i]);
    tip.M += mass_of(station, motion, after);
    if (station.damping.size() > 0) tip.C += congruent(station.damping, coordinates[i]);
    motion = after;
  }
}

/// Throws InputError unless all chains end at one point.
void require_one_tip(const std::vector<std::vector<Station>>& chains, double size) {
  for (std::size_t c = 1; c < chains.size(); ++c) {
    const double apart = (tip_of(chains[c]) - tip_of(chains[0])).norm();
    if (apart <= 1e-9 * size) continue;
    std::ostringstream text;
    text << "robot of virtual joints: chain " << c + 1 << " ends " << apart
         << " m from where chain 1 ends; choose joint positions that close the loop (to 1e-9 of the robot's size)";
    throw core::InputError(text.str());
  }
}

/// Number of zero eigenvalues of a symmetric positive semidefinite matrix, scaled to a unit diagonal.
Index rank_deficiency(const MatrixXd& A) {
  const VectorXd scale = A.diagonal().unaryExpr([](double a) { return a > 0.0 ? 1.0 / std::sqrt(a) : 0.0; });
  const MatrixXd scaled = scale.asDiagonal() * A * scale.asDiagonal();
  const VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues();
  return (eigenvalues.array() <= 1e-13 * std::max(eigenvalues.maxCoeff(), std::numeric_limits<double>::min())).count();
}

}  // namespace

Chain chain(const SerialArm& arm, const VectorXd& q) {
  require_valid(arm);
  (void)pose(arm, q);  // throws for angles that do not fit the arm
  Chain result{.base = arm.base, .elements = {}};
  for (std::size_t i = 0; i < arm.links.size(); ++i) {
    const Link& link = arm.links[i];
    if (!link.joint.motor_locked()) {
      throw core::InputError("joint " + std::to_string(i + 1) + (link.name.empty() ? "" : " (" + link.name + ")") +
                             ": a virtual joint has no motor of its own; lock it and give the stiffness of servo and "
                             "gearbox in a row, k k_p / (k + k_p)");
    }
    result.elements.emplace_back(RigidLink{link.placement});
    result.elements.emplace_back(
        VirtualJoint{.motion = link.slides ? VirtualJoint::Motion::translation : VirtualJoint::Motion::rotation,
                     .axis = link.axis,
                     .position = q(static_cast<Index>(i)),
                     .stiffness = link.joint.stiffness,
                     .damping = link.joint.damping});
    result.elements.emplace_back(dynamics::RigidBody{link.mass, link.centre, link.inertia});
  }
  result.elements.emplace_back(RigidLink{arm.tip});
  return result;
}

ReducedTip reduced_tip(const std::vector<Chain>& chains) {
  require_valid(chains);
  std::vector<std::vector<Station>> stations;
  stations.reserve(chains.size());
  for (const Chain& chain : chains) stations.push_back(placed(chain));
  const double size = size_of(stations);
  require_one_tip(stations, size);
  Eigen::Vector<double, 6> scale;
  scale << 1.0, 1.0, 1.0, size, size, size;

  Matrix6 K = Matrix6::Zero();
  Matrix6X forbidden(6, 0);
  std::vector<Statics> at_rest;
  at_rest.reserve(chains.size());
  for (const auto& chain : stations) {
    at_rest.push_back(statics(jacobians(chain, scale.asDiagonal())));
    K += at_rest.back().K;
    append(forbidden, at_rest.back().forbidden);
  }
  // If nothing is forbidden, the coordinates y are the six motions themselves.
  const bool all = forbidden.cols() == 0;
  const MatrixXd Z = all ? MatrixXd(scale.asDiagonal()) : split(forbidden).complement;
  const Index n = Z.cols();
  if (n == 0)
    throw core::InputError("robot of virtual joints: its tip cannot move; give a joint or link its compliance");
  ReducedTip tip{.Z = all ? MatrixXd::Identity(6, 6) : MatrixXd(scale.cwiseInverse().asDiagonal() * Z),
                 .M = MatrixXd::Zero(n, n),
                 .C = MatrixXd::Zero(n, n),
                 .K = symmetric(congruent(K, Z))};
  tip.free = rank_deficiency(tip.K);
  for (std::size_t c = 0; c < chains.size(); ++c) add_chain(stations[c], coordinates(stations[c], at_rest[c], Z), tip);
  tip.M = symmetric(tip.M);
  tip.C = symmetric(tip.C);
  return tip;
}

Matrix6 compliance(const ReducedTip& tip) {
  if (tip.free > 0) {
    throw core::InputError("robot of virtual joints: " + std::to_string(tip.free) +
                           " motions of its tip are free, so it has no compliance; hold them, or take the stiffness");
  }
  return symmetric(product(tip.Z, tip.K.ldlt().solve(MatrixXd(tip.Z.transpose()))));
}

Matrix6 stiffness(const ReducedTip& tip) {
  if (tip.rigid() > 0) {
    throw core::InputError("robot of virtual joints: its tip cannot move in " + std::to_string(tip.rigid()) +
                           " of six directions, so it has no stiffness there; take the compliance");
  }
  const Matrix6 inverse = Matrix6(tip.Z).inverse();
  return symmetric(congruent(tip.K, inverse));
}

dynamics::SpatialModel spatial_model(const ReducedTip& tip, const std::string& point) {
  if (rank_deficiency(tip.M) > 0) {
    throw core::InputError("robot of virtual joints: its tip \"" + point +
                           "\" can move without moving mass; give the links their density, or the tip a body");
  }
  dynamics::SpatialModel model{tip.M, tip.C, tip.K, {}, dynamics::six_dofs(point), {}};
  if (!tip.Z.isIdentity(0.0)) model.T = tip.Z;
  return model;
}

}  // namespace thinwall::robot
