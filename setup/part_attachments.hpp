#pragma once
// What hangs on the part of a case, as the finite elements take it.

#include "case/case.hpp"
#include "fem/attachments.hpp"

namespace thinwall::setup {

/// Clamps on their faces; the points that carry masses or springs, or are rigid, with their patches; the masses and
/// springs themselves.
[[nodiscard]] fem::Attachments attachments_of(const cases::Case& source);

}  // namespace thinwall::setup
