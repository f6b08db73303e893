#include "app/command_line.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <thread>

#include "app/self_test.hpp"
#include "app/signals.hpp"
#include "case/reader.hpp"
#include "case/templates.hpp"
#include "core/atomic_file.hpp"
#include "core/interrupt.hpp"
#include "report/summary.hpp"
#include "tests/app/command_call.hpp"
#include "tests/case/case_text.hpp"
#include "tests/core/temporary_folder.hpp"

namespace thinwall::tests::command_line_test {

using namespace cases;
using namespace study;
using namespace report;
using namespace app;

namespace {

/// The least that a run returns: what the terminal's table is made from.
RunResult empty_result(bool expectations_hold) {
  return {summary_of(Case{}, Results{}), expectations_hold};
}

class CommandLine : public testing::Test {
 protected:
  CommandLine() {
    std::filesystem::create_directory(temporary.path / "plate");
    core::write_file_atomically(temporary.path / "plate" / "case.toml", plate_case());
  }
  [[nodiscard]] std::string plate() const { return (temporary.path / "plate").string(); }
  [[nodiscard]] std::string out() const { return (temporary.path / "results").string(); }

  TemporaryFolder temporary;
};

TEST_F(CommandLine, HelpAndVersionEndWithZero) {
  EXPECT_EQ(call({"--help"}).code, 0);
  EXPECT_NE(call({"--help"}).out.find("doctor"), std::string::npos);
  EXPECT_EQ(call({"run", "--help"}).code, 0);
  EXPECT_EQ(call({"--version"}).code, 0);
  EXPECT_NE(call({"--version"}).out.find("thinwall "), std::string::npos);
}

TEST_F(CommandLine, WrongUseEndsWithTwoAndOneLine) {
  for (const auto& words : std::vector<std::vector<std::string>>{{"run"},
                                                                 {"merge", "a", "b"},
                                                                 {"fly"},
                                                                 {"run", "a", "b"},
                                                                 {"compare", "a"},
                                                                 {"run", "a", "-q", "-v"},
                                                                 {"run", "a", "--threads", "0"},
                                                                 {"check", plate(), "--set", "part.length"},
                                                                 {"init", "--template", "walls", out()}}) {
    const Outcome outcome = call(words);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
}

TEST_F(CommandLine, CheckTellsTheLeastTimeOfAPartThatMeetsNoTolerance) {
  const std::string wall = std::string(THINWALL_SOURCE_DIR) + "/cases/cantilever-wall";
  const auto told = [&](const std::string& radius) {
    return call({"check", wall, "--set", "points.P.patch_radius=" + radius, "--set", "lobes.count=3", "--set",
                 "lobes.most_added=0"})
        .out;
  };
  EXPECT_EQ(told("1.5 mm").find("over"), std::string::npos) << told("1.5 mm");
  const std::string unmet = told("0 mm");
  EXPECT_TRUE(std::regex_search(unmet, std::regex("over [0-9]+ s for mesh, modes and reduction"))) << unmet;
  EXPECT_TRUE(std::regex_search(unmet, std::regex("; over [0-9]+ s in all"))) << unmet;
}

TEST_F(CommandLine, AnErrorOfAnOptionCitesTheOptionAndNoFile) {
  const Outcome outcome = call({"check", plate(), "--set", "part.length=6 kg"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_TRUE(outcome.err.starts_with("thinwall: --set part.length: \"6 kg\" is a mass")) << outcome.err;
}

TEST_F(CommandLine, AnOptionOfACommandThatStandsForAKeyIsCitedItself) {
  const Outcome speed = call({"calibrate", plate(), "--speed", "9000"});
  EXPECT_EQ(speed.code, 3);
  EXPECT_TRUE(speed.err.starts_with("thinwall: --speed: a spindle speed needs its unit")) << speed.err;
  const Outcome none = call({"calibrate", plate()});
  EXPECT_NE(none.err.find("case.toml: calibration: there are no cuts to learn from"), std::string::npos) << none.err;
}

TEST_F(CommandLine, AValueOfAnOptionThatIsNoneIsWrongUse) {
  for (const std::string memory : {"lots", "-1 GB", "nan GB", "1 B", "1e300 GB"}) {
    const Outcome outcome = call({"run", plate(), "--memory", memory});
    EXPECT_EQ(outcome.code, 2) << memory;
    EXPECT_TRUE(outcome.err.starts_with("thinwall: --memory: ")) << outcome.err;
  }
}

TEST_F(CommandLine, AnOptionThatCannotBeIsToldByItsNameBeforeTheCaseIsRead) {
  const Outcome reduced = call({"reduce", out(), "--method", "nosuch"});
  EXPECT_EQ(reduced.code, 2);
  EXPECT_TRUE(reduced.err.starts_with("thinwall: --method: ")) << reduced.err;
  const Outcome made = call({"init", "--template", "plat", out()});
  EXPECT_EQ(made.code, 2);
  EXPECT_TRUE(made.err.starts_with("thinwall: --template: there is no template \"plat\"")) << made.err;
}

TEST_F(CommandLine, ATitleDoesNotTurnTheTextOfATerminal) {
  const std::string reversed = "\xE2\x80\xAE";  // U+202E
  const Outcome outcome = call({"check", plate(), "--set", "title=\"before" + reversed + "after\""});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("before?after"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find(reversed), std::string::npos);
}

TEST_F(CommandLine, AnEmptyNameOfAnOutputIsWrongUse) {
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{{"run", plate()},
                                                                                     {"simulate", plate()},
                                                                                     {"lobes", plate()},
                                                                                     {"reduce", plate()},
                                                                                     {"postures", plate()},
                                                                                     {"sweep", plate(), "a=1, 2"},
                                                                                     {"merge", out()},
                                                                                     {"report", out()}}) {
    std::vector<std::string> all = words;
    all.insert(all.end(), {"--out", ""});
    const Outcome outcome = call(all);
    EXPECT_EQ(outcome.code, 2) << words.front() << ": " << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("thinwall: --out: the name is empty")) << words.front() << ": " << outcome.err;
  }
}

TEST_F(CommandLine, AnErrorIsOneLineWhateverItCites) {
  for (const std::string& name : {std::string(50000, 'a'), std::string("a\nb\x1b[2J")}) {
    const Outcome outcome = call({"check", name});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_LT(outcome.err.size(), 700U);
    EXPECT_EQ(outcome.err.find('\x1b'), std::string::npos);
    EXPECT_NE(outcome.err.find("\"thinwall init\" makes one"), std::string::npos) << "the remedy stays";
  }
  const Outcome option = call({"check", plate(), "--set", std::string(50000, 'a') + "=1"});
  EXPECT_LT(option.err.size(), 1200U) << "with the line of what was given";
}

TEST_F(CommandLine, APathThatCannotBeFollowedIsToldByItsName) {
  const auto loop = temporary.path / "plate" / "expected.toml";
  std::filesystem::create_symlink("expected.toml", loop);
  const Outcome outcome = call({"check", plate()});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_TRUE(outcome.err.starts_with("thinwall: cannot use \"" + loop.string() + "\": ")) << outcome.err;
}

// Every command that is shown is one: what stands behind "thinwall" in each line is tried with --help.
TEST_F(CommandLine, TheNameAloneShowsHowToBegin) {
  const Outcome outcome = call({});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_LE(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 10) << outcome.err;
  std::istringstream lines(outcome.err);
  int shown = 0;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string program, command;
    words >> program >> command;
    if (program != "thinwall") continue;
    EXPECT_EQ(call({command, "--help"}).code, 0) << line;
    ++shown;
  }
  EXPECT_GE(shown, 3);
}

TEST_F(CommandLine, AMergeSaysWhereItsTableGoes) {
  const Outcome outcome = call({"merge", out()});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("--out is required"), std::string::npos) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(std::filesystem::path(out()) / "sweep.csv"));
}

