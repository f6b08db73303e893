// Modes of thin-walled parts as found in practice (tests/data/parts/README.md), checked by a Sturm count and by
// Spectra's Lanczos.

#include "fem/mode_check.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "fem/supports.hpp"
#include "io/surface/surface_file.hpp"
#include "mesh/surface/surface_repair.hpp"
#include "mesh/volume/surface_to_volume.hpp"

namespace thinwall::mode_check_test {
namespace {

struct Solved {
  fem::Model model;
  fem::Factored factored;
  fem::Modes modes;
};

/// On a coarse mesh, whose modes are modes as well; a surface that keeps the volume to a thousandth takes ten seconds.
Solved solved(const std::string& file, const std::string& unit) {
  const auto soup =
      io::read_surface(std::filesystem::path(THINWALL_SOURCE_DIR) / "tests" / "data" / "parts" / file, unit);
  mesh::SurfaceMeshOptions coarse;
  coarse.size.layers = 0;
  coarse.size.turn_rad = 0.3;
  coarse.volume_tolerance = 0.05;
  const auto meshed = mesh::mesh_closed_surface(mesh::repaired_surface(soup).surface, coarse);
  fem::Model model = fem::supported_model(meshed.mesh, 2, {70e9, 0.33, 2700.0}, {});
  fem::Factored factored = fem::factorise(model);
  fem::Modes modes = fem::modes(model, factored, {.count = 10});
  return {std::move(model), std::move(factored), std::move(modes)};
}

std::string refusal(const Solved& part, fem::Modes modes) {
  try {
    fem::verify(part.model, part.factored, modes);
  } catch (const core::NumericalError& error) {
    return error.what();
  }
  return "";
}

class CheckedParts : public ::testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(CheckedParts, HaveTheModesThatTwoOtherAlgorithmsFindAndNoForgedOnes) {
  const Solved part = solved(GetParam().first, GetParam().second);
  const auto start = std::chrono::steady_clock::now();
  const linalg::EigenpairCheck check = fem::check_modes(part.model, part.factored, part.modes);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf("%s: %td degrees of freedom, %d eigenvalues, differences %.1e of %.1e, %.1f s\n", GetParam().first,
              part.model.K.rows(), check.counted, check.largest_difference, check.tolerance, seconds);
  EXPECT_EQ(check.status, linalg::EigenCheckStatus::agrees);
  EXPECT_EQ(check.counted, 16) << "six rigid ones";
  EXPECT_LT(check.largest_difference, check.tolerance);

  fem::Modes changed = part.modes;
  changed.pairs.lambda(9) *= 1.0 + 1e-4;
  EXPECT_NE(refusal(part, changed).find("mode 10 at "), std::string::npos) << refusal(part, changed);

  fem::Modes dropped = part.modes;
  const Eigen::Index left = dropped.pairs.lambda.size() - 1;
  dropped.pairs.lambda.segment(9, left - 9) = part.modes.pairs.lambda.tail(left - 9);
  dropped.pairs.lambda.conservativeResize(left);
  const std::string text = refusal(part, dropped);
  EXPECT_NE(text.find("15 modes were found below "), std::string::npos) << text;
  EXPECT_NE(text.find("shows 16"), std::string::npos) << text;
}

INSTANTIATE_TEST_SUITE_P(Files, CheckedParts, ::testing::Values(std::pair("anchor.off", "m"), std::pair("u.off", "m")),
                         [](const auto& instance) {
                           std::string name = instance.param.first;
                           for (char& c : name) c = c == '.' ? '_' : c;
                           return name;
                         });

}  // namespace
}  // namespace thinwall::mode_check_test
