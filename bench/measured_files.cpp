// Makes the files of cases/barrios-2019-measured from the fitted model of cases/barrios-2019:
//     measured_files cases/barrios-2019 cases/barrios-2019-measured

#include <cstdio>

#include "case/numbers.hpp"
#include "case/reader.hpp"
#include "study/part/part_stage.hpp"
#include "study/stages.hpp"
#include "study/updating.hpp"
#include "tests/measurement/synthetic_measurement.hpp"

int main(int argc, char** argv) {
  using namespace thinwall;
  if (argc != 3) {
    std::fprintf(stderr, "usage: measured_files MODEL_CASE OUTPUT_FOLDER\n");
    return 2;
  }
  constexpr double level = 0.005;
  // Small elements of low order, because 1999 direct solves of the usual mesh would take hours.
  const cases::Case source =
      cases::read_case(argv[1], {"part.mesh.element_size=16 mm", "part.mesh.order=2", "response.from=1 Hz",
                                 "response.to=1000 Hz", "response.lines=1999"});
  const setup::Variation variation = cases::variation_of(source);
  setup::VariedSetup fitted{source, {}};
  study::Stages stages;
  study::Discretisation discretisation = study::discretise(study::part_input(source));
  discretisation.solved.reset();  // the fit changes the part
  const Eigen::Vector3d meshed = setup::box_size(*source.part);
  for (const setup::Updating& fit : source.updating) {
    if (fit.on == setup::FitOf::part)
      static_cast<void>(study::update_part(variation, fitted, fit, discretisation.mesh, discretisation.order));
  }
  discretisation.mesh = study::stretched(std::move(discretisation.mesh), meshed, setup::box_size(*fitted.setup.part));
  const study::PartResult part =
      study::compute_part(study::part_input(fitted.setup), std::move(discretisation), stages);
  for (const setup::Updating& fit : source.updating) {
    if (fit.on == setup::FitOf::coupled)
      static_cast<void>(study::update_coupled(variation, fitted, fit, part.reduced->model));
  }
  const auto files = tests::synthetic_measurement(fitted.setup, part, "P");
  const auto header = [&](const char* what, unsigned seed) {
    char text[512];
    std::snprintf(text, sizeof text,
                  "# synthetic: %s along x, receptance in m/N, from the fitted model of cases/barrios-2019 "
                  "(bench/measured_files.cpp)\n"
                  "# every line times 1 + %g (a + ib), a and b standard normal, seed %u (std::mt19937)\n",
                  what, level, seed);
    return std::string(text);
  };
  const std::string folder = argv[2];
  tests::write_measurement(folder + "/part_xx.csv", header("the part at P, full finite-element model", 2019),
                           files.axis, tests::with_noise(files.part, level, 2019));
  tests::write_measurement(folder + "/robot_xx.csv", header("the robot's tip, one mode", 2020), files.axis,
                           tests::with_noise(files.robot, level, 2020));
  std::printf("relative residual of the full model %.1e\n", files.relative_residual);
  return 0;
}
