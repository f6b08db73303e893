#pragma once
// The input of the part's stage.

#include <vector>

#include "setup/path.hpp"

namespace thinwall::study {

/// All that mesh, modes and reduction of a part follow from.
struct PartInput : setup::PartSetup {
  std::vector<setup::PathStation> path;  ///< where the reduced part is wanted, too; empty: no path
};

/// The part's input of a set-up. Errors as setup::stations().
[[nodiscard]] inline PartInput part_input(const setup::Setup& source) {
  return {source, setup::stations(source)};
}

}  // namespace thinwall::study
