#include "study/part/part_damping.hpp"

#include <limits>

namespace thinwall::study {

std::vector<double> part_damping_ratios(const Results& results) {
  const fem::Modes& modes = results.finite_elements->modes;
  std::vector<double> ratios(static_cast<std::size_t>(modes.frequency_hz.size()),
                             std::numeric_limits<double>::quiet_NaN());
  if (!results.part || !results.part->modal) return ratios;
  auto mode = static_cast<std::size_t>(modes.rigid_motions);
  for (const int k : dynamics::oscillating_modes(*results.part->modal)) {
    if (mode == ratios.size()) break;
    ratios[mode++] = dynamics::summarise(results.part->modal->poles(k)).damping_ratio;
  }
  return ratios;
}

}  // namespace thinwall::study
