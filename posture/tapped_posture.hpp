#pragma once
// Postures of a machine or robot, and the modes that were identified there.

#include <Eigen/Core>
#include <vector>

#include "identification/modal_fit.hpp"

namespace thinwall::posture {

/// A rotation of measured vectors into the tip's frame: there the modes of a spindle hardly change with the posture,
/// while those of the arm are best seen in the world's.
struct Turn {
  Eigen::MatrixXd responses{};   ///< orthonormal, of the responses; empty: no frame but the world's is known
  Eigen::MatrixXd references{};  ///< of the references
};

/// A place of the tip and the posture that brings it there.
struct Place {
  Eigen::VectorXd at;   ///< coordinates over which to regress, scaled to the order of 1
  Eigen::VectorXd q{};  ///< of the arm's joints, rad (m); empty where no arm's model is used
  Turn turn{};          ///< tip_turn() of an arm
};

/// A posture at which the structure was tapped.
struct TappedPosture {
  Place place;
  std::vector<identification::FittedMode> modes;  ///< with left and right vectors
  std::vector<int> label{};                       ///< of each mode, from 0 on, as identification::track() gives them
  Eigen::MatrixXd
      rest{};  ///< static compliance that the modes leave out, m/N, responses × references; empty: not known
};

}  // namespace thinwall::posture
