#include "app/self_test.hpp"

#include <chrono>
#include <cmath>
#include <exception>
#include <numbers>

#include "app/stage_display.hpp"
#include "case/reader.hpp"
#include "core/error.hpp"
#include "study/part/discretisation.hpp"
#include "study/part/part_stage.hpp"

namespace thinwall::app {

namespace {

// Without lateral contraction the clamp does what beam theory says of it.
constexpr auto cantilever = R"([part]
length = "200 mm"
height = "10 mm"
thickness = "10 mm"
[part.material]
youngs_modulus = "210 GPa"
poisson_ratio = 0
density = "7850 kg/m^3"
[part.mesh]
element_size = "20 mm"
order = 3
[[part.supports]]
on = "y_min"
[modes]
count = 2
verify = true
)";

double cantilever_hz() {
  constexpr double beta_l = 1.87510407, length = 0.2, height = 0.01, modulus = 210e9, density = 7850.0;
  return beta_l * beta_l / (2.0 * std::numbers::pi * length * length) *
         std::sqrt(modulus * height * height / (12.0 * density));
}

}  // namespace

bool SelfTest::ok() const {
  return failure.empty() && std::abs(found_hz / expected_hz - 1.0) <= 0.01;
}

SelfTest self_test() {
  const auto start = std::chrono::steady_clock::now();
  SelfTest test;
  test.expected_hz = cantilever_hz();
  try {
    const cases::Case source = cases::parse_case(cantilever, ".");
    study::Stages stages;
    const fem::Modes modes = study::solved_part(source, study::discretise(study::part_input(source)), stages).modes;
    test.found_hz = modes.frequency_hz(0);
    test.mode_difference = modes.check.value().largest_difference;
  } catch (const core::Interrupted&) {
    throw;
  } catch (const std::exception& error) {
    test.failure = error.what();
  }
  test.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return test;
}

}  // namespace thinwall::app
