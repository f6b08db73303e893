// Shells complete the words of the command line; the manual page has them all.

#include "app/completion.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "core/atomic_file.hpp"
#include "tests/app/command_call.hpp"
#include "tests/core/temporary_folder.hpp"

namespace thinwall::tests::completion_test {

using namespace cases;
using namespace app;

namespace {

namespace fs = std::filesystem;

/// What the program prints.
std::string printed(const std::vector<std::string>& words) {
  const Outcome outcome = call(words);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  return outcome.out;
}

struct Command {
  int status = -1;
  std::string said;
};

Command shell(const std::string& command) {
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  Command result;
  char buffer[4096];
  while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) result.said += buffer;
  const int status = ::pclose(pipe);
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return result;
}

bool is_there(const std::string& program) {
  return shell("command -v " + program).status == 0;
}

class BashCompletion : public testing::Test {
 protected:
  BashCompletion() {
    core::write_file_atomically(folder() / "thinwall.bash", printed({"completion", "bash"}));
    fs::create_directory(folder() / "my_case");
    core::write_file_atomically(folder() / "my_case.toml", "");
    core::write_file_atomically(folder() / "my_table.csv", "");
  }
  [[nodiscard]] const fs::path& folder() const { return temporary_.path; }

  /// What bash proposes for the last of `words`, sorted.
  [[nodiscard]] std::vector<std::string> proposed(const std::vector<std::string>& words) const {
    std::string line = "COMP_WORDS=(thinwall";
    for (const auto& word : words) line += " '" + word + "'";
    core::write_file_atomically(folder() / "ask.sh",
                                "set -eu\ncd '" + folder().string() +
                                    "'\nsource ./thinwall.bash\ncomplete -p thinwall | "
                                    "grep -q -- '-F _thinwall'\n" +
                                    line +
                                    ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_thinwall\n"
                                    "[[ ${#COMPREPLY[@]} -eq 0 ]] || printf '%s\\n' \"${COMPREPLY[@]}\"\n");
    const Command answer = shell("bash --norc '" + (folder() / "ask.sh").string() + "'");
    EXPECT_EQ(answer.status, 0) << answer.said;
    std::istringstream lines(answer.said);
    std::vector<std::string> list;
    for (std::string word; std::getline(lines, word);) list.push_back(word);
    std::ranges::sort(list);
    return list;
  }

