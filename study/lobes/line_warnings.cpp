#include "study/lobes/line_warnings.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/messages.hpp"
#include "milling/direct/passivity.hpp"

namespace thinwall::study {

void warn_of_energy(const milling::SampledReceptance& lines, const std::string& whose) {
  if (const auto doubt = milling::energy_given(lines)) {
    core::warn(fmt::format(
        "{3} FRF along {0}{0} gives energy at {1:.1f} Hz (its imaginary part is {2:.2f} of its size and positive, a "
        "passive structure's is not): check sign convention, quantity and unit",
        "xyz"[doubt->direction], doubt -> frequency_hz, doubt -> share, whose));
  }
}

void warn_of_growing_motion(const std::optional<std::complex<double>>& pole, const std::string& whose) {
  if (!pole) return;
  core::warn(fmt::format(
      "{} lines have a motion at {:.1f} Hz that grows by itself (damping {:.2g} %), which no passive structure has; "
      "the chart takes it as decaying: check the signs and directions of what was measured",
      whose, std::abs(*pole) / (2.0 * std::numbers::pi), -100.0 * pole->real() / std::abs(*pole)));
}

}  // namespace thinwall::study
