// STEP: a solid is read as its closed form says; everything else is refused in one line, and crashes nothing.

#include "io/surface/step.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <string>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/surface/surface_file.hpp"
#include "mesh/surface/surface_repair.hpp"
#include "scratch_folder.hpp"
#include "tests/processor_time.hpp"

namespace thinwall::io::test::step_test {

namespace {

const std::filesystem::path parts = std::filesystem::path(THINWALL_SOURCE_DIR) / "tests" / "data" / "parts";

class Step : public ScratchFolder {
 protected:
  void SetUp() override {
    if (!reads_step()) GTEST_SKIP() << "built without Open CASCADE";
  }
  /// The bracket's file with one text in place of another.
  [[nodiscard]] std::filesystem::path changed(const std::string& from, const std::string& to) const {
    std::string bytes = core::read_file(parts / "bracket.step");
    const auto at = bytes.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return write("changed.step", at == std::string::npos ? bytes : bytes.replace(at, from.size(), to));
  }
  [[nodiscard]] std::string refusal(const std::filesystem::path& path, const StepOptions& options = {}) const {
    std::string text = message_of<core::DataError>([&] { (void)read_step(path, options); });
    EXPECT_EQ(text.find('\n'), std::string::npos) << "one line: " << text;
    EXPECT_NE(text.find(path.string()), std::string::npos) << "which file: " << text;
    return text;
  }
};

bool has(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}

}  // namespace

// The bracket: legs of 70 and 50 mm, 60 mm wide, 2 mm thick, inner radius 3 mm, outer 5 mm, four holes of 9 mm and one
// of 16 mm: (68 + 48 + 2) · 2 · 60 less the corner outside the bend, more that inside, less the holes.
TEST_F(Step, ASolidHasTheVolumeOfItsClosedForm) {
  constexpr double pi = 3.14159265358979;
  const double corner = 1.0 - pi / 4;
  const double exact =
      60.0 * (70 * 2 + 48 * 2 + corner * (3 * 3 - 5 * 5)) - 4 * pi * 4.5 * 4.5 * 2 - pi * 8.0 * 8.0 * 2;
  double last = 0.01;
  for (const double turn : {0.5, 0.1}) {
    StepOptions options;
    options.angular_deflection_rad = turn;
    const StepSurface found = read_step(parts / "bracket.step", options);
    EXPECT_EQ(found.metres_per_unit, 1e-3) << found.unit;
    const auto repair = mesh::repaired_surface(found.soup);
    EXPECT_TRUE(repair.mended.empty()) << "closed as it comes: " << mesh::text(repair);
    EXPECT_NEAR(repair.solid_volume_m3 / (1e-9 * exact), 1.0, 1e-6) << "that of the solid, however coarse the facets";
    const double error = std::abs(repair.volume_m3 / (1e-9 * exact) - 1.0);
    std::printf("turn %.1f: %zu facets, volume off %.1e\n", turn, found.soup.triangles.size(), error);
    EXPECT_LT(error, 0.1 * last) << "falls as the square of the turning: by 25";
    last = error;
  }
}

TEST_F(Step, TheUnitIsTheFilesOrTheCallers) {
  const auto own = mesh::bounds(read_step(parts / "bracket.step").soup);
  EXPECT_NEAR(own.largest.x() - own.least.x(), 0.070, 1e-9);
  StepOptions inches;
  inches.metres_per_unit = 0.0254;
  const auto forced = mesh::bounds(read_step(parts / "bracket.step", inches).soup);
  EXPECT_NEAR(forced.largest.x() - forced.least.x(), 70 * 0.0254, 1e-6);
  EXPECT_NEAR(std::cbrt(read_step(parts / "bracket.step", inches).soup.solid_volume_m3 /
                        read_step(parts / "bracket.step").soup.solid_volume_m3),
              25.4, 1e-9);
  const auto centimetres = read_step(changed("SI_UNIT(.MILLI.,.METRE.)", "SI_UNIT(.CENTI.,.METRE.)"));
  EXPECT_EQ(centimetres.metres_per_unit, 1e-2) << centimetres.unit;
  const auto scaled = mesh::bounds(centimetres.soup);
  EXPECT_NEAR(scaled.largest.x() - scaled.least.x(), 0.70, 1e-8);
}

TEST_F(Step, AsASurfaceFileNeedsNoUnitAndContradictsAWrongOne) {
  EXPECT_EQ(read_surface(parts / "bracket.step", "").triangles.size(),
            read_surface(parts / "bracket.step", "mm").triangles.size());
  const auto text = message_of<core::InputError>([] { (void)read_surface(parts / "bracket.step", "inch"); });
  EXPECT_TRUE(has(text, "\"inch\"")) << text;
}

TEST_F(Step, WhatIsNoSolidIsRefusedAndWhy) {
  EXPECT_TRUE(has(refusal(write("empty.step", "")), "no STEP file"));
  EXPECT_TRUE(has(refusal(write("stl.step", "solid x\nendsolid x\n")), "no STEP file"));
  EXPECT_TRUE(has(refusal(path("absent.step")), "absent.step"));
  const std::string whole = core::read_file(parts / "bracket.step");
  EXPECT_TRUE(has(refusal(write("cut.step", whole.substr(0, whole.size() / 2))), "cut off"));
  EXPECT_TRUE(
      has(refusal(write("nothing.step", "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n")),
          "nothing.step"));
  const std::string shell = refusal(changed("MANIFOLD_SOLID_BREP('',#16)", "SHELL_BASED_SURFACE_MODEL('',(#16))"));
  EXPECT_TRUE(has(shell, "faces that bound no solid, the first at (")) << shell;
  const std::string several = refusal(parts / "assembly.stp");
  EXPECT_TRUE(has(several, "18 solids, the first two at (")) << several;
  StepOptions options;
  options.linear_deflection = 0.5;
  EXPECT_THROW((void)read_step(parts / "bracket.step", options), core::InputError);
}

// Not under libFuzzer: each input needs a process of its own, so that it would try a hundred a second without coverage.
TEST_F(Step, MutatedFilesNeitherCrashNorHangTheCaller) {
  const std::string whole = core::read_file(parts / "bracket.step");
  StepOptions options;
  options.limits = {.time_s = 5.0, .memory_bytes = 1e9};
  std::mt19937 random(21);
  int read = 0;
  constexpr int trials = 100;
  const double start = tests::processor_seconds();
  for (int trial = 0; trial < trials; ++trial) {
    std::string bytes = whole;
    const std::size_t data = bytes.find("DATA;");
    for (std::size_t k = 0; k <= random() % 20; ++k) {
      char& c = bytes[data + random() % (bytes.size() - data)];
      c = trial % 3 == 0 ? static_cast<char>(random() % 256) : static_cast<char>('0' + random() % 10);
    }
    try {
      const auto found = read_step(write("mutated.step", bytes), options);
      EXPECT_NO_THROW((void)mesh::merged_points(found.soup));
      ++read;
    } catch (const core::DataError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
  const double seconds = tests::processor_seconds() - start;
  std::printf("%d of %d mutated files read, %.0f ms each\n", read, trials, 1e3 * seconds / trials);
  EXPECT_GT(read, 0) << "what is always refused reaches nothing";
  EXPECT_LT(read, trials);
}

}  // namespace thinwall::io::test::step_test
