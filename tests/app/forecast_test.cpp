// The time of a run before it begins, with and without the first mesh of its part.

#include "app/forecast.hpp"

#include <gtest/gtest.h>

#include "case/reader.hpp"
#include "core/atomic_file.hpp"
#include "tests/core/temporary_folder.hpp"

namespace thinwall::tests::forecast_test {
namespace {

/// A tetrahedron as a surface.
constexpr auto corner = "OFF\n4 4 0\n0 0 0\n20 0 0\n0 20 0\n0 0 20\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

cases::Case part_of_a_file(const TemporaryFolder& folder) {
  core::write_file_atomically(folder.path / "corner.off", corner);
  return cases::parse_case(
      "[part]\nfile = \"corner.off\"\nunit = \"mm\"\n[part.material]\nyoungs_modulus = \"70 GPa\"\npoisson_ratio = "
      "0.3\n"
      "density = \"2700 kg/m^3\"\n[part.mesh]\ntolerance = 0.05\n[[part.supports]]\non = \"z_min\"\n[modes]\ncount = "
      "1\n",
      folder.path);
}

TEST(Forecast, KeepsTheFirstMeshForTheRun) {
  const TemporaryFolder folder;
  const app::Forecast found = app::forecast(part_of_a_file(folder));
  EXPECT_TRUE(found.first_mesh);
  EXPECT_FALSE(found.at_least());
}

// A limit that is over before it begins is met at the first look, whatever the clock.
TEST(Forecast, AFirstMeshThatIsNotThereInItsTimeLeavesTheLeastTime) {
  const TemporaryFolder folder;
  const app::Forecast found = app::forecast(part_of_a_file(folder), -1.0);
  EXPECT_FALSE(found.first_mesh);
  EXPECT_TRUE(found.part_at_least());
  EXPECT_GT(found.part_s(), 0.0);
  EXPECT_NE(app::text(found).find("over"), std::string::npos) << app::text(found);
}

}  // namespace
}  // namespace thinwall::tests::forecast_test
