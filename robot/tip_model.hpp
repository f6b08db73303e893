#pragma once
// What is known of a robot's tip, however it came to be known: the one thing that a coupling asks of a robot.

#include <Eigen/Core>
#include <functional>
#include <utility>
#include <variant>

#include "dynamics/modal_model.hpp"
#include "dynamics/response_model.hpp"
#include "dynamics/spatial_model.hpp"

namespace thinwall::robot {

/// Where a robot stands and what it bears there.
struct Posture {
  Eigen::VectorXd q{};  ///< joint angles at rest, rad; empty where nothing depends on them
  Eigen::Vector3d preload = Eigen::Vector3d::Zero();  ///< force on the tip that stays as it is, N, world axes
};

/// The tip at one posture, by the most that is known: matrices, else poles, else receptances.
using Tip = std::variant<dynamics::SpatialModel, dynamics::ModalModel, dynamics::ResponseModel>;

/// A robot: the tip at any posture. An implementation throws InputError for a posture that it cannot take.
using TipModel = std::function<Tip(const Posture&)>;

/// A tip that was modelled or measured in one posture, and stands for all: whoever uses it elsewhere says so.
[[nodiscard]] inline TipModel in_one_posture(Tip tip) {
  return [tip = std::move(tip)](const Posture&) { return tip; };
}

}  // namespace thinwall::robot
