#pragma once
// An arm with flexible joints, linearised about a posture in which it rests: small vibrations of its tip.

#include <Eigen/Core>
#include <string>

#include "robot/serial_arm.hpp"
#include "robot/tip_model.hpp"

namespace thinwall::robot {

/// The spatial model of an arm over its joints' angles and distances δq and, for each motor that is not locked, the
/// motor's angle δθ referred to the joint's side (Huynh 2017, Eq. 7-8; Spong 1987; linearised: docs/theory/robots.md):
///
///     M = [ M(q)  0 ; 0  r²J ],   C = [ d  −d ; −d  d + k_d ],
///     K = [ k + ∂(G + W)/∂q − ∂(J_tipᵀf)/∂q   −k ; −k   k + k_p ]
///
/// with k, d, k_p, k_d, r²J diagonal and W the counterbalances' torque; a locked motor has no row. Of a rotor, only the
/// kinetic energy of its own spin is counted. The DOFs are the tip's x, y, z, rx, ry, rz in world axes under the name
/// `point`, T = [ J_tip 0 ].
///
/// The joints carry weight, counterbalances and preload at rest, so that q is the posture under these loads. Coriolis
/// terms vanish at rest. The receptance of a tip on fewer than six joints has a rank of their number: it may be
/// coupled, but not inverted. Throws InputError for a faulty arm, a posture of another size or not finite, a singular M
/// (links without mass), or K that is not positive definite (the arm would fall; the joint that gives most is named).
/// Cost O(joints³).
[[nodiscard]] dynamics::SpatialModel linearised(const SerialArm& arm, const Posture& posture, const std::string& point);

/// The robot as a function that gives linearised() at any posture.
[[nodiscard]] TipModel flexible_joints(SerialArm arm, std::string point);

}  // namespace thinwall::robot
