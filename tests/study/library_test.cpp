// The workflow called as a library, against the same case through the command line's own run.

#include <gtest/gtest.h>

#include <filesystem>

#include "app/case_run.hpp"
#include "case/numbers.hpp"
#include "case/reader.hpp"
#include "core/messages.hpp"
#include "study/run.hpp"
#include "tests/core/temporary_folder.hpp"

namespace thinwall::tests::library_test {

namespace {

namespace fs = std::filesystem;

cases::Case default_case() {
  return cases::read_case(fs::path(THINWALL_SOURCE_DIR) / "cases" / "barrios-2019",
                          {"part.mesh.tolerance=0.05", "lobes.count=24"});
}

TEST(Library, GivesTheFiguresOfTheCommandLineToTheLastDigit) {
  const cases::Case source = default_case();
  study::Kept nothing;
  const study::Results results = study::run(source, cases::variation_of(source), nothing, {});
  const fs::path out = tests::temporary_files() / "library";
  fs::remove_all(out);
  const app::RunResult run = app::run_case(source, {.out = out, .verbosity = -1, .stage_lines = false});
  fs::remove_all(out);
  ASSERT_EQ(results.lobes.size(), 2U);
  for (std::size_t i = 0; i < results.lobes.size(); ++i) {
    const report::LobesSummary& chart = run.summary.lobes[i];
    EXPECT_EQ(chart.name, results.lobes[i].of);
    EXPECT_EQ(chart.minimum_depth_m, results.lobes[i].lobes.minimum_depth_m);
    EXPECT_EQ(chart.at_case_speed->limiting_depth_m, results.lobes[i].at_spindle_speed->limiting_depth_m);
  }
  EXPECT_EQ(run.summary.coupling->route_difference->max_relative, results.coupled->difference->max_relative);
  const auto& modes = results.finite_elements->modes.frequency_hz;
  for (Eigen::Index i = 0; i < modes.size(); ++i)
    EXPECT_EQ(run.summary.part->modes[static_cast<std::size_t>(i)].frequency_hz, modes(i));
}

TEST(Library, TellsItsStagesAndMessagesToWhoeverListensAndWritesNothing) {
  const cases::Case source = cases::read_case(fs::path(THINWALL_SOURCE_DIR) / "cases" / "barrios-2019",
                                              {"lobes.count=24", "part.mesh.element_size=30 mm"});
  std::vector<std::string> stages, messages;
  const auto before =
      core::set_message_listener([&](core::MessageLevel, const std::string& text) { messages.push_back(text); });
  study::Kept nothing;
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  (void)study::run(source, cases::variation_of(source), nothing, {{}, [&](const std::string& stage) {
                                                                    if (!stage.empty()) stages.push_back(stage);
                                                                  }});
  core::set_message_listener(before);
  EXPECT_EQ(testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr(), "");
  EXPECT_FALSE(messages.empty());
  ASSERT_GE(stages.size(), 4U);
  EXPECT_EQ(stages.back(), "lobes");
}

}  // namespace

}  // namespace thinwall::tests::library_test
