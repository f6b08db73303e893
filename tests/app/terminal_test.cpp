// What a terminal gets that a file does not, and the other way round.

#include "app/terminal.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <regex>
#include <sstream>

#include "app/forecast.hpp"
#include "app/stage_display.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "tests/case/case_text.hpp"
#include "tests/core/temporary_folder.hpp"

namespace thinwall::tests::terminal_test {

using namespace study;
using namespace app;

namespace {

const std::string report_of_a_run = R"(
Plate

  part alone      stable up to 0.69 mm at 1900 rpm, chatter at 547.9 Hz (hopf)
  5000 rpm, 0.500 mm, tool: stable, |mu| 0.9
  5000 rpm, 2.000 mm, tool: UNSTABLE, |mu| 1.9

  stability chart        least depth anywhere
  expected                  found      wanted
  ok   first frequency      38.0
  MISS second frequency     39.0
)";

TEST(Terminal, ColourChangesNothingButMarks) {
  EXPECT_EQ(coloured(report_of_a_run, Style{false}), report_of_a_run);
  const std::string marked = coloured(report_of_a_run, Style{true});
  EXPECT_EQ(std::regex_replace(marked, std::regex("\033\\[[0-9;]*m"), ""), report_of_a_run);
  for (const auto* part : {"\033[1mPlate\033[0m", "\033[1m0.69 mm\033[0m at 1900", "\033[32mstable\033[0m,",
                           "\033[1;31mUNSTABLE\033[0m", "\033[32mok\033[0m", "\033[1;31mMISS\033[0m"})
    EXPECT_NE(marked.find(part), std::string::npos) << part;
}

TEST(Terminal, WhatIsNoTerminalGetsNoColour) {
  std::ostringstream file;
  EXPECT_FALSE(style_for(file).colour);
}

TEST(Terminal, ProgressIsAutoAlwaysOrNever) {
  EXPECT_EQ(progress_display("never", false), ProgressDisplay::none);
  EXPECT_EQ(progress_display("auto", true), ProgressDisplay::none);
  EXPECT_NE(progress_display("always", true), ProgressDisplay::none);
  EXPECT_THROW((void)progress_display("often", false), core::UsageError);
}

TEST(Terminal, ALongLoopIsShownWithItsCountAndTheTimeLeft) {
  EXPECT_EQ(progress_text("lobes", {"speeds", 120, 200, 12.0}), "lobes: 120 of 200 speeds, 8 s left");
  EXPECT_EQ(progress_text("lobes", {"speeds", 1, 200, 0.1}), "lobes: 1 of 200 speeds");
  EXPECT_EQ(progress_text("lobes", {"speeds", 200, 200, 12.0}), "lobes: 200 of 200 speeds");
  EXPECT_EQ(progress_text("map", {"speeds", 1, 61, 10.0}), "map: 1 of 61 speeds, 10 min left");
}

/// What a program writes to both of its outputs.
struct Shown {
  int status = -1;
  std::string text;
};

Shown read_all(int descriptor, pid_t child) {
  Shown shown;
  char buffer[4096];
  for (ssize_t got = 0; (got = ::read(descriptor, buffer, sizeof buffer)) > 0;) shown.text.append(buffer, got);
  ::close(descriptor);
  int status = 0;
  ::waitpid(child, &status, 0);
  shown.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return shown;
}

[[noreturn]] void become(const std::vector<std::string>& words) {
  std::vector<char*> argv;
  for (const auto& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

/// The program on a terminal, or with a pipe in its place.
Shown shown(std::vector<std::string> words, bool terminal, const char* no_color = "") {
  words.insert(words.begin(), std::string(THINWALL_BUILD_DIR) + "/app/thinwall");
  int ends[2] = {-1, -1};
  if (!terminal && ::pipe2(ends, O_CLOEXEC) != 0) return {};
  const pid_t child = terminal ? ::forkpty(&ends[0], nullptr, nullptr, nullptr) : ::fork();
  if (child == 0) {
    ::setenv("TERM", "xterm", 1);
    ::setenv("NO_COLOR", no_color, 1);
    if (!terminal) {
      ::dup2(ends[1], STDOUT_FILENO);
      ::dup2(ends[1], STDERR_FILENO);
    }
    become(words);
  }
  if (!terminal) ::close(ends[1]);
  return read_all(ends[0], child);
}

class OnATerminal : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(std::string(THINWALL_BUILD_DIR) + "/app/thinwall"))
      GTEST_SKIP() << "the program is not built";
    std::filesystem::create_directory(folder() / "case");
    core::write_file_atomically(folder() / "case" / "case.toml", with(cutter_case(), "count = 3", "count = 100"));
  }
  [[nodiscard]] const std::filesystem::path& folder() const { return temporary_.path; }
  [[nodiscard]] Shown run(bool terminal, const std::vector<std::string>& more = {}, const char* no_color = "") const {
    std::vector<std::string> words{"run", (folder() / "case").string(), "--out", (folder() / "out").string()};
    words.insert(words.end(), more.begin(), more.end());
    const Shown result = shown(words, terminal, no_color);
    EXPECT_EQ(result.status, 0) << result.text;
    return result;
  }

