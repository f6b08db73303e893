#pragma once
// The structures of which a run makes stability charts, and their words in files.

#include "setup/simulation.hpp"

namespace thinwall::study {

/// The structure that a chart is of.
using ChartOf = setup::CutOn;

}  // namespace thinwall::study
