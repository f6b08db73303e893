#include "report/page/phases.hpp"

#include <gtest/gtest.h>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/results/vtp.hpp"
#include "tests/core/temporary_folder.hpp"

namespace thinwall::report::phases_test {
namespace {

namespace fs = std::filesystem;

/// One triangle of diagonal 5 with one mode that moves its last corner along z by 2.
fs::path results_of_a_triangle(const std::string& name) {
  const fs::path folder = tests::temporary_files() / name;
  fs::remove_all(folder);
  fs::create_directories(folder / "modes");
  mesh::LagrangeNodes nodes;
  nodes.positions.resize(3, 3);
  nodes.positions << 0, 0, 0, 3, 0, 0, 0, 4, 0;
  io::NodeVectors shape{"mode 01, 1.0 Hz", {}};
  shape.values.setZero(3, 3);
  shape.values(2, 2) = 2.0;
  io::write_vtp(folder / "modes" / "part_surface.vtp", nodes, {{0, 1, 2}}, {shape}, {{"held", {0.0}}});
  return folder;
}

TEST(Phases, MoveTheSurfaceAsACosine) {
  const fs::path folder = results_of_a_triangle("phases_moved");
  const io::SurfaceFields own = io::read_vtp(folder / "modes" / "part_surface.vtp");
  EXPECT_EQ(own.numbers.front().name, "held");
  EXPECT_EQ(own.vectors.front().values(2, 2), 2.0);
  const fs::path film = write_phases(folder, {"part", 1, 0.1});
  const std::string collection = core::read_file(film);
  for (int k = 0; k < 16; ++k) {
    char name[48];
    std::snprintf(name, sizeof name, "part_mode_01_phases_%02d.vtp", k);
    EXPECT_NE(collection.find(name), std::string::npos);
    const io::SurfaceFields phase = io::read_vtp(folder / "modes" / name);
    const double cosine = std::cos(2.0 * M_PI * k / 16);
    EXPECT_NEAR(phase.surface.vertices[2].z(), 0.1 * 5.0 * cosine, 1e-6) << "a tenth of the diagonal at most";
    EXPECT_NEAR(phase.surface.vertices[1].z(), 0.0, 1e-12);
    EXPECT_NEAR(phase.numbers.front().values.front(), std::abs(cosine) / 3.0, 1e-12);
  }
}

TEST(Phases, WhatIsNotThereIsRefused) {
  const fs::path folder = results_of_a_triangle("phases_refused");
  EXPECT_THROW((void)write_phases(folder, {"part", 2, 0.1}), core::InputError);
  EXPECT_THROW((void)write_phases(folder, {"part", 0, 0.1}), core::InputError);
  EXPECT_THROW((void)write_phases(folder, {"part", 1, 0.0}), core::InputError);
  EXPECT_THROW((void)write_phases(folder, {"robot", 1, 0.1}), core::UsageError);
  EXPECT_THROW((void)write_phases(folder, {"coupled", 1, 0.1}), core::DataError);
  core::write_file_atomically(folder / "modes" / "coupled_surface.vtp", "<VTKFile");
  EXPECT_THROW((void)write_phases(folder, {"coupled", 1, 0.1}), core::DataError);
}

}  // namespace
}  // namespace thinwall::report::phases_test
