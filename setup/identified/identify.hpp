#pragma once
// Models of a set-up that are found from measurements before a chart is computed: a fitted tool, a robot that is
// learned from postures.

#include <Eigen/Core>
#include <cstddef>

#include "setup/machining_setup.hpp"

namespace thinwall::setup {

/// True if modes are to be fitted to a measured tool (`tool.fit`) and are not yet.
[[nodiscard]] bool awaits_fit(const CutSetup& source);

/// True if a robot's modes are to be learned from postures and are not yet.
[[nodiscard]] bool awaits_learning(const SupportSetup& source);

/// The joints q (rad, m), at the posture that is asked for, of the arm that is the mean of a robot's learned modes: by
/// the columns of robot.over, else by its own posture (wished_joints(), whose errors it has). Empty without an arm.
[[nodiscard]] Eigen::VectorXd asked_joints(const Setup& source, const TabledRobot& robot);

/// Fits the tool (fitted_tip()) and learns the robot's modes (learned_modes()) where that is asked for and not done,
/// and gives a tool that is swapped in at the robot's modes these (give_modes_to_swap()). Errors as theirs; those of
/// the fit name tool.fit. Cost: theirs.
void identify(Setup& source);

/// Modes over the DOFs of a robot's tables as a tool that is swapped in at them takes them: those of the tip and the
/// point up, by the names of the swap, in the part's axes. Errors as used_part().
[[nodiscard]] dynamics::ModalTable modes_for_swap(const TabledRobot& robot, const dynamics::ModalTable& modes,
                                                  const ToolSwap& swap);

/// Gives a tool that is swapped in at the robot's modes those of the robot's table, in the part's axes; does nothing of
/// another tool, or where the table is not known yet.
void give_modes_to_swap(CutSetup& cut, const SupportSetup& support);

/// Sends what was identified, and what speaks against it, as messages (core/messages.hpp).
void tell_of_identified(const Setup& source);

/// The number of draws that stand beside what was identified; 0 where nothing was.
[[nodiscard]] std::size_t draws_of(const Setup& source);

/// Puts draw `i` of what was identified, below draws_of(), in place of the models of tool and robot; a tool that is
/// swapped in at the robot's modes has those of the draw.
void take_draw(std::size_t i, CutSetup& cut, SupportSetup& support);

}  // namespace thinwall::setup
