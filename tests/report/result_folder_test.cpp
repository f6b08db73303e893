#include "report/result_folder.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "report/publish.hpp"
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

/// As with --out results, below which another run writes results/other just now.
TEST(ResultFolder, WhatOtherRunsWriteBelowItIsLeftAlone) {
  const TemporaryFolder temporary;
  const ResultFolder other(temporary.path / "other");
  const core::PartialFile theirs(temporary.path / "other" / "summary.json");
  std::ofstream(theirs.partial()) << "half";
  std::filesystem::create_directory(temporary.path / "cache");
  const auto ours = core::partial_path(temporary.path / "cache" / "mesh.bin");
  std::ofstream(ours) << "half";
  { const ResultFolder held(temporary.path); }
  EXPECT_TRUE(std::filesystem::exists(theirs.partial()));
  EXPECT_FALSE(std::filesystem::exists(ours)) << "left by a killed run of this folder";
}

/// A folder with results of an earlier run and what a user put there, and a finished result within it.
struct Earlier {
  Earlier() {
    for (const auto& below : {folder / "modes", staging / "modes", staging / "lobes", folder / "photos"})
      std::filesystem::create_directories(below);
    for (const char* name : {"modes/old.csv", "case.fitted.toml", "manifest.json", "notes.txt", "photos/first.txt"})
      std::ofstream(folder / name) << "earlier";
    std::filesystem::create_symlink("notes.txt", folder / "link");
    for (const char* name : {"modes/new.csv", "lobes/part.csv", "manifest.json"})
      std::ofstream(staging / name) << "new";
  }

  TemporaryFolder temporary;
  std::filesystem::path folder = temporary.path / "out", staging = folder / ".results.partial-1-0";
};

std::vector<std::string> names_below(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_directory()) names.push_back(entry.path().lexically_relative(folder));
  }
  std::sort(names.begin(), names.end());
  return names;
}

void expect_new_results_and_notes(const std::filesystem::path& folder) {
  EXPECT_EQ(names_below(folder), (std::vector<std::string>{"link", "lobes/part.csv", "manifest.json", "modes/new.csv",
                                                           "notes.txt", "photos/first.txt"}));
  EXPECT_EQ(core::read_file(folder / "manifest.json"), "new");
  EXPECT_EQ(core::read_file(folder / "link"), "earlier");
}

TEST(Publish, ExchangesTheFolderAndKeepsWhatIsNotARunsOwn) {
  const Earlier earlier;
  std::filesystem::permissions(earlier.folder, std::filesystem::perms(0750));
  EXPECT_EQ(publish(earlier.staging, earlier.folder), Published::by_exchange);
  expect_new_results_and_notes(earlier.folder);
  EXPECT_EQ(names_below(earlier.temporary.path).size(), names_below(earlier.folder).size()) << "nothing beside it";
  EXPECT_EQ(std::filesystem::status(earlier.folder).permissions(), std::filesystem::perms(0750));
}

TEST(Publish, MovesResultsOneByOneWhereTheWorkingDirectoryIsTheFolder) {
  const Earlier earlier;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(earlier.folder);
  const Published published = publish(".results.partial-1-0", ".");
  expect_new_results_and_notes(".");
  std::filesystem::current_path(before);
  EXPECT_EQ(published, Published::by_moves) << "a shell in there would be in a folder that is gone";
}

/// Tables of the robot are written aside, so that those of an earlier survey are there until the new ones are whole.
TEST(Publish, PutsOneFolderInPlaceOfAnEarlierOne) {
  const TemporaryFolder temporary;
  const auto folder = temporary.path / "robot", complete = temporary.path / "new";
  EXPECT_THROW(publish_folder(complete, folder), core::DataError) << "nothing is complete";
  for (const char* text : {"first", "second"}) {
    std::filesystem::create_directories(complete);
    std::ofstream(complete / (std::string(text) + ".csv")) << text;
    publish_folder(complete, folder);
    EXPECT_EQ(names_below(temporary.path), (std::vector<std::string>{"robot/" + std::string(text) + ".csv"}));
  }
  EXPECT_THROW(publish_folder(complete, folder), core::DataError);
  EXPECT_EQ(names_below(temporary.path), (std::vector<std::string>{"robot/second.csv"})) << "the earlier one stays";
}

TEST(ResultFolder, StaysLockedWhenItsResultsArePublished) {
  const Earlier earlier;
  {
    ResultFolder held(earlier.folder);
    std::filesystem::create_directories(earlier.staging / "modes");  // what was there was unfinished
    std::ofstream(earlier.staging / "manifest.json") << "new";
    held.publish(earlier.staging);
    EXPECT_NE(refusal(earlier.folder).find("another run is writing there"), std::string::npos);
  }
  EXPECT_EQ(refusal(earlier.folder), "");
}

/// What a refused run leaves: nothing, unless a stage is kept already or somebody put a file there meanwhile.
TEST(ResultFolder, ARefusedRunTakesBackItsLogAloneAndWhatItKeptStays) {
  const auto left_with = [](const std::string& file) {
    const TemporaryFolder temporary;
    const std::filesystem::path folder = temporary.path / "made" / "out";
    {
      ResultFolder held(folder);
      std::ofstream(folder / "run.log") << "log";
      std::filesystem::create_directories(folder / "cache");
      if (!file.empty()) std::ofstream(folder / file) << "kept";
      EXPECT_THROW(unless_refused(held, []() -> int { throw core::InputError("refused"); }), core::InputError);
    }
    EXPECT_EQ(std::filesystem::exists(temporary.path / "made"), !file.empty()) << file;
    EXPECT_TRUE(std::filesystem::exists(temporary.path));
    return file.empty() ? std::vector<std::string>{} : names_below(folder);
  };
  EXPECT_EQ(left_with(""), std::vector<std::string>{});
  EXPECT_EQ(left_with("cache/part.bin"), (std::vector<std::string>{"cache/part.bin", "run.log"}));
  EXPECT_EQ(left_with("notes.txt"), (std::vector<std::string>{"notes.txt"}));
}

TEST(ResultFolder, WhatAKilledRunLeftBesideItIsRemovedUnlessThatRunStillHasIt) {
  const TemporaryFolder temporary;
  const auto left = temporary.path / ".out.partial-1-0", another = temporary.path / ".other.partial-1-0";
  for (const auto& folder : {left, another}) std::filesystem::create_directories(folder);
  {
    const auto lock = FolderLock::of(left);
    const ResultFolder held(temporary.path / "out");
    EXPECT_TRUE(std::filesystem::exists(left));
  }
  { const ResultFolder held(temporary.path / "out"); }
  EXPECT_FALSE(std::filesystem::exists(left));
  EXPECT_TRUE(std::filesystem::exists(another)) << "is of another folder";
}

/// A lock on a folder is that of the folder that is there now, not of one that was there.
TEST(FolderLock, OfAFolderThatWasReplacedIsNotGiven) {
  const TemporaryFolder temporary;
  std::filesystem::create_directories(temporary.path / "a");
  const auto lock = FolderLock::of(temporary.path / "a");
  ASSERT_TRUE(lock);
  EXPECT_FALSE(FolderLock::of(temporary.path / "a"));
  std::filesystem::rename(temporary.path / "a", temporary.path / "b");
  std::filesystem::create_directories(temporary.path / "a");
  EXPECT_TRUE(FolderLock::of(temporary.path / "a"));
  EXPECT_FALSE(FolderLock::of(temporary.path / "b")) << "the lock went with the folder";
}

}  // namespace
}  // namespace thinwall::tests::result_folder_test
