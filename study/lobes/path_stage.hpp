#pragma once
// Stability charts along a path: what the cut feels changes with its position.

#include <vector>

#include "linalg/eigenpairs.hpp"
#include "setup/machining_setup.hpp"
#include "setup/path.hpp"
#include "study/kept/checkpoint.hpp"
#include "study/results.hpp"

namespace thinwall::study {

/// All that the charts along a path follow from, beside the results of the earlier stages.
struct PathInput {
  setup::PartSetup part;
  setup::SupportSetup support;
  setup::CutSetup cut;
  std::vector<setup::PathStation> stations;
  bool robot_follows = false;  ///< the robot's contacts keep their distance to the cut; else they stay
};

/// The path's input of a set-up that has one. Errors as setup::stations().
[[nodiscard]] PathInput path_input(const setup::Setup& source);

/// Charts at every position: the part alone, and with the robot at its contacts where that is known by its matrices.
/// A position costs an eigen-problem of the reduced size beside its chart. `results` must hold the models along the
/// path. Charts that are kept are taken, others kept once they are there. Throws as milling::lobe_field.
[[nodiscard]] std::vector<PathLobes> lobes_along_path(const PathInput& input, const Results& results, Checkpoint& kept);

}  // namespace thinwall::study
