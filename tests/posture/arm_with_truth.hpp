#pragma once
// An arm that a test knows: six joints, tapped at the tip and at a point up the tool.

#include <cmath>
#include <random>
#include <vector>

#include "posture/arm_modes.hpp"
#include "posture/tapped_posture.hpp"

namespace thinwall::posture::testing {

inline robot::Link link(const char* name, const Eigen::Vector3d& before, const Eigen::Vector3d& axis, double mass,
                        const Eigen::Vector3d& centre, double inertia, double stiffness, double damping) {
  robot::Link result;
  result.name = name;
  result.placement.translation() = before;
  result.axis = axis;
  result.mass = mass;
  result.centre = centre;
  result.inertia = Eigen::Vector3d(inertia, 1.2 * inertia, 0.8 * inertia).asDiagonal();
  result.joint.stiffness = stiffness;
  result.joint.damping = damping;
  return result;
}

/// An elbow arm whose last joint turns about z, so that its tip keeps upright where q2 + q3 + q4 = 0.
inline TappedArm elbow_arm() {
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY(), z = Eigen::Vector3d::UnitZ();
  TappedArm tapped;
  tapped.arm.links = {link("column", {0, 0, 0.3}, z, 400, {0.1, 0, 0.3}, 25, 2.2e6, 2000),
                      link("upper", {0.3, 0, 0.5}, y, 240, {0, 0.05, 0.5}, 30, 4.2e6, 4000),
                      link("forearm", {0, 0, 1.1}, y, 200, {0.4, -0.04, 0.1}, 20, 3.2e6, 3000),
                      link("wrist", {0.9, 0, 0.1}, y, 60, {0.1, 0.02, 0}, 2, 1.0e6, 500),
                      link("spindle", {0.2, 0, 0}, z, 40, {0.05, 0.02, -0.1}, 1, 0.5e6, 150)};
  tapped.arm.tip.translation() = Eigen::Vector3d(0.15, 0.0, -0.4);
  tapped.responses = Eigen::MatrixXd::Zero(4, 6);
  tapped.responses(0, 0) = tapped.responses(1, 1) = tapped.responses(2, 0) = tapped.responses(3, 1) = 1.0;
  tapped.responses(2, 4) = 0.05;
  tapped.responses(3, 3) = -0.05;
  tapped.references = tapped.responses;
  return tapped;
}

/// A posture with an upright tip: coordinates u in [−1, 1].
inline Eigen::VectorXd elbow_posture(const Eigen::Vector3d& u) {
  const double shoulder = 0.2 + 0.25 * u.x(), elbow = 0.5 - 0.2 * u.x();
  Eigen::VectorXd q(5);
  q << 0.4 * u.y(), shoulder, elbow, -shoulder - elbow, 0.8 * u.z();
  return q;
}

/// The arm with other stiffnesses, dampings and masses than its maker says: what is measured.
inline TappedArm true_arm() {
  TappedArm tapped = elbow_arm();
  const std::vector<double> of_stiffness = {1.12, 0.88, 1.2, 0.85, 1.1}, of_damping = {1.3, 0.8, 1.2, 0.7, 1.4};
  for (std::size_t i = 0; i < 5; ++i) {
    tapped.arm.links[i].joint.stiffness *= of_stiffness[i];
    tapped.arm.links[i].joint.damping *= of_damping[i];
  }
  return tapped;
}

inline std::vector<Eigen::Vector3d> spread_places(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Eigen::Vector3d> places;
  for (int i = 0; i < count; ++i) {
    Eigen::Vector3d u;
    for (double& v : u) v = 2.0 * static_cast<double>(random()) / static_cast<double>(std::mt19937::max()) - 1.0;
    places.push_back(u);
  }
  return places;
}

inline Place place_of(const TappedArm& tapped, const Eigen::Vector3d& u) {
  Place place{u, elbow_posture(u), {}};
  place.turn = tip_turn(tapped, place.q);
  return place;
}

/// The modes of the arm at places, labelled by following those of the first place.
inline std::vector<TappedPosture> tapped_postures(const TappedArm& tapped, const std::vector<Eigen::Vector3d>& places) {
  std::vector<TappedPosture> postures;
  for (const Eigen::Vector3d& u : places) {
    TappedPosture posture{place_of(tapped, u), as_identified(arm_modes(tapped.arm, elbow_posture(u)), tapped), {}};
    const std::vector<int> now = followed(tapped.arm, elbow_posture(Eigen::Vector3d::Zero()), posture.place.q, 20);
    posture.label.resize(posture.modes.size());
    for (std::size_t k = 0; k < now.size(); ++k) posture.label[static_cast<std::size_t>(now[k])] = static_cast<int>(k);
    postures.push_back(posture);
  }
  return postures;
}

}  // namespace thinwall::posture::testing
