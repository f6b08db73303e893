#pragma once
// Modes that stand in for a part's before they are computed.

#include <optional>

#include "milling/structure/relative_structure.hpp"
#include "setup/machining_setup.hpp"

namespace thinwall::study {

/// Modes as dense as those of a plate of the part's extent and thickness, 2 c_L t / (√12 A) apart (Cremer, Heckl &
/// Petersson 2005), each of a quarter of its mass: φ φᵀ / (2 i ω_d (iω − λ)) + conjugate. The plate of a prism is the
/// regions of one thickness whose modes are densest. The set-up must have a part.
[[nodiscard]] milling::RelativeStructure modes_like(const setup::Setup& source);

/// The set-up with models in place of those that are still to be identified: the robot as in its first posture, the
/// tool by its highest resonances.
[[nodiscard]] setup::Setup before_identification(setup::Setup source);

/// The modes at the cut that stand in for those of a part, part axes.
struct StandInModes {
  milling::RelativeStructure part;
  std::optional<milling::RelativeStructure> supported;  ///< of part and robot; none if they have no modes together
};

/// The modes that the cut feels, those of the tool and the given ones, or else modes_like(), for the part's; none if
/// neither has any.
[[nodiscard]] std::optional<milling::RelativeStructure> poles_like(
    const setup::Setup& source, const std::optional<milling::RelativeStructure>& of_part = {});

}  // namespace thinwall::study
