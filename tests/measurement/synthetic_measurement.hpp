#pragma once
// Measured FRFs that nobody measured: receptances of the full model, with noise of a stated level and seed. Cases that
// work from files are made and tested with them.

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>

#include "case/machining_case.hpp"
#include "study/results.hpp"

namespace thinwall::tests {

using namespace setup;
using namespace cases;
using namespace study;

/// Driving-point receptances of part and robot along x, m/N.
struct SyntheticMeasurement {
  dynamics::FrequencyAxis axis;
  Eigen::VectorXcd part;
  Eigen::VectorXcd robot;
  double relative_residual = 0.0;  ///< of the full model's equations
};

/// The measurement of the full (unreduced) model of the set-up's part at `point` and of its robot's mode, on its axis.
/// Errors as reduction::full_response.
[[nodiscard]] SyntheticMeasurement synthetic_measurement(const setup::Setup& source, const study::PartResult& part,
                                                         const std::string& point);

/// H (1 + level (a + ib)) line by line, a and b standard normal and independent, from std::mt19937 with this seed.
[[nodiscard]] Eigen::VectorXcd with_noise(Eigen::VectorXcd H, double level, std::uint32_t seed);

/// A CSV of frequency_hz, real and imaginary part (m/N, nine digits) below a header of comment lines that says what the
/// file is. Throws DataError if it cannot be written.
void write_measurement(const std::filesystem::path& path, const std::string& header,
                       const dynamics::FrequencyAxis& axis, const Eigen::VectorXcd& H);

}  // namespace thinwall::tests