TEST_F(CommandLine, AWordThatMeansACommandIsAnsweredWithIt) {
  EXPECT_NE(call({"compute", "a"}).err.find("(did you mean \"run\"?)"), std::string::npos);
}

TEST_F(CommandLine, AWordThatIsNoCommandIsNamedWithTheNearestOne) {
  EXPECT_EQ(call({"frobnicate"}).err,
            "thinwall: there is no command \"frobnicate\"; \"thinwall --help\" lists the commands\n");
  EXPECT_NE(call({"comapre", "a", "b"}).err.find("no command \"comapre\" (did you mean \"compare\"?)"),
            std::string::npos);
  EXPECT_EQ(call({"comapre", "a", "b"}).code, 2);
}

TEST_F(CommandLine, AnOptionThatIsNoneIsNamedWithTheNearestOne) {
  EXPECT_EQ(
      call({"run", plate(), "--fersh"}).err,
      "thinwall: \"thinwall run\" has no option \"--fersh\" (did you mean \"--fresh\"?); \"thinwall run --help\" lists "
      "them\n");
  EXPECT_EQ(call({"merge", "--shard=1/2", "a"}).err,
            "thinwall: \"thinwall merge\" has no option \"--shard\"; \"thinwall merge --help\" lists them\n");
  for (const std::string other : {"-o", "--output", "--results"}) {
    const std::string told = call({"run", plate(), other, "there"}).err;
    EXPECT_NE(told.find("has no option \"" + other + "\" (did you mean \"--out\"?)"), std::string::npos) << told;
  }
  EXPECT_NE(call({"-x"}).err.find("\"thinwall\" has no option \"-x\""), std::string::npos);
  EXPECT_NE(call({"--versoin"}).err.find("(did you mean \"--version\"?)"), std::string::npos);
  EXPECT_NE(call({"run", plate(), "--out"}).err.find("--out: 1 required DIR missing"), std::string::npos);
}

