// The prediction from two FRF files against the prediction from the model that they were made with.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "app/case_run.hpp"
#include "case/reader.hpp"
#include "io/frf/response_csv.hpp"
#include "setup/robot_tip.hpp"
#include "study/part/part_stage.hpp"
#include "study/stages.hpp"
#include "study/support/support_stage.hpp"
#include "tests/measurement/synthetic_measurement.hpp"
#include "tests/system/run_in_folder.hpp"

namespace thinwall::tests::measured_files_test {

using namespace app;

namespace {

namespace fs = std::filesystem;

const fs::path shipped = fs::path(THINWALL_SOURCE_DIR) / "cases";

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(MeasuredCase, NoiseFreeFilesGiveTheModelsPredictionWithinAThousandthOfThePeak) {
  cases::Case model =
      cases::read_case(shipped / "barrios-2019", {"part.mesh.element_size=25 mm", "response.from=1 Hz",
                                                  "response.to=1000 Hz", "response.lines=1999", "reduction.modes=40"});
  model.updating.clear();
  study::Stages stages;
  const study::PartInput input = study::part_input(model);
  const study::PartResult part = study::compute_part(input, study::discretise(input), stages);
  const auto axis = study::frequency_axis(model.response);
  const study::Component part_component = study::component(*part.damped, axis);
  const study::Component robot = study::robot_component(*model.robot, axis, setup::robot_posture(model, model).posture);
  const auto contacts = study::contacts_of(setup::joined_contacts(model, model));
  const auto predicted =
      dynamics::entry(study::couple(contacts, {}, part_component, robot).receptance.response, "P.x", "P.x");

  const auto files = synthetic_measurement(model, part, "P");
  EXPECT_LT(files.relative_residual, 1e-7) << "the full model is solved, not approximated";
  const fs::path folder = scratch("measured_noise_free");
  std::ofstream(folder / "case.toml") << text_of(shipped / "barrios-2019-measured" / "case.toml");
  write_measurement(folder / "part_xx.csv", "# noise-free\n", files.axis, files.part);
  write_measurement(folder / "robot_xx.csv", "# noise-free\n", files.axis, files.robot);
  const cases::Case measured = cases::read_case(folder, {});
  const fs::path out = scratch("measured_noise_free_out");
  static_cast<void>(run_case(measured, {out, true, -1, false}));
  const auto G = dynamics::entry(io::read_response(out / "frf" / "coupled_receptance.csv"), "P.x", "P.x");
  ASSERT_EQ(G.size(), predicted.size());
  const double difference = (G - predicted).cwiseAbs().maxCoeff() / predicted.cwiseAbs().maxCoeff();
  std::printf("measured files against model: %.2e of the peak\n", difference);
  EXPECT_LE(difference, 1e-3);
}

TEST(MeasuredCase, TheCommittedFilesSayWhatTheyAreAndMeetTheCasesExpectations) {
  for (const char* name : {"part_xx.csv", "robot_xx.csv"}) {
    const std::string text = text_of(shipped / "barrios-2019-measured" / name);
    EXPECT_NE(text.find("# synthetic"), std::string::npos) << name;
    EXPECT_NE(text.find("seed"), std::string::npos) << name;
  }
  const RunResult run = run_case(cases::read_case(shipped / "barrios-2019-measured", {}),
                                 {scratch("measured_committed"), true, -1, false});
  EXPECT_TRUE(run.expectations_hold) << summary_json(run.summary)["checks"].dump(2);
}

}  // namespace
}  // namespace thinwall::tests::measured_files_test
