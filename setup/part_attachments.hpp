#pragma once
// Masses, springs and clamps on the part of a set-up, as the finite elements take them.

#include "fem/attachments.hpp"
#include "setup/machining_setup.hpp"

namespace thinwall::setup {

/// Clamps on their faces; the points that carry masses or springs, or are rigid, with their patches; the masses and
/// springs themselves.
[[nodiscard]] fem::Attachments attachments_of(const PartSetup& source);

}  // namespace thinwall::setup
