#include "report/result_folder.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "tests/core/temporary_folder.hpp"

namespace thinwall::tests::result_folder_test {

using namespace report;

namespace {

std::string refusal(const std::filesystem::path& folder) {
  try {
    const ResultFolder held(folder);
  } catch (const core::DataError& error) {
    EXPECT_EQ(error.code(), core::ExitCode::unreadable_data);
    return error.what();
  }
  return "";
}

TEST(ResultFolder, IsMadeAndLeftEmpty) {
  const TemporaryFolder temporary;
  { const ResultFolder held(temporary.path / "a" / "b"); }
  EXPECT_TRUE(std::filesystem::is_empty(temporary.path / "a" / "b"));
}

TEST(ResultFolder, RefusesWhatIsNoFolderAndWhatCannotBeWritten) {
  const TemporaryFolder temporary;
  std::ofstream(temporary.path / "file") << "x";
  EXPECT_NE(refusal(temporary.path / "file").find("it is a file, not a folder"), std::string::npos);
  EXPECT_NE(refusal(temporary.path / "file" / "below").find("--out"), std::string::npos);
  EXPECT_NE(refusal("/proc/thinwall-results").find("--out"), std::string::npos);
}

// Write permission does not bind root, so the check runs as an ordinary user in a child process.
TEST(ResultFolder, RefusesAReadOnlyFolder) {
  const TemporaryFolder temporary;
  std::filesystem::permissions(temporary.path, std::filesystem::perms(0555));
  const pid_t child = fork();
  if (child == 0) {
    if (geteuid() == 0 && setuid(65534) != 0) _exit(3);
    _exit(refusal(temporary.path).empty() ? 1 : 0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  std::filesystem::permissions(temporary.path, std::filesystem::perms(0755));
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == 3) GTEST_SKIP() << "cannot become an ordinary user";
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(ResultFolder, AFullDiskIsSeenBeforeAnythingIsComputed) {
  const TemporaryFolder temporary;
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1024, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message = refusal(temporary.path / "results");
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(message.find("free space"), std::string::npos) << message;
  EXPECT_TRUE(std::filesystem::is_empty(temporary.path / "results"));
}

TEST(ResultFolder, TheSecondOfTwoRunsIntoOneFolderIsRefused) {
  const TemporaryFolder temporary;
  {
    const ResultFolder first(temporary.path);
    EXPECT_NE(refusal(temporary.path).find("another run is writing there"), std::string::npos);
  }
  EXPECT_EQ(refusal(temporary.path), "");
}

TEST(ResultFolder, RemainsOfAKilledRunAreRemovedAndResultsKept) {
  const TemporaryFolder temporary;
  std::filesystem::create_directory(temporary.path / "modes");
  core::write_file_atomically(temporary.path / "run.log", "");  // what marks the folder as a run's
  const pid_t child = fork();
  if (child == 0) {
    const core::PartialFile file(temporary.path / "modes" / "part_mode_01.vtu");
    std::ofstream(file.partial()) << "half";
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_FALSE(std::filesystem::is_empty(temporary.path / "modes"));
  core::write_file_atomically(temporary.path / "summary.json", "{}");
  { const ResultFolder held(temporary.path); }
  EXPECT_TRUE(std::filesystem::is_empty(temporary.path / "modes"));
  EXPECT_TRUE(std::filesystem::exists(temporary.path / "summary.json"));
}

}  // namespace
}  // namespace thinwall::tests::result_folder_test
