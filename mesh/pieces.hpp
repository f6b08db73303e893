#pragma once
// Which vertices hang together: core/pieces.hpp.

#include "core/pieces.hpp"

namespace thinwall::mesh {

using core::pieces;

}  // namespace thinwall::mesh
