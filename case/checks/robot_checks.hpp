#pragma once
// Checks of [robot] and of where it touches.

#include <optional>
#include <vector>

#include "case/checks/findings.hpp"
#include "case/machining_case.hpp"

namespace thinwall::cases {

/// The keys of its model, the arm's bodies and joints, and that it can stand as it is asked to.
void check_robot(const Case& source, Findings& findings);

/// Directions in which the tip can be held; empty where the case does not tell.
[[nodiscard]] std::vector<Eigen::Vector3d> tip_directions(const setup::Robot& robot);

/// The reason why the robot cannot stand as the case asks it to; empty if nothing, or where the case does not tell. A
/// search starts from the joints `near`, if there are, which then are those found.
[[nodiscard]] std::string fault_of_posture(const setup::PartSetup& part, const setup::SupportSetup& support,
                                           std::optional<Eigen::VectorXd>& near);

}  // namespace thinwall::cases
