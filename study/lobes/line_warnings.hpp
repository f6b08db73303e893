#pragma once
// Warnings of lines that no passive structure has.

#include <complex>
#include <optional>
#include <string>

#include "milling/direct/sampled_receptance.hpp"

namespace thinwall::study {

/// Warns of a direction along which lines give energy (milling::energy_given()). `whose` begins the message, as in "the
/// tool's".
void warn_of_energy(const milling::SampledReceptance& lines, const std::string& whose);

/// Warns of a motion that grows by itself, the pole of a fit (milling::FittedLines::growing), rad/s, if there is one.
void warn_of_growing_motion(const std::optional<std::complex<double>>& pole, const std::string& whose);

}  // namespace thinwall::study
