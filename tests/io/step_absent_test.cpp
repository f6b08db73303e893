// The stand-in of the STEP reader, in every build: its functions have other names here than those of the reader.

#define reads_step reads_step_without_reader
#define read_step read_step_without_reader
#include "io/surface/step_absent.cpp"  // NOLINT(bugprone-suspicious-include): compiled for this test only

#include <gtest/gtest.h>

#include "scratch_folder.hpp"

namespace thinwall::io::test::step_absent_test {

namespace {

const std::filesystem::path parts = std::filesystem::path(THINWALL_SOURCE_DIR) / "tests" / "data" / "parts";

TEST(StepAbsent, SaysWhatToInstall) {
  EXPECT_FALSE(reads_step());
  const auto text = message_of<core::InputError>([] { (void)read_step(parts / "bracket.step"); });
  EXPECT_NE(text.find("libocct-data-exchange-dev"), std::string::npos) << text;
}

TEST(StepAbsent, AMissingFileIsToldAsOneAndNotAsAMissingReader) {
  const auto text = message_of<core::DataError>([] { (void)read_step(parts / "absent.step"); });
  EXPECT_NE(text.find("absent.step"), std::string::npos) << text;
  EXPECT_EQ(text.find("reader"), std::string::npos) << text;
}

}  // namespace

}  // namespace thinwall::io::test::step_absent_test
