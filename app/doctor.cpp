#include "app/doctor.hpp"

#include <Spectra/Util/Version.h>
#include <metis.h>
#include <spdlog/version.h>
#include <suitesparse/SuiteSparse_config.h>
#include <toml++/impl/version.h>

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/parallel.hpp"
#include "io/step.hpp"

namespace thinwall::app {

namespace {

std::string dotted(int major, int minor, int patch) {
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
}

}  // namespace

std::string program_version() {
  return THINWALL_VERSION;
}

std::string doctor_report() {
  std::ostringstream text;
  const auto line = [&text](const std::string& name, const std::string& value) {
    text << "  " << name << std::string(16 - name.size(), ' ') << value << '\n';
  };
  text << "thinwall " << program_version() << "\n\nbuilt with\n";
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
  return text.str();
}

}  // namespace thinwall::app
