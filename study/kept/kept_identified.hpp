#pragma once
// The fit of a tool and the learned modes of a robot, kept and taken again.

#include "setup/variation.hpp"
#include "study/kept/checkpoint.hpp"

namespace thinwall::study {

/// Takes the fitted tool and the learned robot of earlier runs into the set-up, or identifies them now and keeps them
/// (setup::identify()). Each has a checkpoint of its own, whose key is tool_key() or robot_key(). Errors as
/// setup::identify().
void identify_or_take(Checkpoint& tool, Checkpoint& robot, setup::Setup& work);

/// The variation whose set-ups have what was identified; one that asks for another posture learns anew.
[[nodiscard]] setup::Variation identified_variation(const setup::Variation& variation, const setup::Setup& identified);

}  // namespace thinwall::study
