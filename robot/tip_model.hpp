#pragma once
// The model of a robot's tip, independent of its origin: the only form in which a coupling uses a robot.

#include <Eigen/Core>
#include <functional>
#include <utility>
#include <variant>

#include "dynamics/modal_model.hpp"
#include "dynamics/response_model.hpp"
#include "dynamics/spatial_model.hpp"

namespace thinwall::robot {

/// The posture of a robot and the load on its tip.
struct Posture {
  Eigen::VectorXd q{};                                ///< joint angles at rest, rad; empty if nothing depends on them
  Eigen::Vector3d preload = Eigen::Vector3d::Zero();  ///< constant force on the tip, N, world axes
};

/// The tip at one posture in the most complete form available: matrices, else poles, else receptances.
using Tip = std::variant<dynamics::SpatialModel, dynamics::ModalModel, dynamics::ResponseModel>;

/// A robot as a function that gives the tip at any posture. It throws InputError for a posture that the robot cannot
/// take.
using TipModel = std::function<Tip(const Posture&)>;

/// A robot whose tip was modelled or measured in one posture only and is used for all postures; callers should report
/// that.
[[nodiscard]] inline TipModel in_one_posture(Tip tip) {
  return [tip = std::move(tip)](const Posture&) { return tip; };
}

}  // namespace thinwall::robot