TEST_F(CommandLine, WhatCannotBeReadIsSaidBeforeAnythingIsClaimed) {
  const Outcome animated = call({"animate", out()});
  EXPECT_EQ(animated.code, 4);
  EXPECT_EQ(animated.out, "");
  EXPECT_EQ(animated.err,
            "thinwall: \"" + out() + "\" is no folder: name the result folder of a finished run, as results/<case>\n");
  std::filesystem::create_directories(out());
  core::write_file_atomically(out() + "/summary.json", "{}");
  const Outcome shapeless = call({"animate", out()});
  EXPECT_EQ(shapeless.code, 4) << "no shapes";
  EXPECT_EQ(shapeless.out, "");
  EXPECT_EQ(shapeless.err.find("choose another folder"), std::string::npos) << shapeless.err;
}

TEST_F(CommandLine, LobesTakesFresh) {
  for (const bool fresh : {false, true}) {
    std::vector<std::string> words{"lobes", plate(), "--out", out(), "-q"};
    if (fresh) words.emplace_back("--fresh");
    bool asked = !fresh;
    EXPECT_EQ(call(words,
                   [&](const Case&, const RunOptions& options) {
                     asked = options.fresh;
                     return empty_result(true);
                   })
                  .code,
              0);
    EXPECT_EQ(asked, fresh);
  }
}

