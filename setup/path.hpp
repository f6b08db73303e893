#pragma once
// A case with its cut moved along the path.

#include <cstddef>

#include "setup/machining_setup.hpp"

namespace thinwall::setup {

/// The case as it would be written for one position of its path: its points are the one that is cut, moved there with
/// its patch, and those of the contacts, moved by the same vector where the robot follows. These are the reduction's
/// interface, in this order; `cutting.at` and the contacts name them, one point for both where they coincide.
/// The case must have a path, a part and a known `cutting.at`; throws InputError for an unknown point.
[[nodiscard]] Setup at_position(const Setup& source, std::size_t position);

}  // namespace thinwall::setup
