#include "core/atomic_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <fstream>

#include "core/error.hpp"

namespace thinwall::core::atomic_file_test {
namespace {

class AtomicFile : public testing::Test {
 protected:
  AtomicFile() {
    std::string pattern = (std::filesystem::temp_directory_path() / "thinwall-XXXXXX").string();
    folder = ::mkdtemp(pattern.data());
  }
  ~AtomicFile() override { std::filesystem::remove_all(folder); }

  [[nodiscard]] int entries() const {
    return static_cast<int>(std::distance(std::filesystem::directory_iterator(folder), {}));
  }

  std::filesystem::path folder;
};

TEST_F(AtomicFile, HoldsExactlyTheContentAndNothingElseRemains) {
  const std::string content("bytes \0 and\nlines", 17);
  write_file_atomically(folder / "a.csv", content);
  EXPECT_EQ(read_file(folder / "a.csv"), content);
  write_file_atomically(folder / "a.csv", "second");
  EXPECT_EQ(read_file(folder / "a.csv"), "second");
  EXPECT_EQ(entries(), 1);
}

// A file-size limit makes write() fail in the middle of a file exactly as a full disk does, for root as well.
TEST_F(AtomicFile, AWriteThatFailsHalfwayLeavesTheEarlierFileAndNoRemains) {
  write_file_atomically(folder / "a.csv", "earlier");
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1024, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  EXPECT_THROW(write_file_atomically(folder / "a.csv", std::string(4096, 'x')), DataError);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(read_file(folder / "a.csv"), "earlier");
  EXPECT_EQ(entries(), 1);
}

TEST_F(AtomicFile, APartialFileThatIsNotCommittedDisappears) {
  {
    PartialFile file(folder / "modes.vtu");
    EXPECT_TRUE(is_partial_name(file.partial()));
    EXPECT_EQ(file.partial().extension(), ".vtu");
    std::ofstream(file.partial()) << "half";
  }
  EXPECT_EQ(entries(), 0);
  EXPECT_FALSE(is_partial_name("modes.vtu"));
}

/// A long sweep writes many thousands of files, whose names would be kept for ever.
TEST_F(AtomicFile, TheNameOfAFileThatIsWrittenIsForgotten) {
  std::filesystem::path name;
  {
    PartialFile file(folder / "a.csv");
    name = file.partial();
    std::ofstream(name) << "x";
    file.commit();
  }
  std::ofstream(name) << "of another writer";
  remove_partial_paths();
  EXPECT_TRUE(std::filesystem::exists(name));
}

TEST_F(AtomicFile, APartialNameIsThatOfItsTargetOnly) {
  for (const char* target : {"out", "out.1", "case.toml"}) {
    EXPECT_TRUE(is_partial_name_of(partial_path(folder / target), folder / target)) << target;
    EXPECT_FALSE(is_partial_name_of(partial_path(folder / target), folder / "other")) << target;
  }
  EXPECT_FALSE(is_partial_name_of(partial_path(folder / "out"), folder / "out.1"));
  EXPECT_FALSE(is_partial_name_of(partial_path(folder / "out.1"), folder / "out"));
  EXPECT_FALSE(is_partial_name_of(folder / ".out.partial-1-0.txt", folder / "out"));
  for (const char* without_process : {".out.partial-", ".out.partial--", ".out.partial--1-0"})
    EXPECT_FALSE(is_partial_name_of(folder / without_process, folder / "out")) << without_process;
}

TEST_F(AtomicFile, RefusesWhatIsNotAPlainFileOrHasNoFolder) {
  EXPECT_THROW(write_file_atomically(folder, "x"), DataError);
  EXPECT_THROW(write_file_atomically("/dev/full", "x"), DataError);
  EXPECT_THROW(write_file_atomically(folder / "absent" / "a.csv", "x"), DataError);
  write_file_atomically(folder / "file", "x");
  EXPECT_THROW(write_file_atomically(folder / "file" / "a.csv", "x"), DataError);
  EXPECT_EQ(read_file(folder / "file"), "x");
}

TEST_F(AtomicFile, ReadingNamesThePathAndTheCause) {
  try {
    (void)read_file(folder / "absent.csv");
    FAIL() << "no error";
  } catch (const DataError& error) {
    EXPECT_NE(std::string(error.what()).find("absent.csv"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("No such file"), std::string::npos);
  }
  EXPECT_THROW((void)read_file(folder), DataError);
}

// The file is a plain one that opens, and no byte of it can be read.
TEST_F(AtomicFile, AReadThatFailsIsNoEndOfTheFile) {
  EXPECT_THROW((void)read_file("/proc/self/mem"), DataError);
}

TEST_F(AtomicFile, ReadingTakesFilesOfAnyLength) {
  for (const std::size_t length : {0U, 1U, (1U << 20U) - 1U, 1U << 20U, (1U << 20U) + 1U, 5U << 20U}) {
    const std::string content(length, 'x');
    write_file_atomically(folder / "long", content);
    EXPECT_EQ(read_file(folder / "long"), content) << length;
  }
}

// Without a writer a pipe is waited for without end, and the device never ends.
TEST_F(AtomicFile, ReadingRefusesPipesAndDevices) {
  const auto pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW((void)read_file(pipe), DataError);
  EXPECT_THROW((void)read_file("/dev/zero"), DataError);
}

}  // namespace
}  // namespace thinwall::core::atomic_file_test
