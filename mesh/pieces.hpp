#pragma once
// The connected pieces of a mesh (core/pieces.hpp).

#include "core/pieces.hpp"

namespace thinwall::mesh {

using core::pieces;

}  // namespace thinwall::mesh
