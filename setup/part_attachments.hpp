#pragma once
// What hangs on the part of a case, as the finite elements take it.

#include "fem/attachments.hpp"
#include "setup/machining_setup.hpp"

namespace thinwall::setup {

/// Clamps on their faces; the points that carry masses or springs, or are rigid, with their patches; the masses and
/// springs themselves.
[[nodiscard]] fem::Attachments attachments_of(const PartSetup& source);

}  // namespace thinwall::setup