TEST_F(CommandLine, RunHandsTheCaseAndThePreparedFolderToThePipeline) {
  const Outcome outcome = call({"run", plate(), "--out", out(), "--set", "part.element_size=8 mm", "--fresh", "-q"},
                               [&](const Case& source, const RunOptions& options) {
                                 EXPECT_DOUBLE_EQ(source.part->mesh.element_size.value_or(0.0), 0.008);
                                 EXPECT_EQ(options.out, out());
                                 EXPECT_TRUE(options.fresh);
                                 EXPECT_EQ(options.verbosity, -1);
                                 EXPECT_TRUE(std::filesystem::exists(options.out / "run.log"));
                                 return empty_result(true);
                               });
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST_F(CommandLine, EveryKindOfFailureHasItsExitCode) {
  const auto code_of = [&](const RunCase& run) { return call({"run", plate(), "--out", out(), "-q"}, run).code; };
  EXPECT_EQ(code_of([](const Case&, const RunOptions&) -> RunResult { throw core::InputError("x"); }), 3);
  EXPECT_EQ(code_of([](const Case&, const RunOptions&) -> RunResult { throw core::DataError("x"); }), 4);
  EXPECT_EQ(code_of([](const Case&, const RunOptions&) -> RunResult { throw core::NumericalError("x"); }), 5);
  EXPECT_EQ(code_of([](const Case&, const RunOptions&) -> RunResult { throw core::Interrupted(); }), 130);
  EXPECT_EQ(code_of([](const Case&, const RunOptions&) -> RunResult { throw std::logic_error("x"); }), 1);
  EXPECT_EQ(code_of([](const Case&, const RunOptions&) -> RunResult { throw 7; }), 1);
  EXPECT_EQ(code_of([](const Case&, const RunOptions&) { return empty_result(false); }), 6);
  EXPECT_EQ(call({"run", (temporary.path / "absent").string()}).code, 3);
  EXPECT_EQ(call({"run", plate(), "--out", plate() + "/case.toml"}).code, 4);
}

TEST_F(CommandLine, NothingIsComputedForACaseWithErrors) {
  core::write_file_atomically(temporary.path / "plate" / "case.toml", with(plate_case(), "teeth = 6", "teeth = 0"));
  const Outcome outcome = call({"run", plate(), "--out", out()}, [](const Case&, const RunOptions&) {
    ADD_FAILURE() << "computed";
    return empty_result(true);
  });
  EXPECT_EQ(outcome.code, 3);
  EXPECT_NE(outcome.err.find("case.toml:39:9: tool.teeth"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(out()));
}

TEST_F(CommandLine, CheckReportsEveryErrorAndOtherwiseTheSizes) {
  const Outcome good = call({"check", plate()});
  EXPECT_EQ(good.code, 0);
  EXPECT_NE(good.out.find("DOFs"), std::string::npos);
  EXPECT_NE(good.out.find(" rows of all charts on "), std::string::npos) << good.out;
  EXPECT_NE(good.out.find(" in all\n"), std::string::npos) << good.out;
  core::write_file_atomically(
      temporary.path / "plate" / "case.toml",
      with(with(plate_case(), "teeth = 6", "teeth = 0"), "poisson_ratio = 0.3", "poisson_ratio = 0.5"));
  const Outcome bad = call({"check", plate()});
  EXPECT_EQ(bad.code, 3);
  const std::string file = plate() + "/case.toml";
  EXPECT_EQ(bad.err, "thinwall: " + file +
                         ":8:17: part.material.poisson_ratio: 0.5 is out of range: it must be at least 0, below 0.5; "
                         "isotropic solids lie at 0.2 to 0.45; 0.5 would be incompressible\n"
                         "      8 | poisson_ratio = 0.5\n"
                         "        |                 ^~~\n"
                         "thinwall: " +
                         file +
                         ":39:9: tool.teeth: 0 is out of range: it must be at least 1, at most 100\n"
                         "     39 | teeth = 0\n"
                         "        |         ^\n");
}

TEST_F(CommandLine, TemplatesAreRightCasesAndNeverOverwrite) {
  for (const auto& name : template_names()) {
    const auto folder = temporary.path / name / "new";
    EXPECT_EQ(call({"init", "--template", name, folder.string()}).code, 0);
    EXPECT_NO_THROW((void)read_case(folder));
    core::write_file_atomically(folder / "case.toml", "mine");
    EXPECT_EQ(call({"init", "--template", name, folder.string()}).code, 4);
    EXPECT_EQ(core::read_file(folder / "case.toml"), "mine");
  }
}

TEST_F(CommandLine, DoctorNamesTheLibraries) {
  const Outcome outcome = call({"doctor"});
  EXPECT_EQ(outcome.code, 0);
  for (const auto* name :
       {"Eigen", "SuiteSparse", "METIS", "VTK", "threads", "memory", "BLAS kernel", "STEP files", "--ranks"}) {
    EXPECT_NE(outcome.out.find(name), std::string::npos) << name;
  }
}

TEST_F(CommandLine, DoctorTellsWhetherPythonFindsTheModule) {
  const auto module = temporary.path / "python" / "thinwall";
  std::filesystem::create_directories(module);
  const char* before = std::getenv("PYTHONPATH");
  const std::string kept = before == nullptr ? "" : before;
  ::setenv("PYTHONPATH", module.parent_path().c_str(), 1);
  core::write_file_atomically(module / "__init__.py", "");
  const std::string found = call({"doctor"}).out;
  core::write_file_atomically(module / "__init__.py", "import no_such_library\n");
  const std::string broken = call({"doctor"}).out;
  before == nullptr ? ::unsetenv("PYTHONPATH") : ::setenv("PYTHONPATH", kept.c_str(), 1);
  if (std::system("python3 -c ''") != 0) GTEST_SKIP() << "python3 is not installed";
  EXPECT_NE(found.find("Python module   there, in " + module.string()), std::string::npos) << found;
  EXPECT_NE(broken.find("Python module   absent for python3: install python3-thinwall"), std::string::npos) << broken;
}

TEST_F(CommandLine, DoctorComputesACantileverAndSaysWhetherItIsRight) {
  const SelfTest test = self_test();
  EXPECT_TRUE(test.ok()) << test.failure;
  EXPECT_NEAR(test.expected_hz, 208.88, 0.01);  // 3.516 / (2 pi l^2) sqrt(E h^2 / 12 rho), l = 0.2 m, h = 10 mm, steel
  EXPECT_LT(test.found_hz, test.expected_hz) << "shear and rotary inertia lower it";
  EXPECT_FALSE((SelfTest{test.expected_hz * 1.02, test.expected_hz, 0.1, ""}).ok());
  EXPECT_FALSE((SelfTest{test.expected_hz, test.expected_hz, 0.1, "out of memory"}).ok());
  EXPECT_LT(test.mode_difference, 1e-8);
  const std::string report = call({"doctor"}).out;
  EXPECT_NE(report.find("by a Sturm count and Spectra's Lanczos"), std::string::npos) << report;
  EXPECT_NE(report.find("everything works"), std::string::npos) << report;
}

TEST_F(CommandLine, SchemaPrintsJsonOfEachFile) {
  for (const std::string file : {"case", "expected", "joints", "summary"}) {
    const auto schema = nlohmann::json::parse(call({"schema", file}).out);
    EXPECT_EQ(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
    EXPECT_FALSE(schema["properties"].empty());
  }
  EXPECT_EQ(call({"schema"}).out, call({"schema", "case"}).out);
  EXPECT_EQ(call({"schema", "--summary"}).out, call({"schema", "summary"}).out);
  EXPECT_EQ(call({"schema", "case", "--summary"}).code, 2);
  EXPECT_EQ(call({"schema", "robot"}).code, 2);
}

TEST_F(CommandLine, AFullStandardOutputIsAnError) {
  std::ostringstream out_stream, err_stream;
  out_stream.setstate(std::ios::badbit);
  const char* argv[] = {"thinwall", "doctor"};
  EXPECT_EQ(run_command_line(2, argv, {}, out_stream, err_stream), 4);
}

/// Runs `piece` over and over within a run, in a process that gets a signal once the run has begun; without one the
/// process ends with 0 after a minute.
void expect_ended_by(int signal, const std::string& plate, const std::string& out, const std::function<void()>& piece) {
  using Clock = std::chrono::steady_clock;
  const pid_t child = fork();
  if (child == 0) {
    install_signal_handlers();
    const Outcome outcome = call({"run", plate, "--out", out, "-q"}, [&](const Case&, const RunOptions& options) {
      core::write_file_atomically(core::partial_path(options.out / "staging"), "");
      core::PartialFile file(options.out / "frf.csv");
      core::write_file_atomically(options.out / "started", "");
      for (const auto end = Clock::now() + std::chrono::minutes(1); Clock::now() < end;) {
        piece();
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      }
      return empty_result(true);
    });
    _exit(outcome.code);
  }
  for (int i = 0; i < 4000 && !std::filesystem::exists(out + "/started"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  ::kill(child, signal);
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  for (const auto& entry : std::filesystem::directory_iterator(out)) {
    EXPECT_FALSE(core::is_partial_name(entry.path())) << entry.path();
  }
  std::filesystem::remove_all(out);
}

TEST_F(CommandLine, ASignalEndsTheRunWith130AndLeavesNoUnfinishedFile) {
  for (const int signal : {SIGINT, SIGTERM}) expect_ended_by(signal, plate(), out(), [] { core::check_interrupt(); });
}

TEST_F(CommandLine, ASignalEndsAlsoARunThatDoesNotLookAtIt) {
  for (const int signal : {SIGINT, SIGTERM}) expect_ended_by(signal, plate(), out(), [] {});
}

}  // namespace
}  // namespace thinwall::tests::command_line_test
