// Results do not depend on the number of threads.

#include <gtest/gtest.h>

#include <cstdio>
#include <vector>

#include "fem/modes.hpp"
#include "fem/supports.hpp"
#include "mesh/planar/bend.hpp"
#include "mesh/planar/prism_mesh.hpp"
#include "tests/linalg/thread_count.hpp"

namespace thinwall::fem::threads_test {
namespace {

struct Solved {
  Model model;
  Modes modes;
};

Solved clamped_wall(int threads, bool curved) {
  const ThreadCount count(threads);
  mesh::PrismMeshOptions options;
  options.size_m = 0.05;
  const mesh::Prism plate{{{0, 0}, {0.45, 0}, {0.45, 0.1}, {0, 0.1}}, {}, 0.0, 0.006, {}};
  const Support foot{"foot", mesh::PlaneRegion{{0, 0, 0}, {1, 0, 0}}, {0, 1, 2}};
  Shaping bend;
  if (curved) bend = [](mesh::LagrangeNodes& nodes) { mesh::bend({0.3, 0, 2, 0.2, 0.003}, nodes.positions); };
  Solved solved{supported_model(mesh::mesh_prism(plate, options), 4, {210e9, 0.3, 7850.0}, {foot}, bend), {}};
  const Factored factored = factorise(solved.model);
  solved.modes = modes(solved.model, factored, {.count = 10, .up_to_hz = {}});
  return solved;
}

TEST(Threads, OneAndMoreAssembleTheSameBitsAndFindTheSameModes) {
  for (const bool curved : {false, true}) {
    const Solved one = clamped_wall(1, curved);
    for (const int threads : {2, 5}) {
      const Solved several = clamped_wall(threads, curved);
      ASSERT_EQ(one.model.K.nonZeros(), several.model.K.nonZeros());
      EXPECT_TRUE((one.model.K.coeffs() == several.model.K.coeffs()).all()) << threads;
      EXPECT_TRUE((one.model.M.coeffs() == several.model.M.coeffs()).all()) << threads;
      EXPECT_TRUE(std::equal(one.model.K.innerIndexPtr(), one.model.K.innerIndexPtr() + one.model.K.nonZeros(),
                             several.model.K.innerIndexPtr()));
      const double lambda = (one.modes.pairs.lambda - several.modes.pairs.lambda)
                                .cwiseQuotient(one.modes.pairs.lambda)
                                .cwiseAbs()
                                .maxCoeff();
      const double phi = (one.modes.pairs.Phi - several.modes.pairs.Phi).cwiseAbs().maxCoeff() /
                         one.modes.pairs.Phi.cwiseAbs().maxCoeff();
      std::printf("%s wall of %td DOFs, 1 and %d threads: λ differ by %.1e, φ by %.1e\n", curved ? "curved" : "flat",
                  one.model.K.rows(), threads, lambda, phi);
      EXPECT_LT(lambda, 1e-10);
      EXPECT_LT(phi, 1e-8) << "a vector moves by the change of λ over the gap to its neighbour";
    }
  }
}

}  // namespace
}  // namespace thinwall::fem::threads_test
