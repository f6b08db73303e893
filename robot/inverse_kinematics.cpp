#include "robot/inverse_kinematics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "robot/arm_kinematics.hpp"

namespace thinwall::robot {

namespace {

using Eigen::Vector3d;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// The height of the second joint above the base, followed by the lengths of the three links beyond it, m.
using Lengths = std::array<double, 4>;

/// True if the frame differs from the one before by a shift along z only.
bool is_along_z(const Eigen::Isometry3d& frame) {
  return (frame.linear() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= 1e-12 &&
         frame.translation().head<2>().norm() <= 1e-12;
}

/// The lengths of a four-axis arm. Throws InputError for an arm of another kind.
Lengths four_axis_lengths(const SerialArm& arm) {
  if (!is_four_axis(arm)) {
    throw core::InputError(
        "the closed form is for four joints that turn, the first about z, the others about y, all above each other "
        "along z where "
        "all angles are zero: search numerically instead");
  }
  const auto z = [&](std::size_t i) { return arm.links[i].placement.translation().z(); };
  return {z(0) + z(1), z(2), z(3), arm.tip.translation().z()};
}

/// The angle in (−π, π].
double within_a_turn(double angle) {
  const double turned = std::remainder(angle, 2.0 * std::numbers::pi);
  return turned <= -std::numbers::pi ? std::numbers::pi : turned;
}

/// The error of the tip's frame: translation, then the rotation vector times `length`.
Vector6d error_of(const ArmPose& at, const Eigen::Isometry3d& target, double length) {
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(at.tip.linear() * target.linear().transpose()));
  Vector6d e;
  e << at.tip.translation() - target.translation(), length * turn.angle() * turn.axis();
  return e;
}

/// The Jacobian of the tip with rotations times `length`.
Eigen::Matrix<double, 6, Eigen::Dynamic> scaled_jacobian(const ArmPose& at, double length) {
  auto J = tip_jacobian(at);
  J.bottomRows<3>() *= length;
  return J;
}

}  // namespace

bool is_four_axis(const SerialArm& arm) {
  bool fits = arm.links.size() == 4 && is_along_z(arm.tip);
  for (std::size_t i = 0; fits && i < 4; ++i) {
    const Vector3d axis = i == 0 ? Vector3d::UnitZ() : Vector3d::UnitY();
    fits = is_along_z(arm.links[i].placement) && !arm.links[i].slides && (arm.links[i].axis - axis).norm() <= 1e-12;
  }
  return fits;
}

std::vector<Eigen::Vector4d> four_axis_postures(const SerialArm& arm, const Vector3d& tip, double pitch) {
  require_valid(arm);
  const auto [shoulder, upper, fore, hand] = four_axis_lengths(arm);
  if (!tip.allFinite() || !std::isfinite(pitch)) throw core::InputError("the tip's place or pitch is not a number");
  const Vector3d p = arm.base.inverse() * tip;
  const double reach_m = p.head<2>().norm();
  const double q1 = reach_m > 0.0 ? std::atan2(p.y(), p.x()) : 0.0;
  std::vector<Eigen::Vector4d> postures;
  double farthest = 0.0;
  for (const double side : {1.0, -1.0}) {  // the arm facing the place, then turned away from it
    const double r = side * reach_m - hand * std::sin(pitch);
    const double h = p.z() - shoulder - hand * std::cos(pitch);
    farthest = std::max(farthest, std::hypot(r, h));
    const double cosine = (r * r + h * h - upper * upper - fore * fore) / (2.0 * upper * fore);
    if (!(std::abs(cosine) <= 1.0 + 1e-12)) continue;
    const double elbow = std::acos(std::clamp(cosine, -1.0, 1.0));
    for (const double q3 : {elbow, -elbow}) {
      const double q2 = std::atan2(r, h) - std::atan2(fore * std::sin(q3), upper + fore * std::cos(q3));
      postures.emplace_back(within_a_turn(side > 0.0 ? q1 : q1 + std::numbers::pi), within_a_turn(q2), q3,
                            within_a_turn(pitch - q2 - q3));
      if (elbow == 0.0) break;
    }
  }
  if (postures.empty()) {
    std::ostringstream text;
    text << "the place (" << tip.x() << ", " << tip.y() << ", " << tip.z() << ") m at a pitch of " << pitch
         << " rad is out of reach: the wrist would lie " << farthest << " m from the second joint, and reaches "
         << std::abs(upper - fore) << " to " << upper + fore << " m";
    throw core::InputError(text.str());
  }
  return postures;
}

Reached reach(const SerialArm& arm, const Eigen::Isometry3d& target, const Eigen::VectorXd& start,
              const ReachOptions& options) {
  require_valid(arm);
  if (!target.matrix().allFinite()) throw core::InputError("the place that the tip is to reach is not a number");
  Reached result{.q = start};
  ArmPose at = pose(arm, result.q);
  Vector6d e = error_of(at, target, options.length);
  // The damping μ |e|² vanishes with the error, so that the last steps are Newton's and convergence is quadratic near a
  // regular posture; far away and near singular postures it bounds the step.
  double mu = 1e-3;
  for (int step = 0; step < options.most_steps && e.norm() > options.tolerance; ++step) {
    // The step is made from singular values of J, because J Jᵀ would lose half of the digits near a singular posture.
    const Eigen::JacobiSVD<Eigen::MatrixXd> J(scaled_jacobian(at, options.length),
                                              Eigen::ComputeThinU | Eigen::ComputeThinV);
    const Eigen::ArrayXd s = J.singularValues();
    const Eigen::VectorXd damped = s / (s.square() + mu * e.squaredNorm());
    const Eigen::VectorXd q = result.q - J.matrixV() * (damped.asDiagonal() * (J.matrixU().transpose() * e));
    const ArmPose there = pose(arm, q);
    const Vector6d e_there = error_of(there, target, options.length);
    if (e_there.norm() < e.norm()) {
      result.q = q;
      at = there;
      e = e_there;
      mu = std::max(0.2 * mu, 1e-12);
    } else {
      mu *= 8.0;
    }
  }
  result.position_error = e.head<3>().norm();
  result.rotation_error = e.tail<3>().norm() / options.length;
  const Eigen::VectorXd singular =
      Eigen::JacobiSVD<Eigen::MatrixXd>(scaled_jacobian(at, options.length)).singularValues();
  result.smallest_singular = singular(singular.size() - 1) / singular(0);
  if (!(e.norm() <= options.tolerance)) return result;
  result.status = result.smallest_singular < options.singular_below ? ReachStatus::singular : ReachStatus::reached;
  return result;
}

}  // namespace thinwall::robot
