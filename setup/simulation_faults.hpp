#pragma once
// The structures that a simulation is of, and the reasons why one cannot be simulated.

#include <string>
#include <vector>

#include "setup/machining_setup.hpp"

namespace thinwall::setup {

/// The structures that setup.simulation is of: those that it names, else all that the set-up has. A robot that is a
/// multibody arm has but the tool that it carries.
[[nodiscard]] std::vector<CutOn> simulated_structures(const Setup& source);

/// The reason why a structure cannot be simulated in this set-up, with the remedy; empty if there is none.
[[nodiscard]] std::string fault_of_structure(const Setup& source, CutOn structure);

/// The reason why the contact of the support cannot be one that opens: it must be the only one, along one direction, of
/// a finite stiffness, pressed from a known side. Empty if there is none, or if nothing shall open.
[[nodiscard]] std::string fault_of_opening(const Setup& source);

/// The reason why the robot cannot be a multibody arm that feeds through the cut: it must be an arm of flexible joints
/// that carries a rigid tool into a rigid part, from a border. Empty if there is none, or if it shall not be one.
[[nodiscard]] std::string fault_of_arm(const Setup& source);

}  // namespace thinwall::setup
