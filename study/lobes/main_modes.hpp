#pragma once
// The modes that a cut feels most.

#include <vector>

#include "study/lobes/cut_structure.hpp"

namespace thinwall::study {

/// Frequencies of at most four modes whose peaks are a tenth of the highest at least, ascending, Hz. A pole's peak is
/// ‖φ‖ ‖b‖ / |Re λ|, |λ|/2π its frequency; of samples it is what they show (milling::resonances).
[[nodiscard]] std::vector<double> main_modes_hz(const CutStructure& structure);

}  // namespace thinwall::study
