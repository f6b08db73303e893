// Makes the files of cases/barrios-2019-measured from the fitted model of cases/barrios-2019:
//     measured_files cases/barrios-2019 cases/barrios-2019-measured

#include <cstdio>

#include "case/reader.hpp"
#include "study/part/part_stage.hpp"
#include "study/stages.hpp"
#include "tests/measurement/synthetic_measurement.hpp"
#include "study/updating.hpp"

int main(int argc, char** argv) {
  using namespace thinwall;
  if (argc != 3) {
    std::fprintf(stderr, "usage: measured_files MODEL_CASE OUTPUT_FOLDER\n");
    return 2;
  }
  constexpr double level = 0.005;
  cases::Case source = cases::read_case(argv[1], {"response.from=1 Hz", "response.to=1000 Hz", "response.lines=1999"});
  study::Stages stages(ProgressDisplay::none);
  study::Discretisation discretisation = study::discretise(source);
  discretisation.solved.reset();  // the fit changes the part
  const Eigen::Vector3d meshed = setup::box_size(*source.part);
  const auto fits = source.updating;
  for (const auto& fit : fits) {
    if (fit.on == "part") static_cast<void>(study::update_part(source, fit, discretisation.mesh, discretisation.order));
  }
  discretisation.mesh = study::stretched(std::move(discretisation.mesh), meshed, setup::box_size(*source.part));
  const study::PartResult part = study::compute_part(source, std::move(discretisation), stages);
  for (const auto& fit : fits) {
    if (fit.on == "coupled") static_cast<void>(study::update_coupled(source, fit, part.reduced->model));
  }
  const auto files = tests::synthetic_measurement(source, part, "P");
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
  tests::write_measurement(folder + "/part_xx.csv", header("the part at P, full finite-element model", 2019), files.axis,
                         tests::with_noise(files.part, level, 2019));
  tests::write_measurement(folder + "/robot_xx.csv", header("the robot's tip, one mode", 2020), files.axis,
                         tests::with_noise(files.robot, level, 2020));
  std::printf("relative residual of the full model %.1e\n", files.relative_residual);
  return 0;
}