 private:
  TemporaryFolder temporary_;
};

TEST_F(OnATerminal, OneLineWithStageAndCountIsOverwritten) {
  const std::string text = run(true).text;
  EXPECT_NE(text.find("\r\033[K"), std::string::npos);
  EXPECT_TRUE(std::regex_search(text, std::regex("lobes: [0-9]+ of 100 speeds"))) << text;
  EXPECT_EQ(text.find("stage: "), std::string::npos);
  EXPECT_NE(text.find("\033[1mCutter\033[0m"), std::string::npos) << text;
}

TEST(Forecast, SaysTheWholeTimeAndItsTwoParts) {
  const auto part = [](double seconds) { return setup::PartSize{2, 1.0, 1.0, seconds}; };
  EXPECT_EQ(text({0.0, part(0.2), study::LobesForecast{{}, 0.1, false}, {}}), "this takes about 1 s");
  EXPECT_EQ(text({0.0, part(30.0), study::LobesForecast{{}, 90.0, false}, {}}),
            "this takes about 2 min: the part about 30 s, the lobes about 90 s");
  EXPECT_EQ(text({0.0, {}, study::LobesForecast{{}, 7200.0, true}, {}}), "this takes over 2 h");
  EXPECT_EQ(
      text({0.0, part(0.2), study::LobesForecast{{}, 90.0, false}, study::SimulationForecast{2.0, 0.0, 1200.0, 29.0}}),
      "this takes about 2 min: the lobes about 90 s, the simulation about 29 s");
  const setup::PartSize unmet{2, 1.0, 1.0, 3.0, true};
  EXPECT_EQ(text({0.0, unmet, study::LobesForecast{{}, 90.0, false}, {}}),
            "this takes over 93 s: the part over 3 s, the lobes about 90 s");
  EXPECT_EQ(text({12.0, {}, {}, {}}).find("this takes about 12 s"), 0U) << text({12.0, {}, {}, {}});
}

TEST(StageDisplay, AStageWithoutALoopIsToldOfAgainWhileItGoesOn) {
  int ends[2] = {-1, -1};
  ASSERT_EQ(::pipe2(ends, O_CLOEXEC), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(ends[1], STDERR_FILENO);
    StageDisplay display(ProgressDisplay::line);
    display.listener()("factorisation");
    ::pause();
  }
  ::close(ends[1]);
  const std::regex twice("factorisation …[^]*factorisation …");
  std::string text;
  char buffer[256];
  for (ssize_t got = 1; got > 0 && !std::regex_search(text, twice);) {
    got = ::read(ends[0], buffer, sizeof buffer);
    if (got > 0) text.append(buffer, got);
  }
  EXPECT_TRUE(std::regex_search(text, twice)) << text;
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  ::close(ends[0]);
}

TEST_F(OnATerminal, NoColorLeavesTheLineAndTakesTheMarks) {
  const std::string text = run(true, {}, "1").text;
  EXPECT_EQ(text.find("\033[1m"), std::string::npos);
  EXPECT_NE(text.find("\r\033[K"), std::string::npos);
}

TEST_F(OnATerminal, NeverAndQuietShowNoProgress) {
  EXPECT_EQ(run(true, {"--progress", "never"}).text.find("of 100 speeds"), std::string::npos);
  EXPECT_EQ(run(true, {"-q"}).text.find("\r\033[K"), std::string::npos);
  EXPECT_NE(run(true, {"-q", "--progress", "always"}).text.find("of 100 speeds"), std::string::npos);
}

TEST_F(OnATerminal, APipeGetsPlainLinesAndNoEscapeSequence) {
  for (const char* wanted : {"auto", "always"}) {
    const std::string text = run(false, {"--progress", wanted}).text;
    EXPECT_EQ(text.find('\033'), std::string::npos);
    EXPECT_EQ(text.find('\r'), std::string::npos);
    EXPECT_NE(text.find("stage: lobes\n"), std::string::npos) << text;
  }
  EXPECT_NE(run(false, {"-q", "--progress", "always"}).text.find("stage: lobes\n"), std::string::npos);
  EXPECT_EQ(run(false, {"--progress", "never"}).text.find("stage: "), std::string::npos);
}

}  // namespace
}  // namespace thinwall::tests::terminal_test
