#pragma once
// The whole workflow: from a machining set-up to everything that can be computed of it.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "fem/closed_part.hpp"
#include "milling/chart/operating_point.hpp"
#include "setup/variation.hpp"
#include "study/kept/checkpoint.hpp"
#include "study/results.hpp"
#include "study/stages.hpp"

namespace thinwall::study {

/// Options of a run.
struct RunOptions {
  std::vector<milling::OperatingPoint> points = {};    ///< that every chart is asked about, and that a simulation takes
                                                       ///< which names none
  StageListener on_stage = {};                         ///< hears of each stage as it begins and ends
  std::shared_ptr<const fem::FirstMesh> first_mesh{};  ///< of the part, as first_mesh() makes it; empty: it is made
};

/// Results of an earlier run of the same inputs, which are taken instead of being computed, and to which new ones are
/// added. A default Checkpoint keeps nothing and finds nothing.
struct Kept {
  Checkpoint part, structure, charts, simulations;
  Checkpoint tool{}, robot{};  ///< what was identified of them
};

/// Computes what the set-up holds: what is identified from measurements (setup::identify()), the part (mesh, modes,
/// reduction), fits of its numbers by `variation`, receptances of part and robot, both joined by two routes, the error
/// budget, stability charts, and simulated points. Messages go to core::set_message_listener, the progress of long
/// loops to core::set_progress_listener. A set-up without fits needs no `variation`. Throws core::Error: InputError for
/// what cannot be computed, NumericalError where a stage does not converge, Interrupted after
/// core::request_interrupt().
[[nodiscard]] Results run(const setup::Setup& setup, const setup::Variation& variation, Kept& kept,
                          const RunOptions& options);

}  // namespace thinwall::study
