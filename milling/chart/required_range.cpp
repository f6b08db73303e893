#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/error.hpp"
#include "milling/chart/sampled_stability.hpp"

namespace thinwall::milling {

namespace {

/// 0 if there is none.
double highest_resonance_hz(const SampledReceptance& r) {
  Resonance highest;
  for (const Resonance& found : resonances(r)) {
    if (found.size > highest.size) highest = found;
  }
  return highest.frequency_hz;
}

/// Throws InputError unless lines from `first` to `last` hold what lies one tooth passing beside a resonance, all in
/// Hz.
void require_neighbours(double first, double last, double resonance, double spindle_speed_rpm, double passing) {
  const double above = resonance + passing;
  const double below = std::abs(resonance - passing);
  const bool reaches_down = first <= below || first <= 0.5 * resonance;
  if (last >= above && reaches_down) return;
  std::ostringstream text;
  text << "receptance at the cut: lines from " << first << " to " << last << " Hz do not hold the harmonic at "
       << (last < above ? above : below) << " Hz, one tooth passing (" << passing << " Hz at " << spindle_speed_rpm
       << " rpm) " << (last < above ? "above" : "beside") << " the resonance at " << resonance << " Hz; measure from "
       << std::min(first, 0.5 * resonance) << " to " << std::max(last, above) << " Hz"
       << (last < above ? ", or ask for lower speeds" : "");
  throw core::InputError(text.str());
}

}  // namespace

void require_range(const SampledReceptance& receptance, const MillingProcess& process, double spindle_speed_rpm) {
  require_range(receptance, process, std::vector<double>{spindle_speed_rpm});
}

void require_range(const SampledReceptance& receptance, const MillingProcess& process,
                   const std::vector<double>& spindle_speeds_rpm) {
  require_usable(receptance);
  const double first = receptance.frequency_hz(0);
  const double last = receptance.frequency_hz(receptance.frequency_hz.size() - 1);
  const double resonance = highest_resonance_hz(receptance);
  if (resonance == 0.0) {
    std::ostringstream text;
    text << "receptance at the cut: lines from " << first << " to " << last
         << " Hz hold no resonance, the one that chatters must lie among them; measure a wider range";
    throw core::InputError(text.str());
  }
  for (const double rpm : spindle_speeds_rpm)
    require_neighbours(first, last, resonance, rpm, 1.0 / tooth_period_s(process.cutter, rpm));
}

}  // namespace thinwall::milling
