#include "tests/measurement/synthetic_measurement.hpp"

#include <complex>
#include <locale>
#include <random>
#include <sstream>

#include "core/atomic_file.hpp"
#include "reduction/trust/full_response.hpp"
#include "setup/robot_tip.hpp"
#include "study/support/support_stage.hpp"

namespace thinwall::tests {

using namespace setup;
using namespace cases;
using namespace study;

SyntheticMeasurement synthetic_measurement(const Setup& source, const PartResult& part, const std::string& point) {
  const fem::Factored factored = fem::factorise(part.model);
  SyntheticMeasurement result;
  result.axis = frequency_axis(source.response);
  const auto& damping = std::get<ModalDamping>(source.damping);
  const auto full = reduction::full_response(part.model.K, part.model.M, fem::inverse_of(factored), part.modes.pairs,
                                             damping.ratios, damping.ratio, part.interface, result.axis);
  result.part = dynamics::entry(full.response, point + ".x", point + ".x");
  result.relative_residual = full.max_relative_residual;
  const std::string tip = source.robot->point + ".x";
  result.robot = dynamics::entry(
      robot_component(*source.robot, result.axis, robot_posture(source, source).posture).response, tip, tip);
  return result;
}

Eigen::VectorXcd with_noise(Eigen::VectorXcd H, double level, std::uint32_t seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  for (auto& h : H) {
    const double a = normal(generator);
    const double b = normal(generator);
    h *= std::complex<double>(1.0 + level * a, level * b);
  }
  return H;
}

void write_measurement(const std::filesystem::path& path, const std::string& header,
                       const dynamics::FrequencyAxis& axis, const Eigen::VectorXcd& H) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(9);
  text << header << "frequency_hz,real_m_per_n,imaginary_m_per_n\n";
  for (Eigen::Index i = 0; i < axis.size(); ++i) {
    text << axis.hz(i) << ',' << H(i).real() << ',' << H(i).imag() << '\n';
  }
  core::write_file_atomically(path, text.str());
}

}  // namespace thinwall::tests