 private:
  TemporaryFolder temporary_;
};

using Words = std::vector<std::string>;

TEST_F(BashCompletion, CommandsAndOptions) {
  EXPECT_EQ(proposed({"sw"}), (Words{"sweep"}));
  EXPECT_EQ(proposed({"re"}), (Words{"reduce", "report"}));
  EXPECT_EQ(proposed({"run", "my_case", "--pro"}), (Words{"--progress"}));
  EXPECT_EQ(proposed({"lobes", "my_case", "--fr"}), (Words{"--frequency-unit", "--fresh"}));
  EXPECT_EQ(proposed({"sweep", "my_case", "--pro"}), (Words{"--progress"}));
  EXPECT_EQ(proposed({"check", "--fr"}), Words{}) << "check has no --fresh";
  const Words all = proposed({""});
  for (const auto* name : {"run", "lobes", "init", "doctor", "completion", "--version"})
    EXPECT_TRUE(std::ranges::count(all, name) == 1) << name;
}

TEST_F(BashCompletion, ChoicesOfAnOption) {
  EXPECT_EQ(proposed({"run", "my_case", "--progress", "a"}), (Words{"always", "auto"}));
  EXPECT_EQ(proposed({"init", "--template", ""}), (Words{"frf-only", "lobes", "plate", "robot", "stl-part", "wall"}));
  EXPECT_EQ(proposed({"completion", "z"}), (Words{"zsh"}));
  EXPECT_EQ(proposed({"lobes", "my_table.csv", "--quantity", "m"}), (Words{"mobility"}));
}

TEST_F(BashCompletion, CasesFilesAndFolders) {
  EXPECT_EQ(proposed({"run", "my"}), (Words{"my_case", "my_case.toml"}));
  EXPECT_EQ(proposed({"run", "-q", "--threads", "2", "my"}), (Words{"my_case", "my_case.toml"}));
  EXPECT_EQ(proposed({"run", "my_case", "--out", "my"}), (Words{"my_case"}));
  EXPECT_EQ(proposed({"lobes", "my_t"}), (Words{"my_table.csv"}));
  EXPECT_EQ(proposed({"compare", "my_case", "my"}), (Words{"my_case"}));
  EXPECT_EQ(proposed({"run", "my_case", "my"}), Words{}) << "there is one case only";
  EXPECT_EQ(proposed({"merge", "my_case", "my"}), (Words{"my_case"})) << "any number of folders";
}

TEST_F(BashCompletion, ValuesBehindAnEqualsSign) {
  EXPECT_EQ(proposed({"run", "my_case", "--progress", "=", "a"}), (Words{"always", "auto"}));
  EXPECT_EQ(proposed({"run", "my_case", "--progress", "="}), (Words{"always", "auto", "never"}));
  EXPECT_EQ(proposed({"run", "my_case", "--out", "="}), (Words{"my_case"}));
  EXPECT_EQ(proposed({"run", "my_case", "--out", "=", "my"}), (Words{"my_case"}));
  EXPECT_EQ(proposed({"run", "--out", "=", "there", "my"}), (Words{"my_case", "my_case.toml"}));
  EXPECT_EQ(proposed({"sweep", "my_case", "part.thickness", "="}), Words{}) << "no key is the value of a key";
}

TEST_F(BashCompletion, KeysOfACase) {
  EXPECT_EQ(proposed({"run", "my_case", "--set", "part.thick"}), (Words{"part.thickness="}));
  EXPECT_EQ(proposed({"sweep", "my_case", "contacts[0].stiff"}), (Words{"contacts[0].stiffness="}));
  EXPECT_EQ(proposed({"sweep", "my_case", "part.thickness", "=", "1 mm", "tool.tee"}), (Words{"tool.teeth="}));
}

TEST(Completion, AnotherShellIsAUsageError) {
  const Outcome outcome = call({"completion", "csh"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.out, "");
}

TEST(Completion, ZshAndFishHaveEveryCommandAndReadTheirScripts) {
  const TemporaryFolder temporary;
  std::string absent;
  for (const std::string name : {"zsh", "fish"}) {
    const std::string script = printed({"completion", name});
    for (const auto* word : {"sweep", "merge", "doctor", "part.thickness="})
      EXPECT_NE(script.find(word), std::string::npos);
    core::write_file_atomically(temporary.path / name, script);
    if (!is_there(name)) {
      absent += " " + name;
      continue;
    }
    const Command checked = shell(name + " -n '" + (temporary.path / name).string() + "'");
    EXPECT_EQ(checked.status, 0) << checked.said;
  }
  if (!absent.empty()) GTEST_SKIP() << "not installed, their syntax was not checked:" << absent;
}

// The page is printed by the program; with THINWALL_WRITE_DOCS set the test writes it instead.
TEST(ManualPage, TheCommittedPageIsThatOfTheProgram) {
  const fs::path page = fs::path(THINWALL_SOURCE_DIR) / "docs" / "thinwall.1";
  const std::string expected = printed({"man"});
  if (std::getenv("THINWALL_WRITE_DOCS") != nullptr) core::write_file_atomically(page, expected);
  ASSERT_TRUE(fs::exists(page)) << "run test_app with THINWALL_WRITE_DOCS=1";
  EXPECT_TRUE(core::read_file(page) == expected) << "run test_app with THINWALL_WRITE_DOCS=1";
}

TEST(ManualPage, HasEveryCommandOptionAndExitCode) {
  const std::string page = printed({"man"});
  for (const auto* part : {".SS sweep", ".SS completion", "\\-\\-shard", "\\-\\-template",
                           "\\fI"
                           "auto|always|never",
                           "\\fB130", ".SH EXIT STATUS", "NO_COLOR"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_TRUE(std::ranges::all_of(page, [](unsigned char c) { return c < 0x80; })) << "beyond ASCII";
}

TEST(ManualPage, GroffHasNothingToSayOfIt) {
  if (!is_there("groff")) GTEST_SKIP() << "groff is not installed";
  const TemporaryFolder temporary;
  core::write_file_atomically(temporary.path / "thinwall.1", printed({"man"}));
  const Command checked = shell("groff -man -ww -z '" + (temporary.path / "thinwall.1").string() + "'");
  EXPECT_EQ(checked.status, 0);
  EXPECT_EQ(checked.said, "");
  const Command shown = shell("groff -man -Tascii -P-c -P-b -P-u '" + (temporary.path / "thinwall.1").string() + "'");
  EXPECT_NE(shown.said.find("thinwall sweep CASE KEYS"), std::string::npos) << shown.said.substr(0, 1000);
  EXPECT_NE(shown.said.find("--shard"), std::string::npos);
}

}  // namespace
}  // namespace thinwall::tests::completion_test
