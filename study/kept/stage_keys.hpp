#pragma once
// The keys under which results of the stages are kept: each follows from the bytes of the stage's input, so that a
// stage cannot read what is not in its key.

#include <string>
#include <vector>

#include "setup/machining_setup.hpp"
#include "study/part/part_input.hpp"

namespace thinwall::study {

/// The key of the part as it is meshed, fitted, solved and reduced (PartResult less its damping). Damping belongs to it
/// only where the number of modes, a fit or the part's own matrices follow from it. `fits`: those of the part.
[[nodiscard]] std::string part_key(PartInput input, const std::vector<setup::Updating>& fits);

/// The key of a set-up's part, with its fits. Errors as part_input().
[[nodiscard]] std::string part_key(const setup::Setup& source);

/// The key of the fit of a measured tool: its files and lines. Empty where none is asked for.
[[nodiscard]] std::string tool_key(const setup::CutSetup& source);

/// The key of a robot's modes that are learned: its postures, their tables, an arm that is their mean, and the posture
/// that is asked for. Empty where none are.
[[nodiscard]] std::string robot_key(const setup::Setup& source);

/// The key of part, robot and their receptances: everything but the cut and the charts. Errors as part_input().
[[nodiscard]] std::string structure_key(const setup::Setup& source);

/// The key of the charts' rows: everything but the machine's limits and the cut's own speed. The speed belongs to it
/// where a force law asks for the feed of a tooth, which follows from it. Errors as part_input().
[[nodiscard]] std::string charts_key(const setup::Setup& source);

/// The key of simulated points and maps, which tells neither the points nor the structures: they are the names of what
/// is kept. The case's own speed belongs to it as far as the feed follows from it. Errors as part_input().
[[nodiscard]] std::string simulation_key(const setup::Setup& source);

}  // namespace thinwall::study
