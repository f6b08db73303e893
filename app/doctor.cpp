#include "app/doctor.hpp"

#include <Spectra/Util/Version.h>
#include <dlfcn.h>
#include <metis.h>
#include <spdlog/version.h>
#include <suitesparse/SuiteSparse_config.h>
#include <toml++/impl/version.h>

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/self_test.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "distributed/rank_team.hpp"
#include "io/surface/step.hpp"

namespace thinwall::app {

namespace {

std::string dotted(int major, int minor, int patch) {
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
}

std::string named_line(const std::string& name, const std::string& value) {
  return "  " + name + std::string(16 - name.size(), ' ') + value + '\n';
}

/// A line of /proc/meminfo in bytes; "unknown" where there is none.
std::string memory_text(const std::string& name) {
  std::ifstream file("/proc/meminfo");
  std::string word;
  for (double kibibytes = 0.0; file >> word;) {
    if (word == name + ":" && file >> kibibytes) return core::readable_text(kibibytes * 1024.0, core::kind::memory);
  }
  return "unknown";
}

/// The description that OpenBLAS gives of itself. It is asked for by name, because another BLAS may stand in its place.
std::string blas_text(const char* function) {
  using Answer = char* (*)();
  const auto ask = reinterpret_cast<Answer>(::dlsym(RTLD_DEFAULT, function));
  return ask == nullptr ? "unknown: the BLAS is not OpenBLAS" : ask();
}

/// The place where the python3 on the PATH finds the module; its first path, the working directory, does not count.
std::string python_text() {
  FILE* answer = ::popen(
      "python3 -c 'import sys; sys.path.pop(0); import thinwall; print(thinwall.__path__[0])' 2>/dev/null", "r");
  std::string folder;
  for (int c = answer == nullptr ? EOF : std::fgetc(answer); c != EOF; c = std::fgetc(answer)) {
    if (c != '\n') folder += static_cast<char>(c);
  }
  const bool found = answer != nullptr && ::pclose(answer) == 0 && !folder.empty();
  return found ? "there, in " + folder
               : "absent for python3: install python3-thinwall, or set PYTHONPATH to the build's folder python "
                 "(docs/python.md)";
}

std::string self_test_text(const SelfTest& test) {
  if (!test.failure.empty()) return "cantilever: " + test.failure;
  return "cantilever: " + core::number_text(test.found_hz, 5) + " Hz, by beam theory " +
         core::number_text(test.expected_hz, 5) + " Hz, " + (test.ok() ? "ok" : "WRONG") + ", modes confirmed to " +
         core::number_text(test.mode_difference, 2) + " by a Sturm count and Spectra's Lanczos, " +
         core::readable_text(test.seconds, core::kind::time);
}

}  // namespace

std::string program_version() {
  return THINWALL_VERSION;
}

std::string program_name() {
  return "thinwall " + program_version();
}

std::string doctor_report() {
  std::ostringstream text;
  const auto line = [&text](const std::string& name, const std::string& value) { text << named_line(name, value); };
  text << program_name() << "\n\nbuilt with\n";
  line("compiler", THINWALL_COMPILER);
  line("build type", THINWALL_BUILD_TYPE);
  line("Eigen", dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION));
  line("Spectra", dotted(SPECTRA_MAJOR_VERSION, SPECTRA_MINOR_VERSION, SPECTRA_PATCH_VERSION));
  line("SuiteSparse", dotted(SUITESPARSE_MAIN_VERSION, SUITESPARSE_SUB_VERSION, SUITESPARSE_SUBSUB_VERSION));
  line("METIS", dotted(METIS_VER_MAJOR, METIS_VER_MINOR, METIS_VER_SUBMINOR));
  line("TetGen", "1.5 (its header gives no version)");
  line("VTK", THINWALL_VTK_VERSION);
  line("toml++", dotted(TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH));
  line("CLI11", CLI11_VERSION);
  line("spdlog", dotted(SPDLOG_VER_MAJOR, SPDLOG_VER_MINOR, SPDLOG_VER_PATCH));
  line("nlohmann-json", dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH));
  text << "\nthreads\n";
  line("in use", std::to_string(core::thread_count()));
  text << "\noptional parts\n";
  line("STEP files",
       io::reads_step() ? "there (Open CASCADE)" : "absent: install libocct-data-exchange-dev and build again");
  line("--ranks", distributed::ranks_in_words());
  return text.str();
}

Diagnosis diagnosis() {
  const SelfTest test = self_test();
  std::string text = doctor_report();
  text += named_line("report.html", "there; neither Node nor a network is needed");
  text += named_line("Python module", python_text());
  text += "\nmachine\n" + named_line("memory", memory_text("MemTotal") + ", free " + memory_text("MemAvailable")) +
          named_line("BLAS kernel", blas_text("openblas_get_corename")) +
          named_line("BLAS", blas_text("openblas_get_config"));
  text += "\nself-test\n  " + self_test_text(test) + "\n\n";
  text += test.ok() ? "everything works\n"
                    : "the self-test fails: do not trust this program's results; build it again, and if it stays so, "
                      "report it with this text\n";
  return {text, test.ok()};
}

}  // namespace thinwall::app
