// A million facets, checks included, in ten seconds and 2 GB.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>

#include "io/surface/stl.hpp"
#include "mesh/surface/surface_repair.hpp"
#include "scratch_folder.hpp"
#include "tests/mesh/solid_shapes.hpp"
#include "tests/processor_time.hpp"

namespace thinwall::io::test::surface_speed_test {

namespace {

/// The larger of what this process and a child ever had in memory, GB.
double peak_gigabytes() {
  long kilobytes = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    kilobytes = std::max(kilobytes, usage.ru_maxrss);
  }
  return 1e-6 * static_cast<double>(kilobytes);
}

class SurfaceSpeed : public ScratchFolder {};

TEST_F(SurfaceSpeed, AMillionFacetsAreReadAndCheckedInTenSeconds) {
#if defined(THINWALL_ADDRESS_SANITIZER)
  GTEST_SKIP() << "sanitizers take several times as long";
#endif
  write_stl(path("torus.stl"), mesh::soup(mesh::torus(0.5, 0.2, 1000, 500)), 1e-3);
  const double start = tests::processor_seconds();
  const auto repair = mesh::repaired_surface(read_stl(path("torus.stl"), 1e-3));
  const double seconds = tests::processor_seconds() - start;
  std::printf("a million facets in %.1f s of processor time, at most %.2f GB in a process\n", seconds,
              peak_gigabytes());
  EXPECT_EQ(repair.surface.triangles.size(), 1000000U);
  EXPECT_TRUE(repair.mended.empty());
  EXPECT_LE(seconds, 10.0);
  EXPECT_LE(peak_gigabytes(), 2.0);
}

}  // namespace

}  // namespace thinwall::io::test::surface_speed_test
