#pragma once
// Measured FRFs that nobody measured: receptances of the full model, with noise of a stated level and seed.

#include <complex>
#include <cstdint>
#include <fstream>
#include <iomanip>
#include <random>
#include <string>

#include "app/part_stage.hpp"
#include "app/stages.hpp"
#include "app/support_stage.hpp"
#include "reduction/full_response.hpp"

namespace thinwall::testing_support {

/// Driving-point receptances of part and robot along x, m/N.
struct SyntheticMeasurement {
  dynamics::FrequencyAxis axis;
  Eigen::VectorXcd part;
  Eigen::VectorXcd robot;
  double relative_residual = 0.0;  ///< of the full model's equations
};

/// From the full (unreduced) model of the case's part and the case's robot mode, on the case's axis.
inline SyntheticMeasurement measure(const app::Case& source, const app::PartResult& part, const std::string& point) {
  const fem::Factored factored = fem::factorise(part.model);
  SyntheticMeasurement result;
  result.axis = app::frequency_axis(source);
  const auto full = reduction::full_response(part.model.K, part.model.M, fem::inverse_of(factored), part.modes.pairs,
                                             source.damping.ratios, source.damping.ratio, part.interface, result.axis);
  result.part = dynamics::entry(full.response, point + ".x", point + ".x");
  result.relative_residual = full.max_relative_residual;
  const auto robot = app::robot_component(source, result.axis);
  const std::string tip = source.robot->point + ".x";
  result.robot = dynamics::entry(robot.response, tip, tip);
  return result;
}

/// H (1 + level (a + ib)), a and b standard normal and independent from line to line.
inline Eigen::VectorXcd with_noise(Eigen::VectorXcd H, double level, std::uint32_t seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  for (auto& h : H) {
    const double a = normal(generator);
    const double b = normal(generator);
    h *= std::complex<double>(1.0 + level * a, level * b);
  }
  return H;
}

/// frequency_hz, real, imaginary under a header that says what the file is.
inline void write_measurement(const std::string& path, const std::string& header, const dynamics::FrequencyAxis& axis,
                              const Eigen::VectorXcd& H) {
  std::ofstream file(path);
  file.imbue(std::locale::classic());
  file << header << "frequency_hz,real_m_per_n,imaginary_m_per_n\n" << std::setprecision(9);
  for (Eigen::Index i = 0; i < axis.size(); ++i) file << axis.hz(i) << ',' << H(i).real() << ',' << H(i).imag() << '\n';
}

}  // namespace thinwall::testing_support
